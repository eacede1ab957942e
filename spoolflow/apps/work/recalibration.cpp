#include "spoolflow/apps/work/recalibration.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/plausibility/known_valve.hpp"
#include "spoolflow/plausibility/run_findings.hpp"
#include "spoolflow/plausibility/run_means.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/coil_channels.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::apps {
namespace {

using recording::Channel;

std::vector<recording::Recording> recordings_of(const MachineOil& from, const model::Model& model) {
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

/// The marks of a reference are times of one recording, which the reference names.
void refuse_ambiguous(const std::vector<recording::Reference>& references,
                      const std::vector<std::filesystem::path>& files) {
  for (const recording::Reference& each : references) {
    const auto named = std::ranges::count_if(
        files, [&](const std::filesystem::path& file) { return file.filename() == each.recording; });
    if (named > 1) {
      throw std::invalid_argument(
          fmt::format("{}: {} is of the recording {}, and {} of the files given have that name; give them names of "
                      "their own",
                      each.place, each.name, each.recording, named));
    }
    if (each.recording.empty() && !each.marks.empty() && files.size() > 1) {
      throw std::invalid_argument(fmt::format(
          "{}: {} does not say of which of the {} recordings its marks are; write recording = \"{}\", and a table "
          "[[reference]] for each",
          each.place, each.name, files.size(), files.front().filename().string()));
    }
  }
}

/// What speaks against the recordings, so that they are no evidence of the valve.
std::vector<std::string> doubts_about(const std::vector<recording::Recording>& recordings, const model::Model& model) {
  const std::vector<plausibility::KnownValve> known = plausibility::known_valve(model);
  std::vector<std::string> out;
  for (const recording::Recording& run : recordings) {
    for (plausibility::Finding& finding : plausibility::run_findings(known, plausibility::RunMeans(run), run.file))
      out.push_back(std::move(finding.text));
  }
  return out;
}

/// The same as calibration::recalibrate(); a refusal says what speaks against the recordings, too.
calibration::RecalibratedValve recalibrated_despite(const std::vector<std::string>& doubts, const model::Model& model,
                                                    const std::vector<recording::Recording>& recordings,
                                                    const std::vector<recording::Reference>& references,
                                                    model::Adaptation how) {
  try {
    return calibration::recalibrate(model, recordings, references, std::move(how));
  } catch (const calibration::CalibrationError& error) {
    throw calibration::CalibrationError(calibration::with_doubts(error.what(), doubts));
  } catch (const recording::RecordingError& error) {
    throw recording::RecordingError(calibration::with_doubts(error.what(), doubts));
  }
}

}  // namespace

calibration::RecalibratedValve recalibrated(const model::Model& model, const MachineOil& from, model::Adaptation how) {
  calibration::require_movable(model);  // before files are read that only another model needs
  refuse_ambiguous(from.references, from.recordings);
  const std::vector<recording::Recording> recordings = recordings_of(from, model);
  refuse_used_again(model, from.recordings);
  const std::vector<std::string> doubts = doubts_about(recordings, model);
  calibration::RecalibratedValve out = recalibrated_despite(doubts, model, recordings, from.references, std::move(how));
  out.doubts.insert(out.doubts.begin(), doubts.begin(), doubts.end());
  std::vector<std::string>& reasons = out.model.provenance.adaptations.back().reasons;
  reasons.insert(reasons.end(), doubts.begin(), doubts.end());
  for (const recording::Recording& recording : recordings) {
    out.model.provenance.inputs.push_back({std::string(model::adaptation_protocol), recording.file.filename().string(),
                                           model::sha256_of_file(recording.file), recording.size(),
                                           recording.resampled});
  }
  return out;
}

}  // namespace spoolflow::apps
