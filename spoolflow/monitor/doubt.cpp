#include "spoolflow/monitor/doubt.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/monitor/signatures.hpp"

namespace spoolflow::monitor {
namespace {

/// The pressure difference is doubted by no more than this share of the highest: the sensor keeps it in range.
constexpr double most_doubt_share = 0.7;

}  // namespace

sensor::Estimate<double> widened(const model::Model& model, const Doubt& doubt, const estimation::TimedSample& sample,
                                 double oil_temperature_K, const sensor::Estimate<double>& answer) {
  const bool opens_a = model.whole() && sample.position_m < 0;
  const DirectionDoubt& side = doubt.side[opens_a ? 1 : 0];
  sensor::Estimate<double> out = answer;
  if (!side.raised) return out;
  out.status |= sensor::Status::model_doubt;
  if (!std::isfinite(sample.position_m)) return out;
  const sensor::ObserverParameters<double>& valve =
      opens_a ? model.p_to_a->observer->parameters : model.observer->parameters;
  const double position_m = sensor::drift_free_m(valve.position_sensor, std::abs(sample.position_m), oil_temperature_K);
  const double current_A = opens_a && std::isfinite(sample.current_a_A) ? sample.current_a_A : sample.current_A;
  if (!std::isfinite(current_A)) return out;
  const double p = std::max(answer.pressure_difference_Pa, 0.0);
  const ForceEvent here{.time_s = 0,
                        .position_m = position_m,
                        .net_force_N = 0,
                        .rested_s = 0,
                        .friction_N = 0,
                        .current_A = current_A,
                        .oil_temperature_K = oil_temperature_K,
                        .pressure_difference_Pa = p,
                        .direction = 1,
                        .count = 1,
                        .kind = EventKind::sliding};
  const Explained forces = explain(valve, model.valve.stroke_m, here, p);
  double force_N = 0;
  for (std::size_t k = 0; k < magnitudes; ++k) {
    if (k != index(Magnitude::friction)) force_N += forces.slope_N[k] * side.value[k];
  }
  const double friction_N =
      std::abs(forces.slope_N[index(Magnitude::friction)] * side.value[index(Magnitude::friction)]);
  const auto edge = [&](double at_m) { return valve.edge.at(oil_temperature_K, p, std::max(at_m, 0.0)); };
  const sensor::EdgePoint<double> point = edge(position_m);
  const double highest_Pa = valve.edge.highest_pressure_difference_Pa();
  const double off_Pa =
      std::min((std::abs(force_N) + friction_N) / point.flow_force_per_pressure_N_Pa, most_doubt_share * highest_Pa);
  const double rounding_m = side.value[index(Magnitude::edge_rounding)] * usual_fault[index(Magnitude::edge_rounding)];
  const double shift_m = side.value[index(Magnitude::position_zero)] * usual_fault[index(Magnitude::position_zero)];
  const double opening = std::abs(edge(position_m + rounding_m).conductance - point.conductance) +
                         std::abs(edge(position_m - shift_m).conductance - point.conductance);
  const double above = point.conductance * (std::sqrt(p + off_Pa) - std::sqrt(p)) + opening * std::sqrt(p);
  const double below =
      point.conductance * (std::sqrt(p) - std::sqrt(std::max(p - off_Pa, 0.0))) + opening * std::sqrt(p);
  out.flow_upper_m3_per_s += opens_a ? below : above;
  out.flow_lower_m3_per_s -= opens_a ? above : below;
  return out;
}

}  // namespace spoolflow::monitor
