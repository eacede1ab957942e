#pragma once
#include <array>
#include <type_traits>

#include "spoolflow/sensor/scalar.hpp"

namespace spoolflow::sensor {

inline constexpr int hysteresis_elements = 8;

/// Magnetic hysteresis with memory: what a material or a coil asks for beyond its anhysteretic curve. A sum of stop
/// operators (Prandtl-Ishlinskii), driven by the flux: each follows the flux elastically and yields at its threshold.
/// The stiffness goes linearly from its value without flux to that at `full_flux`, which lets loops change width with
/// saturation. Static: rate effects are eddy currents. Input and output are flux linkage [Wb] and current [A] in a
/// solenoid, flux density [T] and field strength [A/m] in a material. Kuhnen, Inverse Steuerung piezoelektrischer
/// Aktoren (2001); Brokate and Sprekels, Hysteresis and Phase Transitions (1996), section 2.
template <class T>
struct MagneticHysteresis {
  std::array<T, hysteresis_elements> threshold{};           ///< of flux, > 0, ascending
  std::array<T, hysteresis_elements> stiffness{};           ///< output per flux at no flux, >= 0
  std::array<T, hysteresis_elements> stiffness_increase{};  ///< what is added to it at full flux
  T per_full_flux{};                                        ///< 1 / full flux
};

/// The memory of the hysteresis; {} is demagnetised.
template <class T>
struct HysteresisState {
  T flux{};
  std::array<T, hysteresis_elements> deflection{};  ///< of each stop, within plus or minus its threshold
};

static_assert(std::is_trivially_copyable_v<HysteresisState<float>>);

/// As {} would; no block of memory is cleared, for which a compiler may want a library.
template <class T>
constexpr void demagnetise(HysteresisState<T>& state) {
  state.flux = T(0);
  for (T& deflection : state.deflection) deflection = T(0);
}

/// What the hysteresis would answer at another flux.
template <class T>
struct HysteresisPoint {
  T value;
  T slope;  ///< d value / d flux, >= 0, without the change of stiffness
};

template <class T>
constexpr HysteresisPoint<T> hysteresis_at(const MagneticHysteresis<T>& hysteresis, const HysteresisState<T>& state,
                                           T flux) {
  const T change = flux - state.flux;
  T value(0), increase(0), slope(0), slope_increase(0);
  for (unsigned k = 0; k < hysteresis_elements; ++k) {
    const T threshold = hysteresis.threshold[k];
    const T elastic = state.deflection[k] + change;
    const T deflection = limited(elastic, -threshold, threshold);
    const T yields = select(elastic == deflection, T(1), T(0));
    value += hysteresis.stiffness[k] * deflection;
    increase += hysteresis.stiffness_increase[k] * deflection;
    slope += hysteresis.stiffness[k] * yields;
    slope_increase += hysteresis.stiffness_increase[k] * yields;
  }
  const T share = smaller(magnitude(flux) * hysteresis.per_full_flux, T(1));
  return {value + share * increase, slope + share * slope_increase};
}

/// Moves the memory to a new flux and answers there.
template <class T>
constexpr T advance(const MagneticHysteresis<T>& hysteresis, HysteresisState<T>& state, T flux) {
  const T change = flux - state.flux;
  T value(0), increase(0);
  for (unsigned k = 0; k < hysteresis_elements; ++k) {
    const T threshold = hysteresis.threshold[k];
    state.deflection[k] = limited(state.deflection[k] + change, -threshold, threshold);
    value += hysteresis.stiffness[k] * state.deflection[k];
    increase += hysteresis.stiffness_increase[k] * state.deflection[k];
  }
  state.flux = flux;
  return value + smaller(magnitude(flux) * hysteresis.per_full_flux, T(1)) * increase;
}

/// The largest output, reached far from the last reversal, at a share 0 to 1 of full flux: the coercive current.
template <class T>
constexpr T saturated_output(const MagneticHysteresis<T>& hysteresis, T share) {
  T sum(0);
  for (unsigned k = 0; k < hysteresis_elements; ++k)
    sum += (hysteresis.stiffness[k] + share * hysteresis.stiffness_increase[k]) * hysteresis.threshold[k];
  return sum;
}

}  // namespace spoolflow::sensor
