#include "spoolflow/calibration/operation/replay.hpp"

namespace spoolflow::calibration {

using recording::Channel;

estimation::Columns operating_columns(const recording::Recording& recording) {
  // Both coils' currents where they are; else that of the only or the active one.
  const bool whole = recording.has(Channel::current_a) && recording.has(Channel::current_b);
  return {.time_s = recording[Channel::time],
          .current_A = recording[whole ? Channel::current_b : Channel::current],
          .voltage_V = recording.column(whole ? Channel::voltage_b : Channel::voltage),
          .position_m = recording[Channel::position],
          .oil_temperature_K = recording.column(Channel::oil_temperature),
          .current_a_A = recording.column(Channel::current_a),
          .voltage_a_V = recording.column(Channel::voltage_a)};
}

estimation::RunningSensor operating_sensor(const sensor::ObserverParameters<double>& parameters,
                                           const OperatingRun& run) {
  constexpr double rated_flow_m3_per_s = 0;  // told before the first complete sample only, which nobody looks at
  if (run.other == nullptr) return {&parameters, rated_flow_m3_per_s};
  sensor::WholeValveParameters<double> whole{&parameters, run.other};
  if (run.asks_a) std::swap(whole.b, whole.a);
  return {whole, rated_flow_m3_per_s};
}

std::vector<OperatingRun> with_meters(const sensor::ObserverParameters<double>& parameters,
                                      std::vector<OperatingRun> runs) {
  for (OperatingRun& run : runs) {
    std::vector<double> time_s, flow_m3_per_s, reference_m3_per_s;
    run.meter = {};
    replay(parameters, {run}, [&](const ReplayedSample& sample) {
      time_s.push_back(sample.time_s);
      flow_m3_per_s.push_back(sample.shown.flow);
      reference_m3_per_s.push_back(sample.reference_m3_per_s);
    });
    run.meter = numerics::find_meter_lag(time_s, flow_m3_per_s, reference_m3_per_s);
  }
  return runs;
}

}  // namespace spoolflow::calibration
