#pragma once
/// Iron after Jiles and Atherton, J. Magn. Magn. Mater. 61 (1986) 48, with the flux density as input (Sadowski et al.
/// 2002): domain walls lag behind the anhysteretic state because they are pinned.
///
///     H_e  = H + (alpha/mu0) J                      effective field; J = B - mu0 H
///     J    = (1 - c) J_irr + c J_an(H_e)            c bends reversibly
///     dJ_irr/dH_e = |J_an - J_irr|/k  where the walls are driven towards J_an, else 0
///
/// J_an belongs to the material's anhysteretic curve: with b the flux density that stands on it at the same effective
/// field, H_e = H_an(b) + (alpha/mu0) J_an, J_an = b - mu0 H_an(b). The second line of the last equation keeps every
/// susceptibility positive (Deane 1994; Carpenter 1991): after a reversal the walls stand until J_an has come past
/// them. A step of any length solves
///
///     mu0 H_e(b) + (1 - alpha) J(b) = B
///
/// for b, the lag J_an - J_irr in it by an L-stable rational of second order, under which J_irr never runs backwards.
/// Passive: the lag stores energy and gives back no more. Minor loops creep towards the anhysteretic state instead of
/// closing (accommodation). Rate-independent; leaves out the pinning's fall in saturation.
#include <algorithm>
#include <cmath>

#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/plant/magnetic_material.hpp"

namespace spoolflow::rig {

struct JilesAtherton {
  double reversible_share = 0.2;
  double coupling = 1.0e-4;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"reversible_share", "1", 0, 0.9, "c: walls that bend and spring back; steels 0.1 to 0.5"},
          self.reversible_share);
    visit(Parameter{"coupling", "1", 0, 2e-3, "alpha: field of the neighbouring domains over their magnetisation"},
          self.coupling);
  }
};

/// The model's constants; the pinning k makes the given coercive field where the walls follow steadily: (1 - c) k.
struct JilesAthertonIron {
  AnhystereticCurve anhysteretic;
  double per_pinning_m_per_A;  ///< 1/k; 0 stands for no pinning at all
  double reversible;           ///< c
  double coupling_m_per_H;     ///< alpha/mu0
  double uncoupled;            ///< 1 - alpha
};

inline JilesAthertonIron jiles_atherton_iron(const MagneticMaterial& material, const JilesAtherton& shape,
                                             double coercive_field_A_per_m) {
  const double pinning_A_per_m = coercive_field_A_per_m / (1.0 - shape.reversible_share);
  return {.anhysteretic = anhysteretic_curve(material),
          .per_pinning_m_per_A = pinning_A_per_m > 0.0 ? 1.0 / pinning_A_per_m : 0.0,
          .reversible = shape.reversible_share,
          .coupling_m_per_H = shape.coupling / vacuum_permeability_H_per_m,
          .uncoupled = 1.0 - shape.coupling};
}

/// What the iron remembers; {} is demagnetised.
struct JilesAthertonMemory {
  double anhysteretic_T = 0.0;  ///< b
  double irreversible_T = 0.0;  ///< J_irr
};

namespace jiles_atherton {

/// The anhysteretic state at b.
struct Anhysteretic {
  double effective_A_per_m, effective_slope_m_per_H;  ///< H_e and dH_e/db
  double polarisation_T, polarisation_slope;          ///< J_an and dJ_an/db
};

inline Anhysteretic anhysteretic_at(const JilesAthertonIron& iron, double b_T) {
  const FieldPoint field = anhysteretic_field(iron.anhysteretic, b_T);
  const double polarisation_T = b_T - vacuum_permeability_H_per_m * field.field_A_per_m;
  const double slope = 1.0 - vacuum_permeability_H_per_m * field.slope_m_per_H;
  return {field.field_A_per_m + iron.coupling_m_per_H * polarisation_T,
          field.slope_m_per_H + iron.coupling_m_per_H * slope, polarisation_T, slope};
}

/// J_irr and its slope over b, driven monotonely from the memory's state `start` to `end`.
struct Pinned {
  double irreversible_T, slope;
};

inline Pinned pinned(const JilesAthertonIron& iron, double irreversible_T, const Anhysteretic& start,
                     const Anhysteretic& end) {
  const double direction = end.effective_A_per_m < start.effective_A_per_m ? -1.0 : 1.0;
  const double lag_T = direction * (start.polarisation_T - irreversible_T);
  const double change_T = direction * (end.polarisation_T - start.polarisation_T);
  const double driven_T = change_T + std::min(lag_T, 0.0);  // what comes behind the point where J_an passes the walls
  if (driven_T <= 0.0) return {irreversible_T, 0.0};
  const double share = lag_T < 0.0 ? driven_T / change_T : 1.0;
  const double way = direction * (end.effective_A_per_m - start.effective_A_per_m) * iron.per_pinning_m_per_A;
  const double z = way * share;
  const double per_decay = 1.0 / (1.0 + z + 0.5 * z * z);
  const double end_lag_T = (driven_T * (1.0 + 0.5 * z) + std::max(lag_T, 0.0)) * per_decay;
  double z_slope = end.effective_slope_m_per_H * iron.per_pinning_m_per_A * share;
  if (lag_T < 0.0) z_slope += way * end.polarisation_slope * (1.0 - share) / change_T;
  const double lag_slope =
      (end.polarisation_slope * (1.0 + 0.5 * z) + 0.5 * driven_T * z_slope - end_lag_T * (1.0 + z) * z_slope) *
      per_decay;
  return {end.polarisation_T - direction * end_lag_T, end.polarisation_slope - lag_slope};
}

/// The iron at one flux density.
struct Point {
  FieldPoint field;
  JilesAthertonMemory memory;
};

/// After a monotone change to that flux density.
inline Point at(const JilesAthertonIron& iron, const JilesAthertonMemory& memory, double flux_density_T) {
  if (iron.per_pinning_m_per_A == 0.0) {
    const Anhysteretic free = anhysteretic_at(iron, flux_density_T);
    return {anhysteretic_field(iron.anhysteretic, flux_density_T), {flux_density_T, free.polarisation_T}};
  }
  const Anhysteretic start = anhysteretic_at(iron, memory.anhysteretic_T);
  constexpr double nearly_T = 1e-7;  // from there Newton's next step is exact to rounding
  const double start_T =
      vacuum_permeability_H_per_m * start.effective_A_per_m +
      iron.uncoupled * ((1.0 - iron.reversible) * memory.irreversible_T + iron.reversible * start.polarisation_T);
  double b = memory.anhysteretic_T + (flux_density_T - start_T);
  double below = -HUGE_VAL, above = HUGE_VAL;  // between which b lies
  Point point{};
  for (int tries = 0; tries < 60; ++tries) {
    const Anhysteretic end = anhysteretic_at(iron, b);
    const Pinned walls = pinned(iron, memory.irreversible_T, start, end);
    const double polarisation_T = (1.0 - iron.reversible) * walls.irreversible_T + iron.reversible * end.polarisation_T;
    const double slope = (1.0 - iron.reversible) * walls.slope + iron.reversible * end.polarisation_slope;
    const double flux_slope = vacuum_permeability_H_per_m * end.effective_slope_m_per_H + iron.uncoupled * slope;
    const double missing_T =
        flux_density_T - vacuum_permeability_H_per_m * end.effective_A_per_m - iron.uncoupled * polarisation_T;
    point = {{end.effective_A_per_m - iron.coupling_m_per_H * polarisation_T,
              (end.effective_slope_m_per_H - iron.coupling_m_per_H * slope) / flux_slope},
             {b, walls.irreversible_T}};
    (missing_T > 0.0 ? below : above) = b;
    const double left = missing_T / flux_slope;
    b += left;
    if (std::abs(missing_T) <= nearly_T) {
      point.field.field_A_per_m += point.field.slope_m_per_H * missing_T;
      point.memory = {b, walls.irreversible_T + walls.slope * left};
      break;
    }
    if (!(b > below && b < above)) b = 0.5 * (below + above);
  }
  return point;
}

}  // namespace jiles_atherton

/// The field at a flux density reached monotonely.
inline FieldPoint field_at(const JilesAthertonIron& iron, const JilesAthertonMemory& memory, double flux_density_T) {
  return jiles_atherton::at(iron, memory, flux_density_T).field;
}

/// Moves the memory to a flux density reached monotonely; returns the field [A/m].
inline double magnetise(const JilesAthertonIron& iron, JilesAthertonMemory& memory, double flux_density_T) {
  const jiles_atherton::Point point = jiles_atherton::at(iron, memory, flux_density_T);
  memory = point.memory;
  return point.field.field_A_per_m;
}

}  // namespace spoolflow::rig
