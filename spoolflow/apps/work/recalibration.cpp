#include "spoolflow/apps/work/recalibration.hpp"

#include <map>
#include <set>
#include <stdexcept>
#include <string>
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
    if (file == "-")
      throw std::invalid_argument("recordings that move a model are named in it, and read from files, not from -");
    out.push_back(recording::read_recording(file, options));
    constexpr std::size_t least_samples = 100;
    if (out.back().size() < least_samples) {
      throw std::invalid_argument(
          fmt::format("{}: has {} samples; give minutes of the valve's operation", file.string(), out.back().size()));
    }
  }
  return out;
}

/// Recordings that moved the model since it was calibrated, or since it last went back.
std::set<std::string> used_names(const model::Model& model) {
  std::set<std::string> out;
  for (const model::Adaptation& each : model.provenance.adaptations) {
    if (each.files.empty()) out.clear();
    out.insert(each.files.begin(), each.files.end());
  }
  return out;
}

/// The same oil twice is no more evidence than once.
void refuse_used_again(const model::Model& model, const std::vector<std::filesystem::path>& files) {
  std::map<std::string, std::string> used;  // sha256 to where
  const std::set<std::string> names = used_names(model);
  for (const model::InputFile& input : model.provenance.inputs) {
    if (input.protocol == model::adaptation_protocol && names.contains(input.file))
      used.emplace(input.sha256, "has already moved this model");
  }
  for (const std::filesystem::path& file : files) {
    const auto [where, is_new] = used.emplace(model::sha256_of_file(file), "is given twice");
    if (is_new) continue;
    throw std::invalid_argument(
        fmt::format("{}: {}, and counts once; give recordings of other strokes, or the model as it was before",
                    file.string(), where->second));
  }
}

}  // namespace

calibration::RecalibratedValve recalibrated(const model::Model& model, const MachineFiles& from,
                                            model::Adaptation how) {
  calibration::require_movable(model);  // before files are read that only another model needs
  const std::vector<recording::Reference> references = recording::read_references(from.references);
  const std::vector<recording::Recording> recordings = recordings_of(from, model);
  refuse_used_again(model, from.recordings);
  calibration::RecalibratedValve out = calibration::recalibrate(model, recordings, references, std::move(how));
  for (const recording::Recording& recording : recordings) {
    out.model.provenance.inputs.push_back({std::string(model::adaptation_protocol), recording.file.filename().string(),
                                           model::sha256_of_file(recording.file), recording.size(),
                                           recording.resampled});
  }
  return out;
}

}  // namespace spoolflow::apps
