#include "spoolflow/analysis/run_samples.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::analysis {

using recording::Channel;

RunSamples run_samples(const recording::Recording& recording) {
  RunSamples out;
  out.name = recording.file == "-" ? "standard input" : recording.file.filename().string();
  const estimation::Columns columns = estimation::sensor_columns(recording);
  std::vector<std::size_t> complete;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    out.samples.push_back(columns[k]);
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

}  // namespace spoolflow::analysis
