#pragma once
/// The campaign's instruments, each described once; see describe_condensed.hpp.

namespace spoolflow::model {

/// visitor(key, optional number) of each; `instruments` may be const.
template <class Instruments, class Visitor>
void describe_instruments(Instruments& instruments, Visitor&& visitor) {
  visitor("position_uncertainty_95_m", instruments.position_m);
  visitor("current_uncertainty_95_A", instruments.current_A);
  visitor("force_uncertainty_95_N", instruments.force_N);
  visitor("pressure_uncertainty_95_Pa", instruments.pressure_Pa);
  visitor("temperature_uncertainty_95_K", instruments.temperature_K);
}

}  // namespace spoolflow::model
