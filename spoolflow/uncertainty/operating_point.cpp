#include "spoolflow/uncertainty/operating_point.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/model/oil.hpp"
#include "spoolflow/numerics/crossing.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::uncertainty {
namespace {

/// The argument between the ends at which a rising function reaches `wanted`; nothing where it does not.
template <class Function>
std::optional<double> crossing_between(double low, double high, double wanted, const Function& rising) {
  if (!(rising(low) <= wanted && wanted <= rising(high))) return std::nullopt;
  return numerics::crossing({low, high}, wanted, rising);
}

/// y(x) between measured points; the outermost ones hold beyond.
double interpolated(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto above = std::upper_bound(xs.begin(), xs.end(), x);
  if (above == xs.begin()) return ys.front();
  if (above == xs.end()) return ys.back();
  const auto k = static_cast<std::size_t>(above - xs.begin());
  return ys[k - 1] + (x - xs[k - 1]) / (xs[k] - xs[k - 1]) * (ys[k] - ys[k - 1]);
}

/// Half the width of the loops at `position_m`, between those of the neighbouring levels.
template <class Loop>
double half_width_N(const std::vector<Loop>& loops, double Loop::*level_of, double level, double position_m) {
  std::vector<double> levels, widths;
  for (const Loop& loop : loops) {
    levels.push_back(loop.*level_of);
    widths.push_back(0.5 * std::abs(interpolated(loop.position_m, loop.opening_N, position_m) -
                                    interpolated(loop.position_m, loop.closing_N, position_m)));
  }
  return loops.empty() ? 0 : interpolated(levels, widths, level);
}

}  // namespace

double map_temperature_K(const model::Model& model) {
  return model.condensed.oil_temperature_K.value_or(units::K_from_degC(50));
}

std::optional<double> balanced_current_A(const model::Model& model, const WorkingPoint& point) {
  const auto& sensor = model.condensed.parameters;
  const double x = point.position_m;
  const auto force_N =
      crossing_between(0, sensor.flow_rate.largest_force_N.at(x).value, point.pressure_difference_Pa,
                       [&](double force) { return sensor.flow_rate.at(force, x).pressure_difference_Pa; });
  if (!force_N) return std::nullopt;
  return crossing_between(model.condensed.current_A.lower, model.condensed.current_A.upper,
                          sensor.spring.at(x).value + *force_N,
                          [&](double current) { return sensor.magnetic_force.at(current, x).value; });
}

Surroundings surroundings_at(const model::Model& model, const WorkingPoint& point, double current_A) {
  Surroundings out;
  out.friction_half_width_N =
      half_width_N(model.evidence.axial_force, &model::AxialForceLoop::pressure_difference_set_Pa,
                   point.pressure_difference_Pa, point.position_m);
  out.hysteresis_half_width_N =
      half_width_N(model.evidence.magnetic_force, &model::MagneticForceLoop::current_A, current_A, point.position_m);
  constexpr double least_slope_N_per_A = 1;  // at no current a solenoid's force does not change with it
  out.force_per_current_N_per_A = std::max(
      least_slope_N_per_A, model.condensed.parameters.magnetic_force.at(current_A, point.position_m).row_slope);
  const double T = map_temperature_K(model);
  out.temperature_per_viscosity_K = temperature_per_viscosity_K(model.fluid, T);
  const double root = std::sqrt(std::max(point.pressure_difference_Pa, 0.0));
  if (model.observer) {
    const auto& edge = model.observer->parameters.edge;
    constexpr double step_K = 10;
    const auto warm = edge.at(T + step_K, point.pressure_difference_Pa, point.position_m);
    const auto cold = edge.at(T - step_K, point.pressure_difference_Pa, point.position_m);
    out.force_per_temperature_N_per_K = (warm.flow_force_N - cold.flow_force_N) / (2 * step_K);
    out.flow_per_temperature_m3_per_s_K = root * (warm.conductance - cold.conductance) / (2 * step_K);
  } else {
    const auto& flow_rate = model.condensed.parameters.flow_rate;
    const double flow_force_N = model.condensed.parameters.magnetic_force.at(current_A, point.position_m).value -
                                model.condensed.parameters.spring.at(point.position_m).value;
    out.flow_per_temperature_m3_per_s_K =
        0.5 * model::thermal_expansion_per_K * flow_rate.at(flow_force_N, point.position_m).flow_m3_per_s;
  }
  return out;
}

double temperature_per_viscosity_K(const model::Fluid& fluid, double oil_temperature_K) {
  constexpr double about_K = 0.5;
  return -2 * about_K /
         std::log(model::viscosity_m2_per_s(fluid, oil_temperature_K - about_K) /
                  model::viscosity_m2_per_s(fluid, oil_temperature_K + about_K));
}

std::optional<std::vector<estimation::TimedSample>> course_to(const model::Model& model, const WorkingPoint& point) {
  constexpr double sample_s = 1e-3;
  constexpr int samples = 400;
  const sensor::ObserverParameters<double>& valve = model.observer->parameters;
  const auto at_point = valve.edge.at(point.oil_temperature_K, point.pressure_difference_Pa, point.position_m);
  if (!at_point.inside || !at_point.temperature_inside) return std::nullopt;
  const double direction = point.opening ? 1 : -1;
  const double speed_m_per_s = 0.1 * model.valve.stroke_m;
  const double drift_m =
      valve.position_sensor.drift_m_per_K * (point.oil_temperature_K - valve.position_sensor.drift_free_K);
  const double ratio = valve.friction.operation_ratio;

  std::vector<estimation::TimedSample> course;
  sensor::ActuatorState<double> state;
  double current_A = 0.3 * valve.largest_current_A;
  for (int k = 0; k < samples; ++k) {
    const double x = point.position_m - direction * speed_m_per_s * sample_s * (samples - 1 - k);
    const auto edge = valve.edge.at(point.oil_temperature_K, point.pressure_difference_Pa, x);
    const double needed_N = valve.spring.at(x).value + edge.flow_force_N + direction * ratio * edge.friction_N;
    // The actuator's own equations, turned round by secant steps.
    sensor::ActuatorState<double> after{};
    for (int pass = 0; pass < 30; ++pass) {
      after = state;
      const auto answer = sensor::step(valve.actuator, after, {sample_s, current_A, NAN, x, NAN}, k == 0);
      const double missing_N = needed_N + direction * ratio * answer.friction_half_width_N - answer.magnetic_force_N;
      if (std::abs(missing_N) < 1e-6) break;
      const double change_A = missing_N / std::max(answer.force_per_current_N_per_A, 5.0);
      current_A = std::clamp(current_A + std::clamp(change_A, -0.3, 0.3), 0.0, 1.05 * valve.largest_current_A);
    }
    if (current_A >= 1.02 * valve.largest_current_A || current_A <= 0) return std::nullopt;
    state = after;
    course.push_back({sample_s * k, current_A,
                      valve.actuator.coil_resistance.resistance_Ohm * current_A + state.coil.flux_rate_V, x + drift_m,
                      point.oil_temperature_K});
  }
  return course;
}

}  // namespace spoolflow::uncertainty
