#pragma once
/// Static hysteresis of the iron: a field of parallel stop elements (Prandtl) on top of the anhysteretic curve.
///
///     H = H_an(B) + sum_k h_k,   h_k <- clamp(h_k + s_k dB, -kappa_k, +kappa_k)
///
/// Each element is an elastic, perfectly plastic spring between B and H: it stores h_k^2/(2 s_k) and dissipates
/// kappa_k |dB| while it yields, so the operator is thermodynamically consistent, every minor loop closes, and the
/// enclosed area is the loss. It is the stop form of the energy-based play model (Bergqvist 1997; Francois-Lavet,
/// Henrotte et al. 2013), written for flux as input. Rate-independent; leaves out the narrowing of loops in saturation.
#include <algorithm>
#include <array>
#include <cmath>

#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/plant/magnetic_material.hpp"

namespace spoolflow::rig {

struct MagneticHysteresis {
  double coercive_field_A_per_m = 110.0;
  double reversal_width_T = 0.30;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"coercive_field_A_per_m", "A/m", 0, 600, "annealed low-carbon steel 60 to 200; 0 is lossless iron"},
          self.coercive_field_A_per_m);
    visit(Parameter{"reversal_width_T", "T", 0.02, 1.0, "flux change that brings the last element to yield"},
          self.reversal_width_T);
  }
};

inline constexpr std::size_t hysteresis_elements = 5;
/// Field of each stop element [A/m].
using HysteresisState = std::array<double, hysteresis_elements>;

/// The elements' constants: equal shares of the coercive field as yield, and elastic slopes by which element k yields
/// after the share (k + 1)/n of the reversal width.
struct StopElements {
  double yield_A_per_m;                                   ///< kappa_k
  std::array<double, hysteresis_elements> slope_m_per_H;  ///< s_k
};

inline StopElements stop_elements(const MagneticHysteresis& hysteresis) {
  StopElements stops{};
  stops.yield_A_per_m = hysteresis.coercive_field_A_per_m / static_cast<double>(hysteresis_elements);
  for (std::size_t k = 0; k < hysteresis_elements; ++k) {
    stops.slope_m_per_H[k] =
        hysteresis.coercive_field_A_per_m / (hysteresis.reversal_width_T * static_cast<double>(k + 1));
  }
  return stops;
}

/// The elements after a monotone change of the flux density.
inline HysteresisState advanced(const StopElements& stops, HysteresisState elements, double change_T) {
  for (std::size_t k = 0; k < hysteresis_elements; ++k) {
    elements[k] =
        std::clamp(elements[k] + stops.slope_m_per_H[k] * change_T, -stops.yield_A_per_m, stops.yield_A_per_m);
  }
  return elements;
}

/// Sum of the elements' fields after a monotone change of the flux density, and its slope there.
inline FieldPoint hysteretic_field(const StopElements& stops, const HysteresisState& elements, double change_T) {
  FieldPoint sum{0.0, 0.0};
  for (std::size_t k = 0; k < hysteresis_elements; ++k) {
    const double elastic = elements[k] + stops.slope_m_per_H[k] * change_T;
    sum.field_A_per_m += std::min(std::max(elastic, -stops.yield_A_per_m), stops.yield_A_per_m);
    sum.slope_m_per_H += std::abs(elastic) < stops.yield_A_per_m ? stops.slope_m_per_H[k] : 0.0;
  }
  return sum;
}

/// Recoverable energy density [J/m3] in the elements.
inline double hysteretic_energy(const StopElements& stops, const HysteresisState& elements) {
  double energy = 0.0;
  for (std::size_t k = 0; k < hysteresis_elements; ++k) {
    if (stops.slope_m_per_H[k] > 0.0) energy += 0.5 * elements[k] * elements[k] / stops.slope_m_per_H[k];
  }
  return energy;
}

/// Energy density [J/m3] dissipated while the flux density changes monotonely: each element's yield field times the
/// part of the change over which it yields.
inline double hysteresis_loss(const StopElements& stops, const HysteresisState& elements, double change_T) {
  double loss = 0.0;
  for (std::size_t k = 0; k < hysteresis_elements; ++k) {
    const double beyond = std::abs(elements[k] + stops.slope_m_per_H[k] * change_T) - stops.yield_A_per_m;
    if (beyond > 0.0) loss += stops.yield_A_per_m * beyond / stops.slope_m_per_H[k];
  }
  return loss;
}

}  // namespace spoolflow::rig
