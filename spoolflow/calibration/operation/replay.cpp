#include "spoolflow/calibration/operation/replay.hpp"

#include "spoolflow/estimation/edge_flow.hpp"
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

/// Beside what the edge passes at the measured pressure difference; where that does not show it, beside the answers.
numerics::MeterLag meter_of(const sensor::ObserverParameters<double>& parameters, OperatingRun run) {
  const recording::Recording& recording = *run.recording;
  if (const std::span<const double> pressure_Pa = recording.column(Channel::pressure_difference);
      !pressure_Pa.empty()) {
    const estimation::PassedEdges edges{run.of == RunOf::other ? run.other : &parameters,
                                        run.of == RunOf::both ? run.other : nullptr};
    const std::vector<double> flow = estimation::edge_flow(edges, recording[Channel::position], pressure_Pa,
                                                           recording.column(Channel::oil_temperature));
    if (const auto found =
            numerics::find_lag_of_known_flow(recording[Channel::time], flow, recording[Channel::flow_reference]))
      return *found;
  }
  run.meter = {};
  std::vector<double> time_s, flow_m3_per_s, reference_m3_per_s;
  replay(parameters, {run}, [&](const ReplayedSample& sample) {
    time_s.push_back(sample.time_s);
    flow_m3_per_s.push_back(sample.shown.flow);
    reference_m3_per_s.push_back(sample.reference_m3_per_s);
  });
  return numerics::find_meter_lag(time_s, flow_m3_per_s, reference_m3_per_s).value_or(numerics::MeterLag{});
}

}  // namespace

std::vector<OperatingRun> with_meters(const sensor::ObserverParameters<double>& parameters,
                                      std::vector<OperatingRun> runs) {
  for (OperatingRun& run : runs) run.meter = meter_of(parameters, run);
  return runs;
}

}  // namespace spoolflow::calibration
