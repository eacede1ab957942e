#include "spoolflow/calibration/edges_in_operation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "spoolflow/calibration/edges/metering_edge_fit.hpp"
#include "spoolflow/calibration/fits/position_sensor.hpp"
#include "spoolflow/calibration/fits/spring_fit.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

constexpr std::size_t tenths = 10;
using Shares = std::array<std::vector<double>, tenths>;  ///< C/C_joined, by tenths of the stroke

/// The maps of both edges together, as the bench measured them.
sensor::MeteringEdge<double> joined_edge(const CampaignRecordings& benches, double stroke_m) {
  const SpringFit spring = fit_spring(without_zero_offset(benches.spring, stroke_m), stroke_m);
  std::vector<AxialForceFit> fits;
  for (const recording::Recording* recording : benches.axial_force_maps.joined)
    fits.push_back(fit_axial_force(without_zero_offset(*recording, stroke_m), stroke_m));
  return fit_metering_edge(fits, spring.spring, spring.friction_half_width_N).edge;
}

void add_run(const recording::Recording& run, double sign, const sensor::MeteringEdge<double>& edge,
             const model::Valve& valve, Shares& shares) {
  constexpr double least_flow_share = 0.1, least_Pa = 3e5;  // a meter is good for shares of its range
  const auto position_m = run[Channel::position];
  const auto pressure_Pa = run[Channel::pressure_difference];
  const auto flow_m3_per_s = run[Channel::flow_reference];
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    const double place = sign * position_m[k] / valve.stroke_m * static_cast<double>(tenths);
    const double flow = sign * flow_m3_per_s[k];
    if (!(place >= 0 && place < static_cast<double>(tenths)) || !(pressure_Pa[k] > least_Pa) ||
        !(flow > least_flow_share * valve.rated_flow_m3_per_s)) {
      continue;
    }
    const double temperature_K =
        run.has(Channel::oil_temperature) ? run[Channel::oil_temperature][k] : edge.temperature_K.at(1);
    const double joined = edge.at(temperature_K, pressure_Pa[k], sign * position_m[k]).conductance;
    const double share = flow / (joined * std::sqrt(pressure_Pa[k]));
    if (std::isfinite(share)) shares[static_cast<std::size_t>(place)].push_back(share);
  }
}

}  // namespace

std::optional<EdgeRatio> edge_ratio_in_operation(const CampaignRecordings& benches,
                                                 const std::vector<RunsOfPath>& operation, const model::Valve& valve) {
  const double k = benches.axial_force_maps.outlet_flow_ratio;
  std::optional<sensor::MeteringEdge<double>> edge;
  Shares shares;
  for (const RunsOfPath& each : operation) {
    for (const recording::Recording* run : each.runs) {
      if (!run->has(Channel::pressure_difference) || !run->has(Channel::flow_reference)) continue;
      if (!edge) edge = joined_edge(benches, valve.stroke_m);
      add_run(*run, each.sign, *edge, valve, shares);
    }
  }
  constexpr std::size_t first_tenth = 3, least_tenths = 4, least_samples = 50;
  std::vector<double> medians;
  for (std::size_t tenth = first_tenth; tenth < tenths; ++tenth) {
    if (shares[tenth].size() >= least_samples) medians.push_back(numerics::median(std::move(shares[tenth])));
  }
  if (medians.size() < least_tenths) return std::nullopt;
  constexpr double meter_share = 0.01;
  const auto [low, high] = std::minmax_element(medians.begin(), medians.end());
  const double lowest = *low * (1 - meter_share), highest = *high * (1 + meter_share);
  const double share = numerics::median(medians);
  // Edges four times as wide as each other are the most that is credible, either way.
  constexpr double most = 4;
  const double of_widest = conductance_under_load(k, most * std::max(1.0, k));
  const double of_narrowest = conductance_under_load(k, std::min(1.0, k) / most);
  const auto [least_share, most_share] = std::minmax(of_widest, of_narrowest);
  if (share < least_share || share > most_share) return std::nullopt;
  const auto ratio = [&, from = least_share, to = most_share](double of) {
    return edge_ratio_of(k, std::clamp(of, from, to));
  };
  const auto [from, to] = std::minmax({ratio(lowest), ratio(highest)});
  return EdgeRatio{ratio(share), from, to};
}

}  // namespace spoolflow::calibration
