#include "spoolflow/apps/work/monitored_recording.hpp"

#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/model/json_text.hpp"
#include "spoolflow/model/provenance.hpp"
#include "spoolflow/monitor/baseline.hpp"
#include "spoolflow/plausibility/run_findings.hpp"

namespace spoolflow::apps {
namespace {

/// Keeps the indicators whenever a window was judged, no more than a page can show.
void follow_trend(const monitor::Monitor& watch, std::vector<report::TrendPoint>& trend) {
  constexpr std::size_t most_points = 2000;
  const double windows = watch.judged_windows();
  if (windows == 0 || (!trend.empty() && trend.back().windows == windows)) return;
  if (trend.size() == most_points) {
    for (std::size_t k = 0; 2 * k < trend.size(); ++k) trend[k] = trend[2 * k];
    trend.resize(trend.size() / 2);
  }
  trend.push_back({windows, watch.indicators()});
}

}  // namespace

std::optional<monitor::Baseline> read_baseline(const std::string& file) {
  if (file.empty()) return {};
  std::ifstream in(file, std::ios::binary);
  if (!in) throw model::ModelError(file + ": the baseline cannot be read; name what an earlier --json wrote");
  return monitor::parse_baseline(model::read_json_text(in), file);
}

void BandWatch::take(const model::Model& model, const monitor::Monitor& watch, const estimation::TimedSample& sample,
                     const sensor::Estimate<double>& answer) {
  const double windows = watch.judged_windows();
  if (windows != windows_) {
    doubt_ = watch.doubt();
    windows_ = windows;
  }
  ++figures_.samples;
  if (!doubt_.any()) return;
  const sensor::Estimate<double> wider =
      monitor::widened(model, doubt_, sample, watch.state().oil_temperature_K, answer);
  ++figures_.doubted;
  figures_.sensor_m3_per_s += answer.flow_upper_m3_per_s - answer.flow_lower_m3_per_s;
  figures_.widened_m3_per_s += wider.flow_upper_m3_per_s - wider.flow_lower_m3_per_s;
}

void refuse_given_twice(const std::vector<std::string>& recordings) {
  std::map<std::uintmax_t, std::size_t> of_size;  // how many files
  for (const std::string& file : recordings) {
    if (std::filesystem::is_regular_file(file)) ++of_size[std::filesystem::file_size(file)];
  }
  std::map<std::string, std::string> given;  // sha256 to file
  for (const std::string& file : recordings) {
    if (!std::filesystem::is_regular_file(file) || of_size[std::filesystem::file_size(file)] == 1) continue;
    const auto [first, is_new] = given.emplace(model::sha256_of_file(file), file);
    if (is_new) continue;
    throw model::ModelError(
        fmt::format("{}: holds the same as {}, and counts once; leave it out, or name a recording of other strokes",
                    file, first->second));
  }
}

std::string doubt_text(const plausibility::Finding& finding) {
  return fmt::format("doubt: {}; what is raised may be the recording's and not the valve's", finding.text);
}

WatchedRecording monitor_recording(const model::Model& model, const std::string& recording,
                                   const recording::ChannelMap& channels, monitor::Monitor& watch,
                                   std::vector<report::TrendPoint>& trend, BandWatch& band,
                                   const std::function<void(std::optional<double>)>& progress) {
  recording::ReadOptions options = estimation::sensor_channels(model, channels);
  options.optional.push_back(recording::Channel::position_set);
  const auto reader = estimation::open_sensor_channels(recording, options);
  estimation::RunningSensor sensor = estimation::running_sensor(model, estimation::Estimator::observer);
  plausibility::RunMeans means;
  recording::SampleBlock block;
  while (reader->next(block)) {
    means.take(block);
    const estimation::Columns columns = estimation::sensor_columns(block);
    const std::vector<double>& command = block.column(recording::Channel::position_set);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const estimation::TimedSample sample = columns[k];
      const sensor::Estimate<double> answer = sensor.step(sample);
      watch.take(sample, answer, command.empty() ? estimation::not_measured : model.valve.stroke_m * command[k]);
      band.take(model, watch, sample, answer);
    }
    follow_trend(watch, trend);
    progress(reader->progress());
  }
  watch.finish();
  follow_trend(watch, trend);
  return {plausibility::run_findings(plausibility::known_valve(model), means, recording), reader->notes().resampled};
}

}  // namespace spoolflow::apps
