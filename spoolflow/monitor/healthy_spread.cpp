#include "spoolflow/monitor/healthy_spread.hpp"

#include <cmath>
#include <string_view>

#include "spoolflow/monitor/correction.hpp"

namespace spoolflow::monitor {
namespace {

/// What a deviation of a unit looks like: so much of a magnitude for each of its own unit.
struct Resemblance {
  std::string_view deviation;
  Magnitude magnitude;
  double factor;
};

std::array<Resemblance, 8> resemblances(const sensor::ObserverParameters<double>& valve, double stroke_m) {
  const double stop_m = closed_stop_m(valve), closed_N = valve.spring.at(stop_m).value;
  const double rise_N = valve.spring.at(stop_m + stroke_m).value - closed_N;
  const double flow_force_N =
      valve.edge.at(valve.edge.temperature_K.at(1), valve.edge.highest_pressure_difference_Pa(), stop_m + stroke_m / 2)
          .flow_force_N;
  return {{
      {"spring_preload", Magnitude::preload_loss, (closed_N + rise_N / 2) / closed_N},  // a share of the mean force
      {"spring_rate", Magnitude::rate_loss, 1},
      {"flow_force_tilt", Magnitude::rate_loss, flow_force_N / rise_N},  // twice that at the highest pressure
      {"turns", Magnitude::shorted_turns, 1},
      {"permeance", Magnitude::shorted_turns, 0.5},  // the force goes with it, and with the square of the turns
      {"edge_position", Magnitude::edge_rounding, 1},
      {"position_zero", Magnitude::position_zero, 1},
      {"position_gain", Magnitude::position_zero, stroke_m / 2},
  }};
}

}  // namespace

Magnitudes healthy_spread_of(const model::Model& model) {
  Magnitudes out = healthy_spread;
  if (!model.type || !model.observer) return out;
  const auto widen = [&](Magnitude magnitude, double by) {
    double& spread = out[index(magnitude)];
    spread = std::hypot(spread, by / usual_fault[index(magnitude)]);
  };
  const sensor::ObserverParameters<double>& valve = model.observer->parameters;
  for (const Resemblance& alike : resemblances(valve, model.valve.stroke_m)) {
    for (const model::UnitDeviation& each : model.type->deviations) {
      if (each.name == alike.deviation) widen(alike.magnitude, alike.factor * each.uncertainty);
    }
  }
  const double known = model.type->environment.friction_share, all = valve.environment.friction_share;
  widen(Magnitude::friction, std::sqrt(std::fmax(0.0, all * all - known * known)));
  return out;
}

}  // namespace spoolflow::monitor
