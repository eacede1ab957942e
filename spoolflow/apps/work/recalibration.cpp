#include "spoolflow/apps/work/recalibration.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/recording/coil_channels.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::apps {
namespace {

using recording::Channel;

std::vector<recording::Recording> recordings_of(const MachineFiles& from, const model::Model& model) {
  recording::ReadOptions options;
  options.required = {Channel::time, Channel::position};
  options.optional = {Channel::oil_temperature, Channel::pressure_difference, Channel::flow_reference, Channel::test};
  const std::vector<recording::CoilChannels> coils =
      model.whole() ? std::vector<recording::CoilChannels>{{Channel::current_a, Channel::voltage_a},
                                                           {Channel::current_b, Channel::voltage_b}}
                    : std::vector<recording::CoilChannels>{{Channel::current, Channel::voltage}};
  for (const recording::CoilChannels& coil : coils) {
    options.required.push_back(coil.current);
    options.optional.push_back(coil.voltage);
  }
  options.stroke_m = model.valve.stroke_m;
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
  const std::vector<recording::Recording> recordings = recordings_of(from, model);
  calibration::RecalibratedValve out = calibration::recalibrate(model, recordings, references, std::move(how));
  for (const recording::Recording& recording : recordings) {
    out.model.provenance.inputs.push_back({std::string(model::adaptation_protocol), recording.file.filename().string(),
                                           model::sha256_of_file(recording.file), recording.size(),
                                           recording.resampled});
  }
  return out;
}

}  // namespace spoolflow::apps
