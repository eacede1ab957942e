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

/// The change is seen so that it goes upwards: then a stop can yield at its upper end only, one comparison each.
template <class T>
constexpr HysteresisPoint<T> hysteresis_at(const MagneticHysteresis<T>& hysteresis, const HysteresisState<T>& state,
                                           T flux) {
  const T change = flux - state.flux;
  const T sign = select(change < T(0), T(-1), T(1));
  const T size = magnitude(change);
  const T share = smaller(magnitude(flux) * hysteresis.per_full_flux, T(1));
  T value(0), slope(0);
#pragma GCC unroll 8
  for (unsigned k = 0; k < hysteresis_elements; ++k) {
    const T threshold = hysteresis.threshold[k];
    const T stiffness = hysteresis.stiffness[k] + share * hysteresis.stiffness_increase[k];
    const T elastic = sign * state.deflection[k] + size;
    const auto yields = elastic > threshold;
    value += stiffness * select(yields, threshold, elastic);
    slope += select(yields, T(0), stiffness);
  }
  return {sign * value, slope};
}

/// Moves the memory to a new flux and answers there.
template <class T>
constexpr T advance(const MagneticHysteresis<T>& hysteresis, HysteresisState<T>& state, T flux) {
  const T change = flux - state.flux;
  const T sign = select(change < T(0), T(-1), T(1));
  const T size = magnitude(change);
  const T share = smaller(magnitude(flux) * hysteresis.per_full_flux, T(1));
  T value(0);
#pragma GCC unroll 8
  for (unsigned k = 0; k < hysteresis_elements; ++k) {
    const T deflection = smaller(sign * state.deflection[k] + size, hysteresis.threshold[k]);
    state.deflection[k] = sign * deflection;
    value += (hysteresis.stiffness[k] + share * hysteresis.stiffness_increase[k]) * deflection;
  }
  state.flux = flux;
  return sign * value;
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
