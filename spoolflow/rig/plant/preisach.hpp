#pragma once
/// Iron after Preisach, Z. Phys. 94 (1935) 277: relays that switch up at h_u + h_c and down at h_u - h_c, of every
/// coercive field h_c and interaction field h_u, and a reversible part.
///
///     B(H) = mu0 H + r F(H) + (1 - r) sum of the relays,     density g(h_c) F'(h_u)/2
///     F(h) = B_s [0.8 h/sqrt(h^2 + a^2) + 0.2 h/sqrt(h^2 + (4 a)^2)]       interaction fields spread by a
///     g    = 1/(2 s H_c) from (1 - s) H_c to (1 + s) H_c                   coercive fields about H_c
///
/// With g even, Everett's integral over the triangle of reversal points beta < alpha has a closed form in the
/// antiderivative G of F (F odd, G even), with c1, c2 the ends of g and c* = (alpha - beta)/2 limited to them:
///
///     2 E(alpha, beta) = [G(alpha - c1) - G(alpha - c*) - G(beta + c*) + G(beta + c1)]/(c2 - c1)
///
/// A branch that left a reversal point at (H_r, B_r) upwards is B_r + rev(H) - rev(H_r) + (1 - r) 2 E(H, H_r), the
/// virgin curve half of that from -H to H (Mayergoyz, Mathematical Models of Hysteresis, 1991). The memory is the row
/// of reversal points; a branch that comes past the point before its own wipes both out, so every minor loop closes at
/// its own corner (return-point memory). The field at a flux density is Newton's on the branch: F rises, so B does, and
/// no susceptibility is negative. Rate-independent; leaves out accommodation.
#include <array>
#include <cmath>
#include <cstddef>

#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"
#include "spoolflow/rig/plant/magnetic_material.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct PreisachOf {
  Scalar reversible_share = 0.1;
  Scalar coercive_spread = 1.0;
  Scalar interaction_field_A_per_m = 1230.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"reversible_share", "1", 0, 0.9, "r: what bends with the field and springs back"},
          self.reversible_share);
    visit(
        Parameter{"coercive_spread", "1", 0.1, 1, "s: 1 gives small loops after Rayleigh, 0.1 nearly one relay width"},
        self.coercive_spread);
    visit(Parameter{"interaction_field_A_per_m", "A/m", 50, 10000,
                    "a: 1230 gives 0.9 kA/m at 1.0 T, 1.9 kA/m at 1.5 T, as low-carbon steel in a path with joints"},
          self.interaction_field_A_per_m);
  }
};
using Preisach = PreisachOf<double>;

/// The model's constants.
template <class Scalar>
struct PreisachIronOf {
  Scalar mostly_T, partly_T;                             ///< 0.8 and 0.2 of the saturation
  Scalar narrow_A2_per_m2, wide_A2_per_m2;               ///< a^2 and (4 a)^2
  Scalar reversible;                                     ///< r
  Scalar least_coercive_A_per_m, most_coercive_A_per_m;  ///< c1, c2
  Scalar per_band;                                       ///< (1 - r)/(c2 - c1)
};
using PreisachIron = PreisachIronOf<double>;

/// Relays of less than this are as good as none, and the closed form would drown in rounding.
inline constexpr double least_relay_A_per_m = 0.01;

template <class Scalar>
inline PreisachIronOf<Scalar> preisach_iron(const MagneticMaterialOf<Scalar>& material, const PreisachOf<Scalar>& shape,
                                            Scalar coercive_field_A_per_m) {
  const Scalar coercive_A_per_m = larger(coercive_field_A_per_m, Scalar(least_relay_A_per_m));
  const Scalar spread_A_per_m = shape.coercive_spread * coercive_A_per_m;
  const Scalar a = shape.interaction_field_A_per_m;
  return {.mostly_T = 0.8 * material.saturation_T,
          .partly_T = 0.2 * material.saturation_T,
          .narrow_A2_per_m2 = a * a,
          .wide_A2_per_m2 = 16.0 * a * a,
          .reversible = shape.reversible_share,
          .least_coercive_A_per_m = coercive_A_per_m - spread_A_per_m,
          .most_coercive_A_per_m = coercive_A_per_m + spread_A_per_m,
          .per_band = (1.0 - shape.reversible_share) / (2.0 * spread_A_per_m)};
}

/// Where field and flux density turned.
template <class Scalar>
struct ReversalPointOf {
  Scalar field_A_per_m, flux_density_T;
};
using ReversalPoint = ReversalPointOf<double>;

/// Reversal points that are remembered; where more are nested, the innermost loop is forgotten.
inline constexpr std::size_t remembered_reversals = 32;
using Reversals = std::array<ReversalPoint, remembered_reversals>;

/// What of a branch does not move with the field, times its direction.
template <class Scalar>
struct BranchFootOf {
  Scalar flux_density_T = 0.0;
  Scalar whole_T_A_per_m = 0.0;  ///< G(beta + c2)
};

/// What the iron remembers; {} is demagnetised. The first reversal left the virgin curve; each loop lies inside the one
/// before. Of several valves: preisach_lanes.hpp.
template <class Scalar>
struct PreisachMemoryOf {
  ReversalPointOf<Scalar> now{0.0, 0.0};
  Scalar slope_m_per_H = 0.0;  ///< dH/dB on the way to it
  BranchFootOf<Scalar> foot;   ///< of the branch that it lies on
  std::size_t count = 0;
  Reversals reversals{};
};
using PreisachMemory = PreisachMemoryOf<double>;

namespace preisach {

/// F, its slope and its antiderivative G at a field.
template <class Scalar>
struct Relays {
  Scalar flux_density_T, slope_H_per_m, integral;
};

template <class Scalar>
inline Relays<Scalar> relays_at(const PreisachIronOf<Scalar>& iron, Scalar field_A_per_m) {
  const Scalar h2 = field_A_per_m * field_A_per_m;
  const Scalar narrow2 = h2 + iron.narrow_A2_per_m2;
  const Scalar wide2 = h2 + iron.wide_A2_per_m2;
  const Scalar narrow = square_root(narrow2);
  const Scalar wide = square_root(wide2);
  const Scalar mostly = iron.mostly_T / narrow;
  const Scalar partly = iron.partly_T / wide;
  return {.flux_density_T = field_A_per_m * (mostly + partly),
          .slope_H_per_m = mostly * iron.narrow_A2_per_m2 / narrow2 + partly * iron.wide_A2_per_m2 / wide2,
          .integral = iron.mostly_T * narrow + iron.partly_T * wide};
}

/// mu0 H + r F.
template <class Scalar>
inline Scalar reversible_T(const PreisachIronOf<Scalar>& iron, Scalar field_A_per_m) {
  return vacuum_permeability_H_per_m * field_A_per_m + iron.reversible * relays_at(iron, field_A_per_m).flux_density_T;
}

/// What the iron runs along until it turns. Fields and flux densities are times its direction, so that it rises.
template <class Scalar>
struct Branch {
  Scalar direction;                ///< 1 up, -1 down
  Mask<Scalar> virgin;             ///< else it left an origin
  ReversalPointOf<Scalar> origin;  ///< as it was, not times the direction
  CountOf<Scalar> kept;            ///< reversal points that lie before its origin
  Scalar least_A_per_m;            ///< the field lies beyond
  Mask<Scalar> goes_on;            ///< the memory lies on it
};

/// The branch on which a monotone change from `now` to that flux density ends, with so many points of `reversals`.
[[gnu::always_inline]] inline Branch<double> branch_to(const ReversalPoint& now, const Reversals& reversals,
                                                       std::size_t count, double flux_density_T) {
  const double change_T = flux_density_T - now.flux_density_T;
  Branch<double> branch{.direction = change_T < 0.0 ? -1.0 : 1.0,
                        .virgin = false,
                        .origin = now,
                        .kept = count,
                        .least_A_per_m = 0.0,
                        .goes_on = false};
  branch.least_A_per_m = branch.direction * now.field_A_per_m;
  if (count == 0) {
    branch.virgin = branch.direction * now.flux_density_T >= 0.0;
  } else if (const ReversalPoint last = reversals[count - 1];
             (now.flux_density_T - last.flux_density_T) * branch.direction > 0.0) {
    branch.origin = last;
    branch.goes_on = true;
    --branch.kept;
  }
  while (!branch.virgin) {
    // The largest loop ends where the virgin curve of the other side begins, any other at the point before its origin.
    const bool largest = branch.kept == 0;
    const ReversalPoint corner = largest ? ReversalPoint{-branch.origin.field_A_per_m, -branch.origin.flux_density_T}
                                         : reversals[branch.kept - 1];
    if (branch.direction * (flux_density_T - corner.flux_density_T) < 0.0) break;
    branch.least_A_per_m = larger(branch.least_A_per_m, branch.direction * corner.field_A_per_m);
    branch.goes_on = false;
    branch.virgin = branch.kept < 2;
    if (branch.virgin) break;
    branch.origin = reversals[branch.kept - 2];
    branch.kept -= 2;
  }
  if (branch.virgin) branch.kept = 0;
  return branch;
}

inline Branch<double> branch_to(const PreisachMemory& memory, double flux_density_T) {
  return branch_to(memory.now, memory.reversals, memory.count, flux_density_T);
}

/// A branch as a function of the field.
template <class Scalar>
class Rise {
 public:
  struct Point {
    Scalar flux_density_T, slope_H_per_m;
  };

  Rise(const PreisachIronOf<Scalar>& iron, const PreisachMemoryOf<Scalar>& memory, const Branch<Scalar>& branch)
      : iron_(iron), virgin_(branch.virgin) {
    if (all(virgin_)) return;
    origin_A_per_m_ = select(virgin_, Scalar(0.0), branch.direction * branch.origin.field_A_per_m);
    foot_ = memory.foot;
    if (const Mask<Scalar> starts = !virgin_ && !branch.goes_on; any(starts)) {
      const BranchFootOf<Scalar> begun{
          branch.direction * branch.origin.flux_density_T - reversible_T(iron, origin_A_per_m_) +
              iron.per_band * relays_at(iron, origin_A_per_m_ + iron.least_coercive_A_per_m).integral,
          relays_at(iron, origin_A_per_m_ + iron.most_coercive_A_per_m).integral};
      foot_ = blended(starts, begun, foot_);
    }
    if (any(virgin_)) foot_ = blended(virgin_, BranchFootOf<Scalar>{}, foot_);
  }

  [[nodiscard]] const BranchFootOf<Scalar>& foot() const { return foot_; }

  Point operator()(Scalar field_A_per_m) const {
    const Relays<Scalar> free = relays_at(iron_, field_A_per_m);
    const Relays<Scalar> first = relays_at(iron_, field_A_per_m - iron_.least_coercive_A_per_m);
    const Scalar half_way = select(virgin_, field_A_per_m, 0.5 * (field_A_per_m - origin_A_per_m_));
    const Scalar reach = clamped(half_way, iron_.least_coercive_A_per_m, iron_.most_coercive_A_per_m);
    const Relays<Scalar> last = relays_at(iron_, field_A_per_m - reach);
    Scalar relays = first.integral - last.integral;
    if (!all(virgin_)) {
      Scalar below = foot_.whole_T_A_per_m;
      if (const Mask<Scalar> inside = reach < iron_.most_coercive_A_per_m; any(inside)) {
        below = select(inside, relays_at(iron_, origin_A_per_m_ + reach).integral, below);
      }
      relays = select(virgin_, relays, relays - below);
    }
    return {vacuum_permeability_H_per_m * field_A_per_m + iron_.reversible * free.flux_density_T +
                iron_.per_band * relays + foot_.flux_density_T,
            vacuum_permeability_H_per_m + iron_.reversible * free.slope_H_per_m +
                iron_.per_band * (first.flux_density_T - last.flux_density_T)};
  }

 private:
  const PreisachIronOf<Scalar>& iron_;
  Mask<Scalar> virgin_;
  Scalar origin_A_per_m_ = 0.0;
  BranchFootOf<Scalar> foot_;
};

/// The field at a flux density on its branch.
template <class Scalar>
inline FieldPointOf<Scalar> on(const Rise<Scalar>& rise, const PreisachMemoryOf<Scalar>& memory,
                               const Branch<Scalar>& branch, Scalar flux_density_T) {
  constexpr double nearly_T = 1e-7;  // from there Newton's next step is exact to rounding
  const Scalar wanted_T = branch.direction * flux_density_T;
  const Scalar change_T = wanted_T - branch.direction * memory.now.flux_density_T;
  Scalar field_A_per_m =
      larger(branch.least_A_per_m, branch.direction * memory.now.field_A_per_m + change_T * memory.slope_m_per_H);
  Scalar below = -HUGE_VAL, above = HUGE_VAL;  // between which the field lies
  Scalar slope_H_per_m = 0.0;
  Mask<Scalar> open = true;
  for (int tries = 0; tries < 60; ++tries) {
    const auto point = rise(field_A_per_m);
    const Scalar missing_T = wanted_T - point.flux_density_T;
    const Mask<Scalar> short_of = missing_T > 0.0;
    below = select(open && short_of, field_A_per_m, below);
    above = select(open && !short_of, field_A_per_m, above);
    slope_H_per_m = select(open, point.slope_H_per_m, slope_H_per_m);
    field_A_per_m = select(open, field_A_per_m + missing_T / point.slope_H_per_m, field_A_per_m);
    open = open && !(magnitude(missing_T) <= nearly_T);
    if (!any(open)) break;
    const Mask<Scalar> outside = open && !(field_A_per_m > below && field_A_per_m < above);
    if (any(outside)) {
      field_A_per_m = select(outside, 0.5 * (larger(below, branch.least_A_per_m) + above), field_A_per_m);
    }
  }
  return {branch.direction * field_A_per_m, 1.0 / slope_H_per_m};
}

}  // namespace preisach

/// The field at a flux density reached monotonely.
template <class Scalar>
inline FieldPointOf<Scalar> field_at(const PreisachIronOf<Scalar>& iron, const PreisachMemoryOf<Scalar>& memory,
                                     Scalar flux_density_T) {
  using preisach::branch_to;
  const preisach::Branch<Scalar> branch = branch_to(memory, flux_density_T);
  return preisach::on(preisach::Rise<Scalar>(iron, memory, branch), memory, branch, flux_density_T);
}

/// Moves the memory to a flux density reached monotonely; returns the field [A/m].
inline double magnetise(const PreisachIron& iron, PreisachMemory& memory, double flux_density_T,
                        bool /*taken*/ = true) {
  if (flux_density_T == memory.now.flux_density_T) return memory.now.field_A_per_m;
  preisach::Branch<double> branch = preisach::branch_to(memory, flux_density_T);
  const preisach::Rise<double> rise(iron, memory, branch);
  const FieldPoint field = preisach::on(rise, memory, branch, flux_density_T);
  memory.now = {field.field_A_per_m, flux_density_T};
  memory.slope_m_per_H = field.slope_m_per_H;
  memory.foot = rise.foot();
  memory.count = 0;
  if (!branch.virgin) {
    if (branch.kept == remembered_reversals) branch.kept -= 2;
    memory.reversals[branch.kept] = branch.origin;
    memory.count = branch.kept + 1;
  }
  return field.field_A_per_m;
}

}  // namespace spoolflow::rig
