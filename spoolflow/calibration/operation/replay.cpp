#include "spoolflow/calibration/operation/replay.hpp"

namespace spoolflow::calibration {

std::vector<OperatingRun> with_meters(const sensor::ObserverParameters<double>& parameters,
                                      const std::vector<const recording::Recording*>& recordings) {
  std::vector<OperatingRun> out;
  for (const recording::Recording* recording : recordings) {
    std::vector<double> time_s, flow_m3_per_s, reference_m3_per_s;
    replay(parameters, {{recording, {}}}, [&](const ReplayedSample& sample) {
      time_s.push_back(sample.time_s);
      flow_m3_per_s.push_back(sample.shown.flow);
      reference_m3_per_s.push_back(sample.reference_m3_per_s);
    });
    out.push_back({recording, numerics::find_meter_lag(time_s, flow_m3_per_s, reference_m3_per_s)});
  }
  return out;
}

}  // namespace spoolflow::calibration
