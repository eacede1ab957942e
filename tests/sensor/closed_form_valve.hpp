#pragma once
/// A valve whose every force is a line or a product of lines, so that the sensor's tables hold it exactly, and what its
/// electronics would measure on a given course: known friction, flux, pressure difference and flow. Written without the
/// sensor's functions.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::sensor {

/// The laws. `scale` makes it another valve.
struct ClosedFormValve {
  double scale = 1;
  double iron = 1;  ///< share of the hysteresis; 0 for an iron without memory
  static constexpr double stroke_m = 2.4e-3;
  static constexpr double highest_Pa = 90e5;
  static constexpr double largest_A = 2.5;
  static constexpr double overlap_m = 0.2e-3;
  static constexpr double resistance_Ohm = 10;
  static constexpr double eddy_A_per_V = 5e-3;
  static constexpr double ageing_ratio = 1.5;
  static constexpr double ageing_s = 2.5;
  static constexpr double contact_stiffness_N_per_m = 5e6;
  static constexpr double drift_m_per_K = 1e-7;
  static constexpr double drift_free_K = 313;
  static constexpr int stops = 3;  ///< of the hysteresis; the sensor's others are idle

  [[nodiscard]] double force_per_current_N_per_A(double x) const { return 30 * scale * (1 + 40 * x); }
  [[nodiscard]] double flux_per_current_Wb_per_A(double x) const { return 0.1 * (1 + 50 * x); }
  [[nodiscard]] static double threshold_Wb(int stop) { return 0.004 * (stop + 1); }
  [[nodiscard]] double stiffness_A_per_Wb() const { return 1.5 * scale * iron; }
  [[nodiscard]] static double spring_N(double x) { return 8 + 9e3 * x; }
  [[nodiscard]] static double opening_m(double x) { return std::max(x - overlap_m, 0.0); }
  [[nodiscard]] static double warmth(double temperature_K) { return (temperature_K - 303) / 40; }
  [[nodiscard]] static double flow_force_per_pressure(double x) { return 2.5e-3 * opening_m(x); }
  [[nodiscard]] static double flow_force_N(double x, double pressure_Pa) {
    return flow_force_per_pressure(x) * pressure_Pa;
  }
  [[nodiscard]] static double spool_friction_N(double pressure_Pa, double temperature_K) {
    return (2 + 2e-7 * pressure_Pa) * (1 - 0.1 * warmth(temperature_K));
  }
  [[nodiscard]] static double armature_friction_N(double magnetising_A) { return 0.3 + 0.4 * magnetising_A; }
  [[nodiscard]] double conductance(double x, double temperature_K) const {
    return 2e-4 * scale * (1 + 0.1 * warmth(temperature_K)) * opening_m(x);
  }
  [[nodiscard]] double flow_m3_per_s(double x, double pressure_Pa, double temperature_K) const {
    return conductance(x, temperature_K) * std::sqrt(pressure_Pa);
  }
  /// The flow at which errors are counted: fully open at 70 bar, 313 K.
  [[nodiscard]] double full_scale_m3_per_s() const { return flow_m3_per_s(stroke_m, 70e5, 313); }
};

inline constexpr ClosedFormValve closed_form;

namespace detail {

template <class T>
Axis<T> test_axis(double first, double last, int points) {
  const double spacing = (last - first) / (points - 1);
  return {static_cast<T>(first), static_cast<T>(spacing), static_cast<T>(1 / spacing)};
}

template <class T, int Rows, int Columns, class Law>
void tabulate(Map<T, Rows, Columns>& map, const Axis<T>& currents, const Law& law) {
  map.row_axis = currents;
  map.column_axis = test_axis<T>(0, ClosedFormValve::stroke_m, Columns);
  for (int r = 0; r < Rows; ++r) {
    for (int c = 0; c < Columns; ++c)
      map.node(r, c) =
          static_cast<T>(law(static_cast<double>(currents.at(r)), static_cast<double>(map.column_axis.at(c))));
  }
}

}  // namespace detail

template <class T>
ActuatorParameters<T> closed_form_actuator(const ClosedFormValve& valve) {
  ActuatorParameters<T> out{};
  const auto currents = [](int points) { return detail::test_axis<T>(0, ClosedFormValve::largest_A, points); };
  detail::tabulate(out.magnetic_force.map, currents(force_map_currents),
                   [&](double i, double x) { return valve.force_per_current_N_per_A(x) * i; });
  detail::tabulate(out.friction_N, currents(force_map_currents),
                   [&](double i, double /*x*/) { return ClosedFormValve::armature_friction_N(i); });
  const double cell_A = ClosedFormValve::largest_A / (flux_map_currents - 1 - flux_map_currents_below_zero);
  detail::tabulate(
      out.coil.flux_linkage.map,
      detail::test_axis<T>(-flux_map_currents_below_zero * cell_A, ClosedFormValve::largest_A, flux_map_currents),
      [&](double i, double x) { return valve.flux_per_current_Wb_per_A(x) * i; });
  auto& hysteresis = out.coil.hysteresis;
  for (int k = 0; k < hysteresis_elements; ++k) {
    hysteresis.threshold[static_cast<unsigned>(k)] = static_cast<T>(ClosedFormValve::threshold_Wb(k));
    hysteresis.stiffness[static_cast<unsigned>(k)] =
        static_cast<T>(k < ClosedFormValve::stops ? valve.stiffness_A_per_Wb() : 0);
  }
  hysteresis.per_full_flux = T(5);
  out.coil.eddy_currents = {static_cast<T>(ClosedFormValve::eddy_A_per_V), T(0), T(0.1)};
  out.coil_resistance = {static_cast<T>(ClosedFormValve::resistance_Ohm), T(1), T(0.01), T(0.01)};
  out.coercive_current_A = T(0.04);
  out.per_wiping_flux = T(20);
  out.force_uncertainty_N = T(0.2);
  out.current_uncertainty_A = T(0.002);
  out.eddy_uncertainty = T(0.2);
  return out;
}

template <class T>
MeteringEdge<T> closed_form_edge(const ClosedFormValve& valve) {
  MeteringEdge<T> out{};
  out.temperature_K = detail::test_axis<T>(303, 343, edge_temperatures);
  out.pressure_difference_Pa = detail::test_axis<T>(0, ClosedFormValve::highest_Pa, edge_pressures);
  out.position_m = detail::test_axis<T>(0, ClosedFormValve::stroke_m, edge_positions);
  for (int t = 0; t < edge_temperatures; ++t) {
    for (int p = 0; p < edge_pressures; ++p) {
      for (int k = 0; k < edge_positions; ++k) {
        const auto temperature_K = static_cast<double>(out.temperature_K.at(t));
        const auto pressure_Pa = static_cast<double>(out.pressure_difference_Pa.at(p));
        const auto x = static_cast<double>(out.position_m.at(k));
        out.flow_force_N.node(t, p, k) = static_cast<T>(ClosedFormValve::flow_force_N(x, pressure_Pa));
        out.friction_N.node(t, p, k) = static_cast<T>(ClosedFormValve::spool_friction_N(pressure_Pa, temperature_K));
        out.conductance.node(t, p, k) = static_cast<T>(valve.conductance(x, temperature_K));
      }
    }
  }
  return out;
}

/// The observer of this valve, calibrated without error. What no bench shows is as `calibrate` assumes it.
template <class T>
ObserverParameters<T> closed_form_observer(const ClosedFormValve& valve) {
  ObserverParameters<T> out{};
  out.actuator = closed_form_actuator<T>(valve);
  out.spring.curve.axis = detail::test_axis<T>(0, ClosedFormValve::stroke_m, spring_positions);
  for (int k = 0; k < spring_positions; ++k) {
    out.spring.curve.values[static_cast<unsigned>(k)] =
        static_cast<T>(ClosedFormValve::spring_N(static_cast<double>(out.spring.curve.axis.at(k))));
  }
  out.edge = closed_form_edge<T>(valve);
  out.position_sensor = {T(1e-6), T(0.5e-6), static_cast<T>(ClosedFormValve::drift_m_per_K),
                         static_cast<T>(ClosedFormValve::drift_free_K), T(90)};
  out.friction = {static_cast<T>(ClosedFormValve::ageing_ratio),
                  static_cast<T>(ClosedFormValve::ageing_s),
                  static_cast<T>(ClosedFormValve::contact_stiffness_N_per_m),
                  T(0.7),
                  T(0.12),
                  T(1)};
  out.pressure = {T(3e5), T(1e6), T(0.01), T(0.05), T(0.03), T(2e-3), T(0.03), T(10)};
  out.band = {T(0.03), T(0.2), static_cast<T>(0.001 * valve.full_scale_m3_per_s()), T(2), T(0.8), T(3), T(0.8),
              T(1),    T(2.4)};
  out.moving_mass_kg = T(0.1);
  out.closed_below_m = static_cast<T>(ClosedFormValve::overlap_m + 0.02e-3);
  out.largest_current_A = static_cast<T>(ClosedFormValve::largest_A);
  return out;
}

/// What happens to the valve at one instant.
struct ValveInstant {
  double position_m = 0;
  double pressure_difference_Pa = 60e5;
  double friction_share = 0;  ///< of the friction while sliding; sign of the velocity, beyond 1 by ageing alone
  double oil_temperature_K = 313;
};
using ValveCourse = std::function<ValveInstant(double time_s)>;

/// What was, and what is measured of it.
struct ValveSample {
  Sample<double> measured;
  ValveInstant truth;
  double flow_m3_per_s;
  double friction_N;  ///< of spool and armature
  double magnetic_force_N;
  double magnetising_A;
  double flux_Wb;
};

struct Instruments {
  double position_noise_m = 1e-6;       ///< one standard deviation
  double position_backlash_m = 0.5e-6;  ///< half width
  double current_noise_A = 0.5e-3;
  double friction_ratio = 1;  ///< in operation over the bench's
};

/// The valve on a course, in steps of 10 us: currents and voltages are means over a sample, as electronics measure
/// them.
class ClosedFormRun {
 public:
  ClosedFormRun(const ClosedFormValve& valve, ValveCourse course, Instruments instruments = {})
      : valve_(valve), course_(std::move(course)), instruments_(instruments) {}

  std::vector<ValveSample> sampled(double duration_s, double sample_step_s);

 private:
  static constexpr double fine_step_s = 1e-5;

  /// The current that balances the forces; friction grows with it, in the armature.
  void balance(const ValveInstant& now);
  void start(const ValveInstant& now);
  void move_flux(double flux_Wb);
  void advance(const ValveInstant& now, double step_s);

  ClosedFormValve valve_;
  ValveCourse course_;
  Instruments instruments_;
  std::mt19937 generator_{7};
  std::normal_distribution<double> noise_{0, 1};
  std::array<double, ClosedFormValve::stops> stop_Wb_{};
  double magnetising_A_ = 0, force_N_ = 0, friction_N_ = 0, flux_Wb_ = 0, flux_rate_V_ = 0, coil_A_ = 0;
  double dragged_m_ = 0;  ///< the position sensor's core
};

}  // namespace spoolflow::sensor
