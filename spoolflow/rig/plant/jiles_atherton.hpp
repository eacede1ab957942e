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
#include <cmath>

#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"
#include "spoolflow/rig/plant/magnetic_material.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct JilesAthertonOf {
  Scalar reversible_share = 0.2;
  Scalar coupling = 1.0e-4;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"reversible_share", "1", 0, 0.9, "c: walls that bend and spring back; steels 0.1 to 0.5"},
          self.reversible_share);
    visit(Parameter{"coupling", "1", 0, 2e-3, "alpha: field of the neighbouring domains over their magnetisation"},
          self.coupling);
  }
};
using JilesAtherton = JilesAthertonOf<double>;

/// The model's constants; the pinning k makes the given coercive field where the walls follow steadily: (1 - c) k.
template <class Scalar>
struct JilesAthertonIronOf {
  AnhystereticCurveOf<Scalar> anhysteretic;
  Scalar per_pinning_m_per_A;  ///< 1/k; 0 stands for no pinning at all
  Scalar reversible;           ///< c
  Scalar coupling_m_per_H;     ///< alpha/mu0
  Scalar uncoupled;            ///< 1 - alpha
};
using JilesAthertonIron = JilesAthertonIronOf<double>;

template <class Scalar>
inline JilesAthertonIronOf<Scalar> jiles_atherton_iron(const MagneticMaterialOf<Scalar>& material,
                                                       const JilesAthertonOf<Scalar>& shape,
                                                       Scalar coercive_field_A_per_m) {
  const Scalar pinning_A_per_m = coercive_field_A_per_m / (1.0 - shape.reversible_share);
  return {.anhysteretic = anhysteretic_curve(material),
          .per_pinning_m_per_A = select(pinning_A_per_m > 0.0, 1.0 / pinning_A_per_m, Scalar(0.0)),
          .reversible = shape.reversible_share,
          .coupling_m_per_H = shape.coupling / vacuum_permeability_H_per_m,
          .uncoupled = 1.0 - shape.coupling};
}

/// What the iron remembers; {} is demagnetised.
template <class Scalar>
struct JilesAthertonMemoryOf {
  Scalar anhysteretic_T = 0.0;  ///< b
  Scalar irreversible_T = 0.0;  ///< J_irr
};
using JilesAthertonMemory = JilesAthertonMemoryOf<double>;

namespace jiles_atherton {

/// The anhysteretic state at b.
template <class Scalar>
struct Anhysteretic {
  Scalar effective_A_per_m, effective_slope_m_per_H;  ///< H_e and dH_e/db
  Scalar polarisation_T, polarisation_slope;          ///< J_an and dJ_an/db
};

template <class Scalar>
inline Anhysteretic<Scalar> anhysteretic_at(const JilesAthertonIronOf<Scalar>& iron, Scalar b_T) {
  const FieldPointOf<Scalar> field = anhysteretic_field(iron.anhysteretic, b_T);
  const Scalar polarisation_T = b_T - vacuum_permeability_H_per_m * field.field_A_per_m;
  const Scalar slope = 1.0 - vacuum_permeability_H_per_m * field.slope_m_per_H;
  return {field.field_A_per_m + iron.coupling_m_per_H * polarisation_T,
          field.slope_m_per_H + iron.coupling_m_per_H * slope, polarisation_T, slope};
}

/// J_irr and its slope over b, driven monotonely from the memory's state `start` to `end`.
template <class Scalar>
struct Pinned {
  Scalar irreversible_T, slope;
};

template <class Scalar>
inline Pinned<Scalar> pinned(const JilesAthertonIronOf<Scalar>& iron, Scalar irreversible_T,
                             const Anhysteretic<Scalar>& start, const Anhysteretic<Scalar>& end) {
  const Scalar direction = select(end.effective_A_per_m < start.effective_A_per_m, Scalar(-1.0), Scalar(1.0));
  const Scalar lag_T = direction * (start.polarisation_T - irreversible_T);
  const Scalar change_T = direction * (end.polarisation_T - start.polarisation_T);
  // What comes behind the point where J_an passes the walls.
  const Scalar driven_T = change_T + smaller(lag_T, Scalar(0.0));
  const Mask<Scalar> driven = !(driven_T <= 0.0);
  if (!any(driven)) return {irreversible_T, 0.0};
  const Mask<Scalar> behind = lag_T < 0.0;
  const Scalar share = any(behind) ? select(behind, driven_T / change_T, Scalar(1.0)) : Scalar(1.0);
  const Scalar way = direction * (end.effective_A_per_m - start.effective_A_per_m) * iron.per_pinning_m_per_A;
  const Scalar z = way * share;
  const Scalar per_decay = 1.0 / (1.0 + z + 0.5 * z * z);
  const Scalar end_lag_T = (driven_T * (1.0 + 0.5 * z) + larger(lag_T, Scalar(0.0))) * per_decay;
  Scalar z_slope = end.effective_slope_m_per_H * iron.per_pinning_m_per_A * share;
  if (any(behind)) {
    z_slope = select(behind, z_slope + way * end.polarisation_slope * (1.0 - share) / change_T, z_slope);
  }
  const Scalar lag_slope =
      (end.polarisation_slope * (1.0 + 0.5 * z) + 0.5 * driven_T * z_slope - end_lag_T * (1.0 + z) * z_slope) *
      per_decay;
  return blended(driven, Pinned<Scalar>{end.polarisation_T - direction * end_lag_T, end.polarisation_slope - lag_slope},
                 Pinned<Scalar>{irreversible_T, 0.0});
}

/// The iron at one flux density.
template <class Scalar>
struct Point {
  FieldPointOf<Scalar> field;
  JilesAthertonMemoryOf<Scalar> memory;
};

/// After a monotone change to that flux density.
template <class Scalar>
inline Point<Scalar> at(const JilesAthertonIronOf<Scalar>& iron, const JilesAthertonMemoryOf<Scalar>& memory,
                        Scalar flux_density_T) {
  const Mask<Scalar> unpinned = iron.per_pinning_m_per_A == 0.0;
  Point<Scalar> free{};
  if (any(unpinned)) {
    free = {anhysteretic_field(iron.anhysteretic, flux_density_T),
            {flux_density_T, anhysteretic_at(iron, flux_density_T).polarisation_T}};
    if (all(unpinned)) return free;
  }
  const Anhysteretic<Scalar> start = anhysteretic_at(iron, memory.anhysteretic_T);
  constexpr double nearly_T = 1e-7;  // from there Newton's next step is exact to rounding
  const Scalar start_T =
      vacuum_permeability_H_per_m * start.effective_A_per_m +
      iron.uncoupled * ((1.0 - iron.reversible) * memory.irreversible_T + iron.reversible * start.polarisation_T);
  Scalar b = memory.anhysteretic_T + (flux_density_T - start_T);
  Scalar below = -HUGE_VAL, above = HUGE_VAL;  // between which b lies
  Point<Scalar> point{};
  Mask<Scalar> open = !unpinned;
  for (int tries = 0; tries < 60; ++tries) {
    const Anhysteretic<Scalar> end = anhysteretic_at(iron, b);
    const Pinned<Scalar> walls = pinned(iron, memory.irreversible_T, start, end);
    const Scalar polarisation_T = (1.0 - iron.reversible) * walls.irreversible_T + iron.reversible * end.polarisation_T;
    const Scalar slope = (1.0 - iron.reversible) * walls.slope + iron.reversible * end.polarisation_slope;
    const Scalar flux_slope = vacuum_permeability_H_per_m * end.effective_slope_m_per_H + iron.uncoupled * slope;
    const Scalar missing_T =
        flux_density_T - vacuum_permeability_H_per_m * end.effective_A_per_m - iron.uncoupled * polarisation_T;
    const Point<Scalar> here{{end.effective_A_per_m - iron.coupling_m_per_H * polarisation_T,
                              (end.effective_slope_m_per_H - iron.coupling_m_per_H * slope) / flux_slope},
                             {b, walls.irreversible_T}};
    point = blended(open, here, point);
    const Mask<Scalar> short_of = missing_T > 0.0;
    below = select(open && short_of, b, below);
    above = select(open && !short_of, b, above);
    const Scalar left = missing_T / flux_slope;
    b = select(open, b + left, b);
    if (const Mask<Scalar> found = open && magnitude(missing_T) <= nearly_T; any(found)) {
      const Point<Scalar> there{
          {point.field.field_A_per_m + point.field.slope_m_per_H * missing_T, point.field.slope_m_per_H},
          {b, walls.irreversible_T + walls.slope * left}};
      point = blended(found, there, point);
      open = open && !found;
      if (!any(open)) break;
    }
    const Mask<Scalar> outside = open && !(b > below && b < above);
    if (any(outside)) b = select(outside, 0.5 * (below + above), b);
  }
  return any(unpinned) ? blended(unpinned, free, point) : point;
}

}  // namespace jiles_atherton

/// The field at a flux density reached monotonely.
template <class Scalar>
inline FieldPointOf<Scalar> field_at(const JilesAthertonIronOf<Scalar>& iron,
                                     const JilesAthertonMemoryOf<Scalar>& memory, Scalar flux_density_T) {
  return jiles_atherton::at(iron, memory, flux_density_T).field;
}

/// Moves the memory to a flux density reached monotonely; returns the field [A/m].
template <class Scalar>
inline Scalar magnetise(const JilesAthertonIronOf<Scalar>& iron, JilesAthertonMemoryOf<Scalar>& memory,
                        Scalar flux_density_T, const Given<Mask<Scalar>>& taken = true) {
  const jiles_atherton::Point<Scalar> point = jiles_atherton::at(iron, memory, flux_density_T);
  take(taken, memory, point.memory);
  return point.field.field_A_per_m;
}

}  // namespace spoolflow::rig
