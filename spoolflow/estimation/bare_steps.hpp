#pragma once
/// The sensor's step alone over samples that carry their time steps, as a valve's firmware calls it: in the scalar of
/// its state, without what a running sensor adds about times and before its first complete sample.
#include <vector>

#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve_sample.hpp"

namespace spoolflow::estimation {

/// The same sample in another scalar.
template <class T>
constexpr sensor::Sample<T> in_scalar(const sensor::Sample<float>& in) {
  return {in.time_step_s, in.current_A, in.voltage_V, in.position_m, in.oil_temperature_K};
}
template <class T>
constexpr sensor::WholeValveSample<T> in_scalar(const sensor::WholeValveSample<float>& in) {
  return {in.time_step_s,       in.current_a_A,
          in.current_b_A,       in.voltage_a_V,
          in.voltage_b_V,       in.position_m,
          in.oil_temperature_K, {in.ports.p_Pa, in.ports.a_Pa, in.ports.b_Pa, in.ports.t_Pa}};
}

/// Every answer. `state` is that before the first sample; parameters, state and samples are of
/// one direction or of the whole valve.
template <class Parameters, template <class> class State, class T, template <class> class Sample>
std::vector<sensor::Estimate<T>> stepped(const Parameters& parameters, State<T> state,
                                         const std::vector<Sample<float>>& samples) {
  std::vector<sensor::Estimate<T>> out;
  out.reserve(samples.size());
  for (const Sample<float>& in : samples) out.push_back(step(parameters, state, in_scalar<T>(in)));
  return out;
}

/// The flow rate of every answer [m3/s].
template <class Parameters, template <class> class State, class T, template <class> class Sample>
std::vector<T> stepped_flows(const Parameters& parameters, State<T> state, const std::vector<Sample<float>>& samples) {
  std::vector<T> out;
  out.reserve(samples.size());
  for (const sensor::Estimate<T>& answer : stepped(parameters, state, samples)) out.push_back(answer.flow_m3_per_s);
  return out;
}

}  // namespace spoolflow::estimation
