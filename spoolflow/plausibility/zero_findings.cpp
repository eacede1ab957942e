#include "spoolflow/plausibility/zero_findings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/position_zero.hpp"
#include "spoolflow/plausibility/relation.hpp"
#include "spoolflow/plausibility/run_relations.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

void take_off(Recording& means, double offset_m) {
  for (double& position_m : means.column(Channel::position)) position_m -= offset_m;
}

/// Where a spool rests, if it is not at zero. Beyond a tenth of the stroke it rests elsewhere by its design.
std::optional<double> misplaced_rest(const Recording& run, const KnownValve& valve) {
  constexpr double most_share = 0.1;
  const double stroke_m = valve.hydraulics.stroke_m;
  const std::optional<double> rest_m = rest_position(run, valve.hydraulics, valve.magnetics.largest_current_A);
  const bool off = rest_m && std::abs(*rest_m) > zero_share * stroke_m && std::abs(*rest_m) < most_share * stroke_m;
  return off ? rest_m : std::nullopt;
}

Finding rest_finding(double rest_m, double stroke_m) {
  return {
      std::abs(rest_m) > surely * zero_share * stroke_m,
      fmt::format("position is {:+.3f} mm at rest without current, where the preloaded spring holds the spool at 0: "
                  "the zero of the position sensor is off; measure the closed position, and give the position that "
                  "offset in the channel map",
                  units::mm_from_m(rest_m))};
}

/// The flow [m3/s] behind the closed valve, block by block, once a meter shows no more of what passed before.
std::vector<double> flows_closed(const Recording& run, double closed_below_m) {
  constexpr double settling_s = 0.5, least_s = 1, sure_share = 0.5;  // of where it covers the edge
  const std::vector<double>&time_s = run.column(Channel::time), &position_m = run.column(Channel::position);
  std::vector<double> out, phase;
  double from_s = 0;
  bool closed = false;
  for (std::size_t k = 0; k < run.size(); ++k) {
    const bool closes = std::abs(position_m[k]) < sure_share * closed_below_m;
    if (closes && !closed) from_s = time_s[k];
    if (closes != closed) phase.clear();
    closed = closes;
    if (!closed || time_s[k] < from_s + settling_s || std::isnan(run.column(Channel::flow)[k])) continue;
    phase.push_back(run.column(Channel::flow)[k]);
    if (time_s[k] < from_s + settling_s + least_s) continue;
    out.insert(out.end(), phase.begin(), phase.end());
    phase.clear();
  }
  return out;
}

}  // namespace

std::vector<Finding> zero_findings(const std::vector<Recording*>& maps, double stroke_m) {
  std::vector<Finding> out;
  while (out.size() + 1 < maps.size()) {
    Recording* worst = nullptr;
    std::optional<ZeroOffset> found;
    for (Recording* map : maps) {
      std::vector<const Recording*> others;
      std::ranges::copy_if(maps, std::back_inserter(others), [&](const Recording* other) { return other != map; });
      const auto offset = misplaced_zero(OpeningCurve(others, stroke_m), *map, stroke_m);
      if (!offset || (found && std::abs(found->offset_m) >= std::abs(offset->offset_m))) continue;
      found = offset;
      worst = map;
    }
    if (worst == nullptr) break;
    const bool two = maps.size() == 2;
    out.push_back({over_limit(*found, stroke_m) > surely,
                   fmt::format("{}: {}", file_of(*worst),
                               shown(*found, two ? "in the other axial-force map" : "in the other axial-force maps"))});
    take_off(*worst, found->offset_m);
  }
  return out;
}

std::optional<Finding> spring_zero_finding(const Recording& spring, const std::vector<const Recording*>& maps,
                                           double stroke_m) {
  if (maps.empty()) return std::nullopt;
  constexpr double any_density_kg_per_m3 = 870;  // the jet's momentum is not asked for
  const HydraulicCurves alone = fit_hydraulics(&spring, {}, stroke_m, any_density_kg_per_m3),
                        other = fit_hydraulics(nullptr, maps, stroke_m, any_density_kg_per_m3);
  const double rate_N_per_m = (other.spring_N.back() - other.spring_N.front()) / stroke_m;
  constexpr int places = 17;
  double less_N = 0;
  for (int k = 0; k < places; ++k) {
    const double position_m = (0.1 + 0.8 * k / (places - 1)) * stroke_m;
    less_N += (other.spring_at(position_m) - alone.spring_at(position_m)) / places;
  }
  const double offset_m = less_N / rate_N_per_m;
  constexpr double most_share = 0.15;  // more is no zero
  const double share = std::abs(offset_m) / stroke_m;
  if (!(rate_N_per_m > 0) || !(share > spring_zero_share) || share > most_share) return std::nullopt;
  return Finding{
      false,
      fmt::format("{}: position reads {:.3f} mm {} than in the axial-force maps, by the springs' force: the zero "
                  "of the position sensor moved between the recordings, or that of the load cell is off by "
                  "{:.2g} N; measure the closed position and the unloaded force, and give the channel that "
                  "offset in the channel map, or record it again",
                  file_of(spring), units::mm_from_m(std::abs(offset_m)), offset_m > 0 ? "more" : "less", -less_N)};
}

std::vector<Finding> run_zero_findings(Recording& run, std::span<const KnownValve> valve) {
  const double stroke_m = valve.front().hydraulics.stroke_m;
  const bool both = valve.size() > 1;
  const std::optional<double> rest_m = misplaced_rest(run, valve.front());
  std::vector<Finding> out;
  for (const int side : both ? std::vector{1, -1} : std::vector{1}) {
    const KnownValve& known = valve[side > 0 ? 0 : 1];
    const auto found = misplaced_zero(known.opening, both ? one_side(run, side) : run, stroke_m);
    if (!found) continue;
    std::string text = shown(*found, !both      ? "in the axial-force maps"
                                     : side > 0 ? "in the axial-force maps of P to B (opening > 0)"
                                                : "in the axial-force maps of P to A (opening > 0)");
    if (rest_m) text += fmt::format("; the spool rests without current at {:+.3f} mm, too", units::mm_from_m(*rest_m));
    out.push_back({over_limit(*found, stroke_m) > surely, std::move(text)});
    for (double& position_m : run.column(Channel::position)) {
      if (!both || side * position_m > 0) position_m -= side * found->offset_m;
    }
  }
  if (out.empty() && rest_m) {
    out.push_back(rest_finding(*rest_m, stroke_m));
    take_off(run, *rest_m);
  }
  return out;
}

std::optional<Finding> meter_zero_finding(const Recording& run, std::span<const KnownValve> valve) {
  if (!run.has(Channel::flow)) return std::nullopt;
  const double closed_below_m = std::ranges::min_element(valve, {}, &KnownValve::closed_below_m)->closed_below_m;
  const double largest = valve.front().hydraulics.largest_flow_m3_per_s;
  const std::vector<double> flows = flows_closed(longer_blocks(run), closed_below_m);
  if (flows.empty()) return std::nullopt;
  const double zero = mean_of_numbers(flows);
  const auto [least, most] = std::ranges::minmax(flows);
  if (!(std::abs(zero) > meter_zero_share * largest) || most - least > meter_zero_range * std::abs(zero))
    return std::nullopt;
  return Finding{false, fmt::format("flow_reference stands at {:.2g} L/min, {:.2g} % of the largest flow, while the "
                                    "spool covers the edge: the zero of the meter is off, or oil leaks past the "
                                    "spool; read the meter with the pump off, and give flow_reference that offset in "
                                    "the channel map",
                                    units::L_per_min_from_m3_per_s(zero), 100 * zero / largest)};
}

std::optional<Finding> centre_finding(const OpeningCurve& b, const OpeningCurve& a, double stroke_m) {
  const double difference_m = b.opens_at_m() - a.opens_at_m();
  if (!(std::abs(difference_m) > centre_share * stroke_m)) return std::nullopt;
  return Finding{
      false, fmt::format("P to B opens at {:.3f} mm and P to A at {:.3f} mm from the centre: the zero of the position "
                         "sensor is off in the bench tests of one direction, unless the valve's drawing has such "
                         "edges; compare both with the drawing, or record a run through the centre with them",
                         units::mm_from_m(b.opens_at_m()), units::mm_from_m(a.opens_at_m()))};
}

}  // namespace spoolflow::plausibility
