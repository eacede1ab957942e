#pragma once
#include "spoolflow/sensor/scalar.hpp"

namespace spoolflow::sensor {

template <class T>
struct EddyCurrent {
  T current_A;
  T slope_A_per_V;
};

/// Currents that a changing flux drives in the iron, as seen from the coil: they carry part of the coil current that
/// makes no flux. A classical part in proportion to the rate of the flux linkage [V] and an excess part with its square
/// root. Bertotti, Hysteresis in Magnetism (1998), chapter 12; one stage of a Cauer ladder with a nonlinear branch.
/// Omits the delay with which flux enters the core (further stages).
template <class T>
struct EddyCurrents {
  T classical_A_per_V{};
  T excess_A_per_rootV{};
  T smallest_rate_V{T(1)};  ///< > 0; below it the excess part becomes proportional, too

  [[nodiscard]] constexpr EddyCurrent<T> at(T flux_rate_V) const {
    const T size = magnitude(flux_rate_V);
    const T per_root = T(1) / sqrt(size + smallest_rate_V);
    const T share = size * per_root * per_root;  // 0 where proportional, 1 where the root law holds
    const T excess = excess_A_per_rootV * per_root;
    return {(classical_A_per_V + excess) * flux_rate_V, classical_A_per_V + excess * (T(1) - T(0.5) * share)};
  }
};

}  // namespace spoolflow::sensor
