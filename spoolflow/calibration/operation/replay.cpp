#include "spoolflow/calibration/operation/replay.hpp"

#include "spoolflow/recording/coil_channels.hpp"

namespace spoolflow::calibration {

using recording::Channel;

estimation::Columns operating_columns(const recording::Recording& recording) {
  const recording::CoilChannels coil = recording::coil_channels(recording);
  return {.time_s = recording[Channel::time],
          .current_A = recording[coil.current],
          .voltage_V = recording.column(coil.voltage),
          .position_m = recording[Channel::position],
          .oil_temperature_K = recording.column(Channel::oil_temperature),
          .current_a_A = recording.column(Channel::current_a),
          .voltage_a_V = recording.column(Channel::voltage_a)};
}

estimation::RunningSensor operating_sensor(const sensor::ObserverParameters<double>& parameters,
                                           const OperatingRun& run) {
  constexpr double rated_flow_m3_per_s = 0;  // used before the first complete sample only, which nobody reads
  switch (run.of) {
    case RunOf::one:
      break;
    case RunOf::other:
      return {run.other, rated_flow_m3_per_s};
    case RunOf::both:
      return {sensor::WholeValveParameters<double>{&parameters, run.other}, rated_flow_m3_per_s};
  }
  return {&parameters, rated_flow_m3_per_s};
}

void share_operation(const sensor::ObserverParameters<double>& from, sensor::ObserverParameters<double>& to) {
  const double operation_ratio = to.friction.operation_ratio;
  to.friction = from.friction;
  to.friction.operation_ratio = operation_ratio;
  to.pressure = from.pressure;
  to.position_sensor.backlash_m = from.position_sensor.backlash_m;
  to.moving_mass_kg = from.moving_mass_kg;
  const sensor::BandParameters<double> maps = to.band;
  to.band = from.band;
  to.band.force_residual_N = maps.force_residual_N;
  to.band.flow_residual_m3_per_s = maps.flow_residual_m3_per_s;
}

namespace {

/// Flow and reference at the same times, from complete samples.
struct BesideMeter {
  std::vector<double> time_s, flow_m3_per_s, reference_m3_per_s;

  void add(double at_s, double flow, double reference) {
    time_s.push_back(at_s);
    flow_m3_per_s.push_back(flow);
    reference_m3_per_s.push_back(reference);
  }
};

/// What the edge passes at the measured pressure difference; empty where that was not recorded. No force errs in it.
BesideMeter flow_of_edge(const sensor::ObserverParameters<double>& parameters, const OperatingRun& run) {
  const recording::Recording& recording = *run.recording;
  const std::span<const double> pressure_Pa = recording.column(Channel::pressure_difference);
  const std::span<const double> oil_K = recording.column(Channel::oil_temperature);
  const std::span<const double> time_s = recording[Channel::time], position_m = recording[Channel::position];
  const std::span<const double> reference_m3_per_s = recording[Channel::flow_reference];
  double temperature_K = parameters.edge.temperature_K.at(sensor::edge_temperatures / 2);
  BesideMeter out;
  for (std::size_t k = 0; k < pressure_Pa.size(); ++k) {
    if (!oil_K.empty() && std::isfinite(oil_K[k])) temperature_K = oil_K[k];
    const double opening_m = sensor::drift_free_m(parameters.position_sensor, position_m[k], temperature_K);
    if (!std::isfinite(opening_m + pressure_Pa[k])) continue;
    const bool other = run.of == RunOf::other || (run.of == RunOf::both && opening_m < 0);
    const sensor::MeteringEdge<double>& edge = other ? run.other->edge : parameters.edge;
    const double sign = run.of == RunOf::both && other ? -1 : 1, drop_Pa = std::abs(pressure_Pa[k]);
    out.add(time_s[k], sign * edge.at(temperature_K, drop_Pa, sign * opening_m).conductance * std::sqrt(drop_Pa),
            reference_m3_per_s[k]);
  }
  return out;
}

numerics::MeterLag meter_of(const sensor::ObserverParameters<double>& parameters, OperatingRun run) {
  const BesideMeter known = flow_of_edge(parameters, run);
  if (const auto found = numerics::find_lag_of_known_flow(known.time_s, known.flow_m3_per_s, known.reference_m3_per_s))
    return *found;
  run.meter = {};
  BesideMeter answered;
  replay(parameters, {run}, [&](const ReplayedSample& sample) {
    answered.add(sample.time_s, sample.shown.flow, sample.reference_m3_per_s);
  });
  return numerics::find_meter_lag(answered.time_s, answered.flow_m3_per_s, answered.reference_m3_per_s)
      .value_or(numerics::MeterLag{});
}

}  // namespace

std::vector<OperatingRun> with_meters(const sensor::ObserverParameters<double>& parameters,
                                      std::vector<OperatingRun> runs) {
  for (OperatingRun& run : runs) run.meter = meter_of(parameters, run);
  return runs;
}

}  // namespace spoolflow::calibration
