#include "spoolflow/calibration/edges/path_of_edges.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/edges/metering_edge_fit.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/numerics/interpolation.hpp"
#include "spoolflow/numerics/crossing.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/sensor/band.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::calibration {
namespace {

constexpr double path_temperature_K = 5;
constexpr double least_share_range = 0.02;  // two edges' flow meters and pressures

/// One edge at one position, over the pressure difference across it.
class EdgeAtPosition {
 public:
  EdgeAtPosition(const AxialForceFit& fit, std::size_t position, double spring_N)
      : levels_(levels_at(fit, position, spring_N)) {
    find_unloaded_friction();
  }

  [[nodiscard]] double flow_m3_per_s(double pressure_Pa) const {
    return at(levels_.conductance, pressure_Pa) * std::sqrt(pressure_Pa);
  }
  /// Beyond the highest level in proportion to the pressure difference, as by eq. (2).
  [[nodiscard]] double force_N(double pressure_Pa) const {
    return at(levels_.force_N, pressure_Pa) * std::max(1.0, pressure_Pa / levels_.pressure_Pa.back());
  }
  /// Of the line through the levels, where there is no pressure: at this oil temperature, unlike the spring
  /// recording's.
  [[nodiscard]] double unloaded_friction_N() const { return levels_.friction_N.front(); }
  [[nodiscard]] double added_friction_N(double pressure_Pa) const {
    return at(levels_.friction_N, pressure_Pa) - unloaded_friction_N();
  }

 private:
  [[nodiscard]] double at(const std::vector<double>& values, double pressure_Pa) const {
    return interpolate_monotone({levels_.pressure_Pa, values}, std::vector<double>{pressure_Pa}).front();
  }
  /// Friction is linear in the pressure difference (paper section 2.1.3).
  void find_unloaded_friction() {
    auto& [pressure_Pa, force_N, friction_N, conductance] = levels_;
    const auto count = static_cast<double>(friction_N.size() - 1);
    double mean_Pa = 0, mean_N = 0, covariance = 0, variance = 0;
    for (std::size_t k = 1; k < friction_N.size(); ++k) {
      mean_Pa += pressure_Pa[k] / count;
      mean_N += friction_N[k] / count;
    }
    for (std::size_t k = 1; k < friction_N.size(); ++k) {
      covariance += (pressure_Pa[k] - mean_Pa) * (friction_N[k] - mean_N);
      variance += (pressure_Pa[k] - mean_Pa) * (pressure_Pa[k] - mean_Pa);
    }
    const double slope = variance > 0 ? covariance / variance : 0;
    friction_N.front() = std::max(0.0, mean_N - slope * mean_Pa);
  }

  EdgeLevels levels_;
};

/// The share of the path's pressure difference that lies over the inlet: where the outlet passes k times its flow.
double inlet_share(const EdgeAtPosition& inlet, const EdgeAtPosition& outlet, double path_Pa,
                   double outlet_flow_ratio) {
  // Both flows rise with the pressure over their own edge, so that one crossing is between the ends.
  const auto excess = [&](double share) {
    return outlet_flow_ratio * inlet.flow_m3_per_s(share * path_Pa) - outlet.flow_m3_per_s((1 - share) * path_Pa);
  };
  if (excess(1) <= 0 && excess(0) >= 0) return 0.5;  // both closed
  constexpr int halvings = 24;                       // no pressure sensor sees more
  return numerics::crossing({0, 1}, 0, excess, halvings);
}

/// Up to which pressure difference of the path neither edge has more than it was measured at, over the open half of the
/// stroke [Pa]. Nearer to the centre the edge that opens later may have more.
double highest_path_Pa(const AxialForceFit& inlet, const AxialForceFit& outlet, const sensor::Spring<double>& spring,
                       double outlet_flow_ratio) {
  const double of_inlet_Pa = inlet.loops.back().pressure_difference_set_Pa;
  const double of_outlet_Pa = outlet.loops.back().pressure_difference_set_Pa;
  double highest_Pa = of_inlet_Pa + of_outlet_Pa;
  const std::vector<double>& grid_m = inlet.loops.front().position_m;
  for (std::size_t p = grid_m.size() / 2; p < grid_m.size(); ++p) {
    const double spring_N = spring.at(grid_m[p]).value;
    const double share = inlet_share({inlet, p, spring_N}, {outlet, p, spring_N}, highest_Pa, outlet_flow_ratio);
    highest_Pa = std::min({highest_Pa, of_inlet_Pa / std::max(share, 1e-3), of_outlet_Pa / std::max(1 - share, 1e-3)});
  }
  return highest_Pa;
}

/// A residual of that RMS over the samples of both.
FitResidual of_both(const FitResidual& one, const FitResidual& other, double weight_one, double weight_other) {
  FitResidual out;
  out.samples = one.samples + other.samples;
  const double rms = std::hypot(weight_one * one.rms(), weight_other * other.rms());
  out.sum_of_squares = rms * rms * static_cast<double>(out.samples);
  out.largest = std::hypot(weight_one * one.largest, weight_other * other.largest);
  return out;
}

std::string written_degC(double temperature_K) {
  return std::isnan(temperature_K) ? "an unknown oil temperature"
                                   : fmt::format("{:.1f} degC", units::degC_from_K(temperature_K));
}

bool alike(double one_K, double other_K) {
  if (std::isnan(one_K) || std::isnan(other_K)) return std::isnan(one_K) && std::isnan(other_K);
  return std::abs(one_K - other_K) <= path_temperature_K;
}

/// The fit of the other edge at the nearest oil temperature.
const AxialForceFit& partner(const AxialForceFit& fit, const recording::Recording& recording,
                             const std::vector<AxialForceFit>& others,
                             const std::vector<const recording::Recording*>& recordings) {
  const AxialForceFit* nearest = nullptr;
  for (const AxialForceFit& other : others) {
    if (!alike(fit.oil_temperature_K, other.oil_temperature_K)) continue;
    if (nearest == nullptr || std::abs(other.oil_temperature_K - fit.oil_temperature_K) <
                                  std::abs(nearest->oil_temperature_K - fit.oil_temperature_K)) {
      nearest = &other;
    }
  }
  if (nearest != nullptr) return *nearest;
  std::string found;
  for (std::size_t k = 0; k < others.size(); ++k) {
    found += fmt::format("{}{} at {}", k == 0 ? "" : ", ", recordings[k]->file.filename().string(),
                         written_degC(others[k].oil_temperature_K));
  }
  throw CalibrationError(
      fmt::format("{}: edge measured at {}, and the path's other edge is not known there within {} K ({}); record both "
                  "edges at the same oil temperatures",
                  recording.file.filename().string(), written_degC(fit.oil_temperature_K), path_temperature_K, found));
}

/// The loop at a pressure difference so many times higher, by eq. (2): force in proportion to it, flow to its root;
/// friction as it was.
model::AxialForceLoop beyond(model::AxialForceLoop loop, const sensor::Spring<double>& spring, double times) {
  loop.pressure_difference_set_Pa *= times;
  for (std::size_t p = 0; p < loop.position_m.size(); ++p) {
    const double mean_N = 0.5 * (loop.opening_N[p] + loop.closing_N[p]);
    const double added_N = (times - 1) * (mean_N - spring.at(loop.position_m[p]).value);
    loop.opening_N[p] += added_N;
    loop.closing_N[p] += added_N;
    loop.flow_m3_per_s[p] *= std::sqrt(times);
    loop.pressure_difference_Pa[p] *= times;
  }
  return loop;
}

/// Throws CalibrationError where no oil flows through an edge that is open.
void require_flow(const AxialForceFit& fit, const recording::Recording& recording) {
  const std::vector<double>& flow_m3_per_s = fit.loops.back().flow_m3_per_s;
  if (flow_m3_per_s[flow_m3_per_s.size() / 2] > 0 || flow_m3_per_s.back() > 0) return;
  throw CalibrationError(fmt::format(
      "{}: {:.2f} L/min flow through the fully open edge at {:.0f} bar; flow through the measured edge is > 0, "
      "whichever port feeds it: correct sign or channel",
      recording.file.filename().string(), units::L_per_min_from_m3_per_s(flow_m3_per_s.back()),
      units::bar_from_Pa(fit.loops.back().pressure_difference_set_Pa)));
}

/// What the edges' proportion makes of conductance and force at the same pressure difference.
struct LoadFactors {
  double conductance;
  double force;
};

LoadFactors load_factors(double outlet_flow_ratio, double edge_ratio) {
  const double k2 = outlet_flow_ratio * outlet_flow_ratio, e = edge_ratio;
  const double share = (e * e + 1) / (e * e + k2);
  return {std::sqrt(share), (e + k2) / (e + 1) * share};
}

/// The flow that belongs to one force, over that of the joined bench: a force determines dp, and the flow is C
/// sqrt(dp).
double flow_of_force(double outlet_flow_ratio, double edge_ratio) {
  const LoadFactors factors = load_factors(outlet_flow_ratio, edge_ratio);
  return factors.conductance / std::sqrt(factors.force);
}

/// The inlet's shares of the path's highest pressure difference, over the open half of the stroke.
void add_inlet_shares(const AxialForceFit& inlet, const AxialForceFit& outlet, const AxialForceFit& path,
                      const sensor::Spring<double>& spring, double outlet_flow_ratio, std::vector<double>& shares) {
  const std::vector<double>& grid_m = inlet.loops.front().position_m;
  const double path_Pa = path.loops.back().pressure_difference_set_Pa;
  for (std::size_t p = grid_m.size() / 2; p < grid_m.size(); ++p) {
    const double spring_N = spring.at(grid_m[p]).value;
    shares.push_back(inlet_share({inlet, p, spring_N}, {outlet, p, spring_N}, path_Pa, outlet_flow_ratio));
  }
}

/// Their median, and how much they differ from it.
sensor::InletShare<double> measured_inlet_share(const std::vector<double>& shares) {
  const double middle = numerics::median(shares);
  double range = least_share_range;
  for (const double share : shares) range = std::max(range, std::abs(share - middle));
  return {middle, range};
}

/// Of edges measured joined. Where their ratio is unknown it is left as of edges cut for the load's flows.
sensor::InletShare<double> inlet_share_of_joined(const AxialForceMaps& maps) {
  if (!maps.edge_ratio) return {};
  const double k2 = maps.outlet_flow_ratio * maps.outlet_flow_ratio;
  const auto share = [&](double e) { return e * e / (e * e + k2); };
  const double middle = share(maps.edge_ratio->value);
  const double range = std::max(share(maps.edge_ratio->highest) - middle, middle - share(maps.edge_ratio->lowest));
  return {middle, std::max(least_share_range, range)};
}

}  // namespace

std::vector<const recording::Recording*> AxialForceMaps::recordings() const {
  std::vector<const recording::Recording*> out = joined;
  out.insert(out.end(), inlet.begin(), inlet.end());
  out.insert(out.end(), outlet.begin(), outlet.end());
  return out;
}

AxialForceFit path_of_edges(const AxialForceFit& inlet, const AxialForceFit& outlet,
                            const sensor::Spring<double>& spring, double outlet_flow_ratio) {
  AxialForceFit out{};
  out.oil_temperature_K = 0.5 * (inlet.oil_temperature_K + outlet.oil_temperature_K);
  constexpr double inlet_weight = 0.5;  // of a path whose edges share the pressure difference
  out.force_residual = of_both(inlet.force_residual, outlet.force_residual, 1, 1);
  out.flow_residual =
      of_both(inlet.flow_residual, outlet.flow_residual, inlet_weight, (1 - inlet_weight) / outlet_flow_ratio);
  const std::vector<double>& grid_m = inlet.loops.front().position_m;
  const double per_inlet_level =
      highest_path_Pa(inlet, outlet, spring, outlet_flow_ratio) / inlet.loops.back().pressure_difference_set_Pa;
  for (const model::AxialForceLoop& loop : inlet.loops)
    out.loops.push_back({per_inlet_level * loop.pressure_difference_set_Pa, grid_m, {}, {}, {}, {}});
  for (std::size_t p = 0; p < grid_m.size(); ++p) {
    const double spring_N = spring.at(grid_m[p]).value;
    const EdgeAtPosition one(inlet, p, spring_N), other(outlet, p, spring_N);
    const double unloaded_N = 0.5 * (one.unloaded_friction_N() + other.unloaded_friction_N());
    for (model::AxialForceLoop& loop : out.loops) {
      const double path_Pa = loop.pressure_difference_set_Pa;
      const double share = inlet_share(one, other, path_Pa, outlet_flow_ratio);
      const double inlet_Pa = share * path_Pa, outlet_Pa = (1 - share) * path_Pa;
      const double force_N = spring_N + one.force_N(inlet_Pa) + other.force_N(outlet_Pa);
      const double friction_N =
          std::max(0.0, unloaded_N + one.added_friction_N(inlet_Pa) + other.added_friction_N(outlet_Pa));
      loop.opening_N.push_back(force_N + friction_N);
      loop.closing_N.push_back(force_N - friction_N);
      loop.flow_m3_per_s.push_back(
          std::min(one.flow_m3_per_s(inlet_Pa), other.flow_m3_per_s(outlet_Pa) / outlet_flow_ratio));
      loop.pressure_difference_Pa.push_back(path_Pa);
    }
  }
  return out;
}

PathFit fit_path(const AxialForceMaps& maps, const sensor::Spring<double>& spring, double stroke_m) {
  const auto fits_of = [&](const std::vector<const recording::Recording*>& recordings) {
    std::vector<AxialForceFit> out;
    for (const recording::Recording* recording : recordings) out.push_back(fit_axial_force(*recording, stroke_m));
    return out;
  };
  PathFit out;
  const double ratio = maps.outlet_flow_ratio;
  out.equal_flows = ratio == 1;
  if (maps.inlet.empty()) {
    out.measured = {fits_of(maps.joined)};
    out.path = out.measured.front();
    out.inlet = inlet_share_of_joined(maps);
    if (maps.edges_are_unknown()) {
      const double edge_ratio = maps.edge_ratio ? maps.edge_ratio->value : 1;
      for (AxialForceFit& fit : out.path) fit = joined_under_load(std::move(fit), spring, ratio, edge_ratio);
    }
    return out;
  }
  out.measured = {fits_of(maps.inlet), fits_of(maps.outlet)};
  const std::vector<AxialForceFit>&inlet = out.measured[0], &outlet = out.measured[1];
  std::vector<double> inlet_shares;
  for (std::size_t k = 0; k < outlet.size(); ++k) {
    require_flow(outlet[k], *maps.outlet[k]);
    (void)partner(outlet[k], *maps.outlet[k], inlet, maps.inlet);
  }
  for (std::size_t k = 0; k < inlet.size(); ++k) {
    require_flow(inlet[k], *maps.inlet[k]);
    const AxialForceFit& other = partner(inlet[k], *maps.inlet[k], outlet, maps.outlet);
    out.path.push_back(path_of_edges(inlet[k], other, spring, ratio));
    add_inlet_shares(inlet[k], other, out.path.back(), spring, ratio, inlet_shares);
  }
  out.inlet = measured_inlet_share(inlet_shares);
  return out;
}

AxialForceFit joined_under_load(AxialForceFit joined, const sensor::Spring<double>& spring, double outlet_flow_ratio,
                                double edge_ratio) {
  const LoadFactors factors = load_factors(outlet_flow_ratio, edge_ratio);
  for (model::AxialForceLoop& loop : joined.loops) {
    for (std::size_t p = 0; p < loop.position_m.size(); ++p) {
      const double mean_N = 0.5 * (loop.opening_N[p] + loop.closing_N[p]);
      const double added_N = (factors.force - 1) * (mean_N - spring.at(loop.position_m[p]).value);
      loop.opening_N[p] += added_N;
      loop.closing_N[p] += added_N;
      loop.flow_m3_per_s[p] *= factors.conductance;
    }
  }
  const double reach = 2 / (1 + outlet_flow_ratio);
  if (reach > 1) joined.loops.push_back(beyond(joined.loops.back(), spring, reach));
  return joined;
}

double conductance_under_load(double outlet_flow_ratio, double edge_ratio) {
  return load_factors(outlet_flow_ratio, edge_ratio).conductance;
}

double edge_ratio_of(double outlet_flow_ratio, double conductance_share) {
  const double k2 = outlet_flow_ratio * outlet_flow_ratio, s2 = conductance_share * conductance_share;
  return std::sqrt((1 - s2 * k2) / (s2 - 1));
}

double flow_residual_with_unknown_edges(const AxialForceMaps& maps, double flow_residual_m3_per_s,
                                        double rated_flow_m3_per_s) {
  if (!maps.edges_are_unknown()) return flow_residual_m3_per_s;
  const double k = maps.outlet_flow_ratio;
  const EdgeRatio edges = maps.edge_ratio.value_or(EdgeRatio{1, k, k});
  double share = 0;
  for (const double edge_ratio : {edges.lowest, edges.highest}) {
    const double ratio = flow_of_force(k, edge_ratio) / flow_of_force(k, edges.value);
    share = std::max({share, ratio - 1, 1 / ratio - 1});
  }
  return std::hypot(flow_residual_m3_per_s, share * rated_flow_m3_per_s / sensor::flow_residual_factor);
}

}  // namespace spoolflow::calibration
