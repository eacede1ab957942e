#include "spoolflow/analysis/run_samples.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::analysis {

using recording::Channel;

RunSamples run_samples(const recording::Recording& recording) {
  RunSamples out;
  out.name = recording.file == "-" ? "standard input" : recording.file.filename().string();
  const auto at = [&](Channel channel, std::size_t k) { return recording.has(channel) ? recording[channel][k] : NAN; };
  std::vector<std::size_t> complete;
  for (std::size_t k = 0; k < recording.size(); ++k) {
    out.samples.push_back({at(Channel::time, k), at(Channel::current, k), at(Channel::voltage, k),
                           at(Channel::position, k), at(Channel::oil_temperature, k)});
    const estimation::TimedSample& sample = out.samples.back();
    if (std::isfinite(sample.current_A) && std::isfinite(sample.position_m)) complete.push_back(k);
  }
  if (complete.empty()) {
    throw recording::RecordingError(fmt::format(
        "{}: no sample holds both current and position, so there is nothing to analyse; give a run with both",
        out.name));
  }
  const std::size_t count = std::min(most_instants, complete.size());
  for (std::size_t k = 0; k < count; ++k) out.instants.push_back(complete[k * complete.size() / count]);
  const Channel reference = recording.has(Channel::flow_reference) ? Channel::flow_reference : Channel::flow;
  if (recording.has(reference)) {
    out.reference_m3_per_s.assign(recording[reference].begin(), recording[reference].end());
  }
  return out;
}

std::vector<double> lagged(const RunSamples& run, std::vector<double> values, double lag_s) {
  if (!(lag_s > 0)) return values;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double step_s = run.samples[k].time_s - run.samples[k - 1].time_s;
    values[k] = values[k - 1] - std::expm1(-step_s / lag_s) * (values[k] - values[k - 1]);
  }
  return values;
}

}  // namespace spoolflow::analysis
