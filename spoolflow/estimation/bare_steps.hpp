#pragma once
/// The sensor's step alone over samples that carry their time steps, as a valve's firmware calls it: in the scalar of
/// its state, without what a running sensor tells of times and before its first complete sample.
#include <span>
#include <vector>

#include "spoolflow/sensor/sample.hpp"

namespace spoolflow::estimation {

/// The flow rate of every answer [m3/s]. `state` is that before the first sample.
template <class Parameters, template <class> class State, class T>
std::vector<T> stepped_flows(const Parameters& parameters, State<T> state,
                             std::span<const sensor::Sample<float>> samples) {
  std::vector<T> out;
  out.reserve(samples.size());
  for (const sensor::Sample<float>& in : samples) {
    const sensor::Sample<T> sample{in.time_step_s, in.current_A, in.voltage_V, in.position_m, in.oil_temperature_K};
    out.push_back(step(parameters, state, sample).flow_m3_per_s);
  }
  return out;
}

}  // namespace spoolflow::estimation
