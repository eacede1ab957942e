#pragma once
#include <array>
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/scalar.hpp"

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

/// The memory of the hysteresis; {} is demagnetised. A stop is kept by the flux about which it is elastic, which only
/// its yielding changes.
template <class T>
struct HysteresisState {
  T flux{};
  std::array<T, hysteresis_elements> centre{};  ///< flux at which each stop stands undeflected
};

static_assert(std::is_trivially_copyable_v<HysteresisState<float>>);

namespace detail {

/// Centres stop K and those after it at the flux: one store each.
template <unsigned K, class T>
SPOOLFLOW_INLINE constexpr void centre_stops(HysteresisState<T>& state, T flux) {
  if constexpr (K < hysteresis_elements) {
    state.centre[K] = flux;
    centre_stops<K + 1>(state, flux);
  }
}

}  // namespace detail

/// Demagnetised about a flux: the middle of all that an unknown history may have left there. No block of memory is
/// moved, for which a compiler may want a library.
template <class T>
constexpr void demagnetise(HysteresisState<T>& state, T flux) {
  state.flux = flux;
  detail::centre_stops<0>(state, flux);
}

/// What the hysteresis would answer at another flux.
template <class T>
struct HysteresisPoint {
  T value;
  T slope;  ///< d value / d flux, >= 0, without the change of stiffness
};

namespace detail {

/// How far a stop would stand, were it elastic, on the way on which the flux comes: it can yield at one end only.
template <bool Rising, class T>
constexpr T elastic(T centre, T flux) {
  if constexpr (Rising) return flux - centre;
  return centre - flux;
}

/// A sum over stops, linear in the share 0 to 1 of full flux as their stiffness is.
template <class T>
struct StopSum {
  T without_flux{};
  T increase{};

  [[nodiscard]] constexpr T at(T share) const { return without_flux + share * increase; }
};

/// Adds `times` the stiffness of stop K.
template <unsigned K, class T>
constexpr StopSum<T> with_stop(const StopSum<T>& sum, const MagneticHysteresis<T>& hysteresis, T times) {
  return {sum.without_flux + hysteresis.stiffness[K] * times, sum.increase + hysteresis.stiffness_increase[K] * times};
}

/// What the stops before stop K answer where they yield. Of parameters that are compiled in these are numbers, too.
template <unsigned K, class T>
constexpr StopSum<T> yielded_before(const MagneticHysteresis<T>& hysteresis) {
  if constexpr (K > 0)
    return with_stop<K - 1>(yielded_before<K - 1>(hysteresis), hysteresis, hysteresis.threshold[K - 1]);
  return {};
}

/// Stiffness of stop K and those after it together.
template <unsigned K, class T>
constexpr StopSum<T> stiffness_from(const MagneticHysteresis<T>& hysteresis) {
  if constexpr (K < hysteresis_elements) return with_stop<K>(stiffness_from<K + 1>(hysteresis), hysteresis, T(1));
  return {};
}

/// Adds what stop K and those after it answer, which hold.
template <bool Rising, unsigned K, class T>
SPOOLFLOW_INLINE constexpr StopSum<T> with_held(const StopSum<T>& sum, const MagneticHysteresis<T>& hysteresis,
                                                const HysteresisState<T>& state, T flux) {
  if constexpr (K < hysteresis_elements) {
    return with_held<Rising, K + 1>(with_stop<K>(sum, hysteresis, elastic<Rising>(state.centre[K], flux)), hysteresis,
                                    state, flux);
  }
  return sum;
}

/// What all stops answer on this way, those before stop K yielding. Where one holds, all with higher thresholds hold:
/// two stops never lie further apart than their thresholds do.
template <bool Rising, unsigned K, class T>
SPOOLFLOW_INLINE constexpr HysteresisPoint<T> answer_of_stops(const MagneticHysteresis<T>& hysteresis,
                                                              const HysteresisState<T>& state, T flux, T share) {
  if constexpr (K < hysteresis_elements) {
    if (lies_below(hysteresis.threshold[K], elastic<Rising>(state.centre[K], flux)))
      return answer_of_stops<Rising, K + 1>(hysteresis, state, flux, share);
  }
  const StopSum<T> sum = with_held<Rising, K>(yielded_before<K>(hysteresis), hysteresis, state, flux);
  return {sum.at(share), stiffness_from<K>(hysteresis).at(share)};
}

/// Moves stop K and those after it, up to the first that holds.
template <bool Rising, unsigned K, class T>
SPOOLFLOW_INLINE constexpr void move_stops(const MagneticHysteresis<T>& hysteresis, HysteresisState<T>& state, T flux) {
  if constexpr (K < hysteresis_elements) {
    const T yielded = Rising ? flux - hysteresis.threshold[K] : flux + hysteresis.threshold[K];
    const bool yields = Rising ? yielded > state.centre[K] : yielded < state.centre[K];
    if (!yields) return;
    state.centre[K] = yielded;
    move_stops<Rising, K + 1>(hysteresis, state, flux);
  }
}

}  // namespace detail

template <class T>
constexpr HysteresisPoint<T> hysteresis_at(const MagneticHysteresis<T>& hysteresis, const HysteresisState<T>& state,
                                           T flux) {
  const T share = from_zero_to(T(1), magnitude(flux) * hysteresis.per_full_flux);
  if (!(flux < state.flux)) return detail::answer_of_stops<true, 0>(hysteresis, state, flux, share);
  const HysteresisPoint<T> falling = detail::answer_of_stops<false, 0>(hysteresis, state, flux, share);
  return {-falling.value, falling.slope};
}

/// How far a stop stands off its centre, within plus or minus its threshold.
template <class T>
constexpr T deflection(const HysteresisState<T>& state, unsigned k) {
  return state.flux - state.centre[k];
}

/// Moves the memory to a new flux.
template <class T>
constexpr void advance(const MagneticHysteresis<T>& hysteresis, HysteresisState<T>& state, T flux) {
  if (flux < state.flux) {
    detail::move_stops<false, 0>(hysteresis, state, flux);
  } else {
    detail::move_stops<true, 0>(hysteresis, state, flux);
  }
  state.flux = flux;
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
