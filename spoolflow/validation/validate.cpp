#include "spoolflow/validation/validate.hpp"

#include <algorithm>
#include <array>

namespace spoolflow::validation {
namespace {

using recording::Channel;

void append(EstimatorResult& out, const std::vector<sensor::Estimate<double>>& estimates) {
  for (const sensor::Estimate<double>& estimate : estimates) {
    out.flow_m3_per_s.push_back(estimate.flow_m3_per_s);
    out.lower_m3_per_s.push_back(estimate.flow_lower_m3_per_s);
    out.upper_m3_per_s.push_back(estimate.flow_upper_m3_per_s);
    out.pressure_difference_Pa.push_back(estimate.pressure_difference_Pa);
    out.magnetic_force_N.push_back(estimate.magnetic_force_N);
    out.spring_force_N.push_back(estimate.spring_force_N);
    out.flow_force_N.push_back(estimate.flow_force_N);
    out.friction_force_N.push_back(estimate.friction_force_N);
  }
}

using StatusCounts = std::array<std::size_t, sensor::status_names.size()>;

void count(StatusCounts& counts, const std::vector<sensor::Estimate<double>>& estimates) {
  for (const sensor::Estimate<double>& estimate : estimates) {
    for (std::size_t b = 0; b < counts.size(); ++b)
      counts[b] += sensor::has(estimate.status, sensor::status_names[b].bit) ? 1 : 0;
  }
}

std::vector<StatusShare> shares(const StatusCounts& counts, std::size_t samples) {
  std::vector<StatusShare> out;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    if (counts[b] > 0)
      out.push_back({sensor::status_names[b].name, static_cast<double>(counts[b]) / static_cast<double>(samples)});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const StatusShare& a, const StatusShare& b) { return a.share > b.share; });
  return out;
}

void append(std::vector<double>& to, const recording::SampleBlock& block, Channel channel) {
  const auto& from = block.columns[static_cast<std::size_t>(channel)];
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

ValidatedRun validate_run(const model::Model& model, const std::filesystem::path& recording,
                          const ValidationOptions& options, const std::function<void(double)>& progress) {
  recording::ReadOptions channels = sensor_channels(model, options.channels);
  for (const Channel channel :
       {Channel::position_set, Channel::flow_reference, Channel::flow, Channel::pressure_difference}) {
    channels.optional.push_back(channel);
  }
  const auto reader = recording::open_reader(recording, channels);
  ValidatedRun run;
  run.name = recording.stem().string();
  run.file = recording.filename().string();
  std::vector<Estimation> sensors;
  for (const Estimator estimator : options.estimators) {
    sensors.emplace_back(model, estimator);
    run.results.push_back({});
    run.results.back().estimator = estimator;
  }
  std::vector<StatusCounts> counts(sensors.size(), StatusCounts{});
  std::vector<double> position_set;
  const Channel reference = reader->has(Channel::flow_reference) ? Channel::flow_reference : Channel::flow;
  recording::SampleBlock block;
  std::vector<sensor::Estimate<double>> estimates;
  while (reader->next(block)) {
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      sensors[s].run(block, estimates);
      append(run.results[s], estimates);
      count(counts[s], estimates);
    }
    append(run.time_s, block, Channel::time);
    append(run.position_m, block, Channel::position);
    append(run.oil_temperature_K, block, Channel::oil_temperature);
    append(run.reference_m3_per_s, block, reference);
    append(run.reference_pressure_difference_Pa, block, Channel::pressure_difference);
    append(position_set, block, Channel::position_set);
    progress(reader->progress().value_or(0));
  }
  run.notes = reader->notes();
  run.phases = position_set.empty() ? phases_of_position(run.time_s, run.position_m, model.valve.stroke_m)
                                    : phases_of_command(run.time_s, position_set);
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    EstimatorResult& result = run.results[s];
    result.status = shares(counts[s], run.time_s.size());
    if (run.reference_m3_per_s.empty()) continue;
    if (options.apply_reference_lag) {
      result.flow_m3_per_s = lagged(run.time_s, result.flow_m3_per_s, options.reference_lag_s);
      result.lower_m3_per_s = lagged(run.time_s, result.lower_m3_per_s, options.reference_lag_s);
      result.upper_m3_per_s = lagged(run.time_s, result.upper_m3_per_s, options.reference_lag_s);
    }
    result.metrics =
        compare({result.flow_m3_per_s, result.lower_m3_per_s, result.upper_m3_per_s, run.reference_m3_per_s},
                run.phases, model.valve.rated_flow_m3_per_s);
  }
  return run;
}

}  // namespace spoolflow::validation
