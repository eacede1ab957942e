#include "spoolflow/validation/run_samples.hpp"

#include "spoolflow/estimation/edge_flow.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/monitor/contradiction.hpp"
#include "spoolflow/numerics/meter_lag.hpp"
#include "spoolflow/numerics/meter_lag_uncertainty.hpp"

namespace spoolflow::validation {
namespace {

using recording::Channel;

void append(Answers& to, const std::vector<sensor::Estimate<double>>& estimates) {
  const auto keep = [](std::vector<float>& column, double value) { column.push_back(static_cast<float>(value)); };
  for (const sensor::Estimate<double>& estimate : estimates) {
    keep(to.flow_m3_per_s, estimate.flow_m3_per_s);
    keep(to.lower_m3_per_s, estimate.flow_lower_m3_per_s);
    keep(to.upper_m3_per_s, estimate.flow_upper_m3_per_s);
    keep(to.pressure_difference_Pa, estimate.pressure_difference_Pa);
    keep(to.magnetic_force_N, estimate.magnetic_force_N);
    keep(to.spring_force_N, estimate.spring_force_N);
    keep(to.flow_force_N, estimate.flow_force_N);
    keep(to.friction_force_N, estimate.friction_force_N);
    to.status.push_back(estimate.status);
  }
}

template <class Number>
void append(std::vector<Number>& to, const recording::SampleBlock& block, Channel channel) {
  for (const double value : block.column(channel)) to.push_back(static_cast<Number>(value));
}

std::vector<double> in_double(const std::vector<float>& values) {
  return {values.begin(), values.end()};
}

/// What a coil has, of the only or the active one; of a whole valve coil b's counts > 0 and coil a's < 0.
struct OfCoils {
  Channel one, a, b;
};

void append_of_coils(std::vector<float>& to, const recording::SampleBlock& block, const OfCoils& channel) {
  const std::vector<double>& a = block.column(channel.a);
  const std::vector<double>& b = block.column(channel.b);
  if (a.empty() || b.empty()) return append(to, block, channel.one);
  for (std::size_t k = 0; k < block.rows; ++k) to.push_back(static_cast<float>(b[k] - a[k]));
}

void append_pressure_difference(std::vector<float>& to, const recording::SampleBlock& block) {
  if (!block.column(Channel::pressure_difference).empty()) return append(to, block, Channel::pressure_difference);
  const auto& upstream_Pa = block.column(Channel::pressure_upstream);
  const auto& downstream_Pa = block.column(Channel::pressure_downstream);
  if (upstream_Pa.empty() || downstream_Pa.empty()) return;
  for (std::size_t k = 0; k < block.rows; ++k) to.push_back(static_cast<float>(upstream_Pa[k] - downstream_Pa[k]));
}

}  // namespace

RunSamples estimate_run(const model::Model& model, const std::filesystem::path& recording,
                        const recording::ChannelMap& channels, const std::vector<estimation::Estimator>& estimators,
                        const std::function<void(double)>& progress) {
  recording::ReadOptions options = estimation::sensor_channels(model, channels);
  for (const Channel channel :
       {Channel::position_set, Channel::flow_reference, Channel::flow, Channel::pressure_difference,
        Channel::pressure_upstream, Channel::pressure_downstream}) {
    options.optional.push_back(channel);
  }
  const auto reader = estimation::open_sensor_channels(recording, options);
  const Channel reference = reader->has(Channel::flow_reference) ? Channel::flow_reference : Channel::flow;
  RunSamples run;
  std::vector<estimation::RunningSensor> sensors;
  std::optional<monitor::Monitor> watch;
  for (const estimation::Estimator estimator : estimators) {
    sensors.push_back(estimation::running_sensor(model, estimator));
    run.answers.emplace_back().estimator = estimator;
    if (estimator == estimation::Estimator::observer) watch.emplace(model);
  }
  recording::SampleBlock block;
  std::vector<sensor::Estimate<double>> estimates;
  while (reader->next(block)) {
    const estimation::Columns columns = estimation::sensor_columns(block);
    estimates.resize(block.rows);
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      estimation::run(sensors[s], columns, estimates);
      append(run.answers[s], estimates);
      if (estimators[s] == estimation::Estimator::observer) watch->take(columns, estimates);
    }
    run.means.take(block);
    append(run.time_s, block, Channel::time);
    append(run.position_m, block, Channel::position);
    append(run.position_set, block, Channel::position_set);
    append_of_coils(run.current_A, block, {Channel::current, Channel::current_a, Channel::current_b});
    append_of_coils(run.voltage_V, block, {Channel::voltage, Channel::voltage_a, Channel::voltage_b});
    append(run.oil_temperature_K, block, Channel::oil_temperature);
    append(run.reference_m3_per_s, block, reference);
    append_pressure_difference(run.pressure_difference_Pa, block);
    progress(reader->progress().value_or(0));
  }
  run.notes = reader->notes();
  if (watch) monitor::add_contradiction(*watch, recording.string(), run.contradictions);
  return run;
}

KnownMeter meter_of(const model::Model& model, const RunSamples& run) {
  if (run.reference_m3_per_s.empty()) return {};
  const std::vector<double> reference = in_double(run.reference_m3_per_s);
  std::vector<double> flow = in_double(run.answers.back().flow_m3_per_s);
  std::optional<numerics::MeterLag> found = numerics::find_meter_lag(run.time_s, flow, reference);
  if (!found && model.has_observer() && !run.pressure_difference_Pa.empty()) {
    const estimation::PassedEdges edges{&model.observer->parameters,
                                        model.p_to_a ? &model.p_to_a->observer->parameters : nullptr};
    flow = estimation::edge_flow(edges, run.position_m, in_double(run.pressure_difference_Pa),
                                 in_double(run.oil_temperature_K));
    found = numerics::find_lag_of_known_flow(run.time_s, flow, reference);
  }
  if (!found) return {};
  return {*found, numerics::meter_lag_uncertainty(run.time_s, flow, reference, *found), MeterSource::this_run};
}

void apply_lag(std::span<const double> time_s, Answers& answers, const numerics::MeterLag& meter) {
  for (std::vector<float>* column : {&answers.flow_m3_per_s, &answers.lower_m3_per_s, &answers.upper_m3_per_s}) {
    numerics::apply_lag<float>(time_s, *column, meter);
  }
}

}  // namespace spoolflow::validation
