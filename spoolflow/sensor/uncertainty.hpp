#pragma once
#include "spoolflow/sensor/flow_rate.hpp"

namespace spoolflow::sensor {

/// Ends of a band of flow rates [m3/s].
template <class T>
struct FlowBand {
  T lower_m3_per_s;
  T upper_m3_per_s;
};

/// The band of flow rates that a band of flow forces means: the map's own slope turns newtons into flow, so the band is
/// wide where the force curve is flat. `flow_residual_m3_per_s` is added on both sides for what the map itself misses.
template <class T>
constexpr FlowBand<T> flow_band(const FlowRate<T>& flow_rate, const FlowRatePosition<T>& position, T flow_force_N,
                                T force_uncertainty_N, T flow_residual_m3_per_s) {
  const T low = flow_rate.at(flow_force_N - force_uncertainty_N, position).flow_m3_per_s;
  const T high = flow_rate.at(flow_force_N + force_uncertainty_N, position).flow_m3_per_s;
  return {low - flow_residual_m3_per_s, high + flow_residual_m3_per_s};
}

}  // namespace spoolflow::sensor
