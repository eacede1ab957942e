#include "spoolflow/apps/work/recalibration.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/recording/reader.hpp"

namespace spoolflow::apps {
namespace {

using recording::Channel;

std::vector<recording::Recording> recordings_of(const MachineFiles& from, double stroke_m) {
  recording::ReadOptions options;
  options.required = {Channel::time, Channel::current, Channel::position};
  options.optional = {Channel::voltage, Channel::oil_temperature, Channel::pressure_difference, Channel::flow_reference,
                      Channel::test};
  options.stroke_m = stroke_m;
  options.channels = from.channels;
  std::vector<recording::Recording> out;
  for (const std::filesystem::path& file : from.recordings) {
    out.push_back(recording::read_recording(file, options));
    constexpr std::size_t least_samples = 100;
    if (out.back().size() < least_samples) {
      throw std::invalid_argument(
          fmt::format("{}: has {} samples; give minutes of the valve's operation", file.string(), out.back().size()));
    }
  }
  return out;
}

}  // namespace

calibration::RecalibratedValve recalibrated(const model::Model& model, const MachineFiles& from,
                                            model::Adaptation how) {
  calibration::require_movable(model);  // before files are read that only another model needs
  const std::vector<recording::Reference> references = recording::read_references(from.references);
  const std::vector<recording::Recording> recordings = recordings_of(from, model.valve.stroke_m);
  calibration::RecalibratedValve out = calibration::recalibrate(model, recordings, references, std::move(how));
  for (const recording::Recording& recording : recordings) {
    out.model.provenance.inputs.push_back({std::string(model::adaptation_protocol), recording.file.filename().string(),
                                           model::sha256_of_file(recording.file), recording.size(),
                                           recording.resampled});
  }
  return out;
}

}  // namespace spoolflow::apps
