#pragma once
/// Metering edges in closed form, alone or in series, and what the axial-force rig records of them.
#include <cmath>
#include <string>
#include <vector>

#include "tests/calibration/synthetic_bench.hpp"

namespace spoolflow::calibration {

inline constexpr double warm_K = 323.15;

/// An edge in closed form: flow C sqrt(dp), flow force and what pressure adds to friction in proportion to dp.
struct ClosedFormEdge {
  double opens_at_m = 0.2e-3;
  double conductance_per_m = 2.5e-4;
  double force_per_m_Pa = 3.4e-3;
  double friction_per_Pa = 0.3e-6;

  [[nodiscard]] double opening_m(double x_m) const { return std::fmax(0.0, x_m - opens_at_m); }
  [[nodiscard]] double conductance(double x_m) const { return conductance_per_m * opening_m(x_m); }
  [[nodiscard]] double force_N(double x_m, double pressure_Pa) const {
    return force_per_m_Pa * opening_m(x_m) * pressure_Pa;
  }
};

inline constexpr double unloaded_friction_N = 2.0;

/// What the axial-force rig shows of one edge, or of two of which the second passes k times the flow.
struct EdgeReading {
  double force_N, friction_N, flow_m3_per_s;
};

inline EdgeReading reading_of(const ClosedFormEdge& edge, double x_m, double pressure_Pa) {
  return {edge.force_N(x_m, pressure_Pa), unloaded_friction_N + edge.friction_per_Pa * pressure_Pa,
          edge.conductance(x_m) * std::sqrt(pressure_Pa)};
}

inline EdgeReading reading_of(const ClosedFormEdge& inlet, const ClosedFormEdge& outlet, double k, double x_m,
                              double pressure_Pa) {
  const double c1 = inlet.conductance(x_m), c2 = outlet.conductance(x_m);
  if (!(c1 > 0) && !(c2 > 0)) return {0, unloaded_friction_N + inlet.friction_per_Pa * pressure_Pa, 0};
  const double inlet_Pa = pressure_Pa * c2 * c2 / (c2 * c2 + k * k * c1 * c1), outlet_Pa = pressure_Pa - inlet_Pa;
  return {inlet.force_N(x_m, inlet_Pa) + outlet.force_N(x_m, outlet_Pa),
          unloaded_friction_N + inlet.friction_per_Pa * inlet_Pa + outlet.friction_per_Pa * outlet_Pa,
          c1 * std::sqrt(inlet_Pa)};
}

inline const std::vector<Stroke> edge_levels{{5e5}, {10e5}, {20e5}, {30e5}, {40e5}, {50e5}, {60e5}, {70e5}};

template <class Shows>
recording::Recording recorded(const std::string& file, const Shows& shows, double oil_temperature_K = warm_K) {
  using recording::Channel;
  const Drive motion = drive(edge_levels, 0);
  recording::Recording out;
  out.file = file;
  out.column(Channel::time) = motion.time_s;
  out.column(Channel::position) = motion.position_m;
  out.column(Channel::pressure_difference_set) = motion.level;
  out.column(Channel::pressure_difference) = motion.level;
  for (std::size_t k = 0; k < motion.time_s.size(); ++k) {
    const double x_m = motion.true_position_m[k];
    const EdgeReading shown = shows(x_m, motion.level[k]);
    out.column(Channel::axial_force).push_back(spring_N(x_m) + shown.force_N + motion.direction[k] * shown.friction_N);
    out.column(Channel::flow).push_back(shown.flow_m3_per_s);
    out.column(Channel::oil_temperature).push_back(oil_temperature_K);
  }
  return out;
}

inline recording::Recording recorded(const std::string& file, const ClosedFormEdge& edge,
                                     double oil_temperature_K = warm_K) {
  return recorded(
      file, [&](double x_m, double p_Pa) { return reading_of(edge, x_m, p_Pa); }, oil_temperature_K);
}

/// Of like opening, the outlet cut narrower and with a steeper jet.
inline const ClosedFormEdge wide{};
inline const ClosedFormEdge narrow{.conductance_per_m = 1.5e-4, .force_per_m_Pa = 2.4e-3, .friction_per_Pa = 0.5e-6};

}  // namespace spoolflow::calibration
