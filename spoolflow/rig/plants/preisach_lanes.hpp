#pragma once
/// Preisach's memory of several valves at once. Most changes go on along a branch, or turn, before the next corner of
/// the loop: those are found for all valves together, by the newest two reversal points; where a loop is wiped out, the
/// valve is looked at alone.

#include "spoolflow/rig/numerics/lanes.hpp"
#include "spoolflow/rig/plant/preisach.hpp"

namespace spoolflow::rig {

template <int valves>
struct PreisachMemoryOf<Lanes<valves>> {
  using Numbers = Lanes<valves>;
  ReversalPointOf<Numbers> now{0.0, 0.0};
  Numbers slope_m_per_H = 0.0;
  BranchFootOf<Numbers> foot;
  Numbers count = 0.0;
  ReversalPointOf<Numbers> last{0.0, 0.0}, before{0.0, 0.0};  ///< of each valve's reversals, where it has so many
  std::array<Reversals, valves> reversals{};
};

template <int valves>
ReversalPoint of_valve(const ReversalPointOf<Lanes<valves>>& points, std::size_t valve) {
  return {points.field_A_per_m[valve], points.flux_density_T[valve]};
}
template <int valves>
void set_valve(ReversalPointOf<Lanes<valves>>& points, std::size_t valve, const ReversalPoint& point) {
  points.field_A_per_m.set(valve, point.field_A_per_m);
  points.flux_density_T.set(valve, point.flux_density_T);
}

template <int valves>
inline preisach::Branch<Lanes<valves>> branch_to(const PreisachMemoryOf<Lanes<valves>>& memory,
                                                 const Lanes<valves>& flux_density_T) {
  using Numbers = Lanes<valves>;
  const Numbers direction = select(flux_density_T - memory.now.flux_density_T < 0.0, Numbers(-1.0), Numbers(1.0));
  const LaneMask<valves> turned = memory.count > 0.0;
  const LaneMask<valves> goes_on = turned && (memory.now.flux_density_T - memory.last.flux_density_T) * direction > 0.0;
  preisach::Branch<Numbers> branch{.direction = direction,
                                   .virgin = !turned && direction * memory.now.flux_density_T >= 0.0,
                                   .origin = blended(goes_on, memory.last, memory.now),
                                   .kept = select(goes_on, memory.count - 1.0, memory.count),
                                   .least_A_per_m = direction * memory.now.field_A_per_m,
                                   .goes_on = goes_on};
  const ReversalPointOf<Numbers> mirrored{-branch.origin.field_A_per_m, -branch.origin.flux_density_T};
  const ReversalPointOf<Numbers> corner =
      blended(branch.kept == 0.0, mirrored, blended(goes_on, memory.before, memory.last));
  const LaneMask<valves> wipes_out = !branch.virgin && !(direction * (flux_density_T - corner.flux_density_T) < 0.0);
  branch.kept = select(branch.virgin, Numbers(0.0), branch.kept);
  if (!any(wipes_out)) return branch;
  LaneMask<valves> virgin = branch.virgin;
  for (std::size_t valve = 0; valve < valves; ++valve) {
    if (!wipes_out[valve]) continue;
    const preisach::Branch<double> alone =
        preisach::branch_to(of_valve(memory.now, valve), memory.reversals[valve],
                            static_cast<std::size_t>(memory.count[valve]), flux_density_T[valve]);
    set_valve(branch.origin, valve, alone.origin);
    branch.kept.set(valve, static_cast<double>(alone.kept));
    branch.least_A_per_m.set(valve, alone.least_A_per_m);
    virgin.bits[valve] = alone.virgin ? -1 : 0;
  }
  branch.virgin = virgin;
  branch.goes_on = branch.goes_on && !wipes_out;
  return branch;
}

/// Of the valves that take it.
template <int valves>
inline Lanes<valves> magnetise(const PreisachIronOf<Lanes<valves>>& iron, PreisachMemoryOf<Lanes<valves>>& memory,
                               const Lanes<valves>& flux_density_T, const LaneMask<valves>& taken) {
  const LaneMask<valves> moves = taken && flux_density_T != memory.now.flux_density_T;
  if (!any(moves)) return memory.now.field_A_per_m;
  const preisach::Branch<Lanes<valves>> branch = branch_to(memory, flux_density_T);
  const preisach::Rise<Lanes<valves>> rise(iron, memory, branch);
  const FieldPointOf<Lanes<valves>> field = preisach::on(rise, memory, branch, flux_density_T);
  take(moves, memory.now, {field.field_A_per_m, flux_density_T});
  take(moves, memory.slope_m_per_H, field.slope_m_per_H);
  take(moves, memory.foot, rise.foot());
  const LaneMask<valves> leaves = moves && !branch.goes_on;
  if (!any(leaves)) return memory.now.field_A_per_m;
  for (std::size_t valve = 0; valve < valves; ++valve) {
    if (!leaves[valve]) continue;
    if (branch.virgin[valve]) {
      memory.count.set(valve, 0.0);
      continue;
    }
    auto kept = static_cast<std::size_t>(branch.kept[valve]);
    if (kept == remembered_reversals) kept -= 2;
    Reversals& reversals = memory.reversals[valve];
    reversals[kept] = of_valve(branch.origin, valve);
    memory.count.set(valve, static_cast<double>(kept + 1));
    set_valve(memory.last, valve, reversals[kept]);
    if (kept > 0) set_valve(memory.before, valve, reversals[kept - 1]);
  }
  return memory.now.field_A_per_m;
}

}  // namespace spoolflow::rig
