#include "spoolflow/monitor/signatures.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::monitor {
namespace {

/// Half of the steps for slopes.
constexpr double pressure_step_share = 0.03;
constexpr double position_step_m = 5e-6;
constexpr double current_step_A = 0.01;
/// The flow force's rise over the opening is read at this share of the stroke behind the edge.
constexpr double rise_share = 0.15;
/// Where the edge opens, its rounding's force rises over this length [m] about the calibrated opening.
constexpr double rounding_rise_m = 60e-6;
constexpr double rounding_begins_m = 20e-6;
/// Standard deviation of friction at an event about its limit, as a share of it, of all else [N], and of what ageing
/// adds, as a share of that.
constexpr double limit_scatter_share = 0.06;
constexpr double force_scatter_N = 0.25;
constexpr double ageing_scatter_share = 0.25;
/// Under dither friction is told by its swing alone: as a share of its limit.
constexpr double dithered_scatter_share = 0.25;

struct Limit {
  double sliding_N;
  double aged_N;
};

}  // namespace

Explained explain(const sensor::ObserverParameters<double>& valve, double stroke_m, const ForceEvent& event,
                  double pressure_difference_Pa) {
  const double x = std::max(event.position_m, 0.0);
  const double T = event.oil_temperature_K;
  const double operation = valve.friction.operation_ratio;
  const double aged = event.kind == EventKind::dithered ? 1.0 : sensor::ageing(valve.friction, event.rested_s);
  const double armature_N = valve.actuator.friction_N.at(event.current_A, x).value;
  const double highest_Pa = valve.edge.highest_pressure_difference_Pa();
  const auto beyond_Pa = [&](double pressure_Pa) { return std::max(pressure_Pa - highest_Pa, 0.0); };
  const auto limit = [&](double pressure_Pa) {
    const sensor::EdgePoint<double> edge = valve.edge.at(T, pressure_Pa, x);
    const double spool_N = edge.friction_N + edge.friction_per_pressure_N_Pa * beyond_Pa(pressure_Pa);
    return Limit{spool_N + armature_N, aged * spool_N + armature_N};
  };
  const auto flow_force = [&](double pressure_Pa, double position_m) {
    const sensor::EdgePoint<double> edge = valve.edge.at(T, pressure_Pa, position_m);
    return edge.flow_force_N + edge.flow_force_per_pressure_N_Pa * beyond_Pa(pressure_Pa);
  };
  const auto magnetic = [&](double current_A, double position_m) {
    return valve.actuator.magnetic_force.at(current_A, position_m).value;
  };
  const double step_Pa = pressure_step_share * highest_Pa;
  const double p = std::clamp(pressure_difference_Pa, step_Pa, extrapolated_share * highest_Pa);
  const Limit at_p = limit(p);
  const bool dithered = event.kind == EventKind::dithered;
  const double friction_N = dithered ? event.friction_N : event.direction * operation * at_p.aged_N;

  Explained out{};
  out.residual_N = event.net_force_N - flow_force(p, x) - friction_N;
  out.per_pressure_N_Pa = (flow_force(p + step_Pa, x) - flow_force(p - step_Pa, x)) / (2 * step_Pa);
  if (!dithered) {
    out.per_pressure_N_Pa +=
        event.direction * operation * (limit(p + step_Pa).aged_N - limit(p - step_Pa).aged_N) / (2 * step_Pa);
  }
  out.friction_limit_N = at_p.aged_N;
  out.ageing_N = at_p.aged_N - at_p.sliding_N;
  const double most = valve.edge.at(T, p, stroke_m).conductance;
  const double share = most > 0 ? valve.edge.at(T, p, x).conductance / most : 0.0;
  out.load_slope_N = out.per_pressure_N_Pa * p * share * share;
  const double scatter_N = (dithered ? dithered_scatter_share : limit_scatter_share) * at_p.aged_N;
  out.noise_N = std::sqrt(scatter_N * scatter_N + force_scatter_N * force_scatter_N +
                          std::pow(ageing_scatter_share * std::max(out.ageing_N, 0.0), 2));

  const double opens_m = valve.closed_below_m;
  const double behind_m = rise_share * stroke_m;
  const double rise_N_per_m = flow_force(p, opens_m + behind_m) / behind_m;
  const double open = std::clamp((x - opens_m + rounding_begins_m) / rounding_rise_m, 0.0, 1.0);
  const double preload_N = valve.spring.at(0.0).value;
  const double rate_N = valve.spring.at(stroke_m).value - preload_N;
  const double per_current_N_A =
      (magnetic(event.current_A + current_step_A, x) - magnetic(event.current_A - current_step_A, x)) /
      (2 * current_step_A);
  const auto forces = [&](double position_m) {
    return magnetic(event.current_A, position_m) - valve.spring.at(position_m).value - flow_force(p, position_m);
  };
  const double low_m = std::max(x - position_step_m, 0.0);
  const double per_position_N_m = (forces(x + position_step_m) - forces(low_m)) / (x + position_step_m - low_m);

  const auto put = [&](Magnitude magnitude, double slope) {
    out.slope_N[index(magnitude)] = slope * usual_fault[index(magnitude)];
  };
  put(Magnitude::friction, dithered ? 0.0 : event.direction * operation * at_p.aged_N);
  put(Magnitude::edge_rounding, rise_N_per_m * open);
  put(Magnitude::preload_loss, -preload_N);
  put(Magnitude::rate_loss, -rate_N * x / stroke_m);
  put(Magnitude::shorted_turns, event.current_A * per_current_N_A);
  put(Magnitude::position_zero, per_position_N_m);
  return out;
}

}  // namespace spoolflow::monitor
