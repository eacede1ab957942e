#include "spoolflow/calibration/environment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "spoolflow/model/oil.hpp"
#include "spoolflow/numerics/sum_of_squares.hpp"

namespace spoolflow::calibration {
namespace {

constexpr double deviations_at_95 = 2;  ///< standard deviations in a half width at 95 %

/// By how much viscosity falls a kelvin between 40 and 100 degrees Celsius [1/K].
double viscosity_fall_1_per_K(const model::Fluid& fluid) {
  constexpr double warm_K = 313.15, hot_K = 373.15;
  return std::log(model::viscosity_m2_per_s(fluid, warm_K) / model::viscosity_m2_per_s(fluid, hot_K)) /
         (hot_K - warm_K);
}

sensor::Environment<double> of_valve(const recording::Environment& from, const model::Fluid& fluid,
                                     const sensor::ObserverParameters<double>& valve) {
  const double viscous_K = std::log1p(from.viscosity) / viscosity_fall_1_per_K(fluid);
  // Standard deviations over the amplitude; of a current that is sampled in step with its ripple, which is a triangle,
  // the same part of it may stand in every sample.
  const double of_sine = 1 / std::numbers::sqrt2, of_triangle = 1 / std::numbers::sqrt3;
  const double highest_Pa = valve.edge.highest_pressure_difference_Pa();
  sensor::Environment<double> out;
  out.position_m = from.position_zero_m / deviations_at_95;
  out.position_share = from.position_gain / deviations_at_95;
  out.oil_temperature_K = std::hypot(from.temperature_K, viscous_K) / deviations_at_95;
  out.current_share = std::hypot(from.current_gain / deviations_at_95, from.pwm_ripple / 2 * of_triangle);
  out.force_N = valve.moving_mass_kg * from.vibration_m_per_s2 * of_sine;
  out.friction_share = from.friction / deviations_at_95;
  out.dithered_loop_A = from.dithered_loop / deviations_at_95 * valve.actuator.coercive_current_A;
  out.ripple_Pa = from.ripple_Pa;
  out.flow_share = from.density / 2 / deviations_at_95;  // the orifice equation's root
  out.leakage_m3_per_s = from.leakage_m3_per_s / deviations_at_95;
  out.highest_pressure_Pa =
      std::max(from.highest_Pa.value_or(model::usual_highest_pressure_ratio * highest_Pa), highest_Pa);
  return out;
}

sensor::CurrentLimits<double> current_limits(const sensor::ObserverParameters<double>& valve) {
  if (!(valve.largest_voltage_V > 0)) return {};
  const auto& flux = valve.actuator.coil.flux_linkage.map;
  double least_H = std::numeric_limits<double>::infinity();
  for (int row = 0; row + 1 < sensor::flux_map_currents; ++row) {
    for (int column = 0; column < sensor::flux_map_positions; ++column)
      least_H = std::min(least_H, (flux.node(row + 1, column) - flux.node(row, column)) * flux.row_axis.per_spacing);
  }
  const double rate_V =
      valve.largest_voltage_V + valve.largest_current_A * valve.actuator.coil_resistance.resistance_Ohm;
  // Noise and the ripple of the current controller come on top of what the coil lets.
  constexpr double of_controller = 0.02;
  return {valve.actuator.coil.eddy_currents.at(rate_V).current_A + of_controller * valve.largest_current_A,
          rate_V / least_H};
}

/// The machine's part of entries that also hold what is open of the unit itself: of a unit of a type what units differ
/// by, of a valve that references moved what these leave open of its flow and its friction.
model::EnvironmentWithoutSpread machines_part(const model::Model& of_one) {
  if (of_one.type) return of_one.type->environment;
  const model::WearState wear = model::last_wear(of_one.provenance);
  const sensor::Environment<double>& now = of_one.observer->parameters.environment;
  return {now.force_N, numerics::with_instead(now.friction_share, wear.friction_share, 0),
          numerics::with_instead(now.flow_share, wear.flow_share, 0), 0};
}

}  // namespace

void apply(const recording::Environment& environment, model::Model& model) {
  for (const std::string& direction : model::directions(model)) {
    model::Model of_one = model::of_direction(model, direction);
    if (!of_one.observer) continue;
    const model::EnvironmentWithoutSpread before = machines_part(of_one);
    sensor::ObserverParameters<double>& valve = of_one.observer->parameters;
    const sensor::Environment<double> declared = of_valve(environment, model.fluid, valve), now = valve.environment;
    valve.environment = declared;
    valve.environment.force_N = numerics::with_instead(now.force_N, before.force_N, declared.force_N);
    valve.environment.friction_share =
        numerics::with_instead(now.friction_share, before.friction_share, declared.friction_share);
    valve.environment.flow_share = numerics::with_instead(now.flow_share, before.flow_share, declared.flow_share);
    if (of_one.type) {
      of_one.type->environment = {declared.force_N, declared.friction_share, declared.flow_share,
                                  before.breakaway_share};
    }
    model::put_direction(model, direction, std::move(of_one));
  }
}

void limit_currents(model::Model& model) {
  if (model.observer) model.observer->parameters.current_limits = current_limits(model.observer->parameters);
  if (model.p_to_a && model.p_to_a->observer) {
    sensor::ObserverParameters<double>& other = model.p_to_a->observer->parameters;
    other.current_limits = current_limits(other);
  }
}

}  // namespace spoolflow::calibration
