#pragma once
#include <functional>

namespace spoolflow::plausibility {

/// A coil as calibrated.
struct KnownCoil {
  double resistance_Ohm = 0;                                             ///< 0: not known
  std::function<double(double current_A, double position_m)> flux_Wb{};  ///< its flux linkage; empty: not known
};

}  // namespace spoolflow::plausibility
