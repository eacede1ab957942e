#pragma once
/// The pressures at a whole valve's ports, where they are measured. Steady flow force closes each edge whichever way
/// the oil goes: under a load that drives the oil, force alone shows neither how much flows nor which way; pressures
/// do.
#include <limits>

#include "spoolflow/sensor/basis/scalar.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::sensor {

/// One standard deviation of a measured port pressure [Pa]: 0.5 % of 100 bar.
inline constexpr double port_pressure_deviation_Pa = 0.5e5;
/// Four of them make the drop over both edges: beyond so much [Pa] its sign is sure.
inline constexpr double sure_drop_Pa = 4 * port_pressure_deviation_Pa;
/// Where calibration leaves it open, the inlet edge's share of the path's drop is found from the pressures at this pace
/// [s] ...
inline constexpr double share_following_s = 2;
/// ... to this standard deviation.
inline constexpr double inlet_share_deviation = 0.03;

template <class T>
constexpr T no_pressure() {
  return T(std::numeric_limits<float>::quiet_NaN());
}

/// Pressures at the ports [Pa]; NaN: not measured. Only all four together count.
template <class T>
struct PortPressures {
  T p_Pa = no_pressure<T>();
  T a_Pa = no_pressure<T>();
  T b_Pa = no_pressure<T>();
  T t_Pa = no_pressure<T>();
};

template <class T>
constexpr bool measured(const PortPressures<T>& ports) {
  return is_number(ports.p_Pa) && is_number(ports.a_Pa) && is_number(ports.b_Pa) && is_number(ports.t_Pa);
}

/// Pressure drops [Pa] over both edges of the open path; > 0 drives the oil the way in which the spool opens.
template <class T>
struct PathDrops {
  T inlet_Pa;   ///< P to B, or P to A
  T outlet_Pa;  ///< A to T, or B to T

  /// What the flow force is made by: each edge's drop counts by its size.
  [[nodiscard]] constexpr T forcing_Pa() const { return magnitude(inlet_Pa) + magnitude(outlet_Pa); }
};

template <class T>
constexpr PathDrops<T> path_drops(const PortPressures<T>& ports, bool opens_a) {
  if (opens_a) return {ports.p_Pa - ports.a_Pa, ports.b_Pa - ports.t_Pa};
  return {ports.p_Pa - ports.b_Pa, ports.a_Pa - ports.t_Pa};
}

/// Whether oil goes through an edge against the way in which the spool opens it.
template <class T>
constexpr bool flow_reversed(const PathDrops<T>& drops) {
  return drops.inlet_Pa < T(-sure_drop_Pa) || drops.outlet_Pa < T(-sure_drop_Pa);
}

/// Whether the drops may be those of the calibrated load's flows through both edges, and are large enough to show it.
template <class T>
constexpr bool of_calibrated_load(const InletShare<T>& inlet, const PathDrops<T>& drops) {
  const T total_Pa = drops.inlet_Pa + drops.outlet_Pa;
  return magnitude(drops.inlet_Pa - inlet.share * total_Pa) < inlet.range * magnitude(total_Pa) &&
         magnitude(total_Pa) > T(sure_drop_Pa);
}

/// The inlet edge's share of the path's drop, `share`, as such a load shows it.
template <class T>
constexpr void follow_share(const InletShare<T>& inlet, T& share, const PathDrops<T>& drops, T time_step_s) {
  if (!of_calibrated_load(inlet, drops)) return;
  share +=
      (drops.inlet_Pa / (drops.inlet_Pa + drops.outlet_Pa) - share) * smaller(time_step_s / T(share_following_s), T(1));
}

/// What drives the flow through the inlet edge, as a drop over the whole path under the calibrated load [Pa], and one
/// standard deviation of it: with a share from calibration this is the inlet edge's own flow, whatever the load.
/// The outlet's drop says less: a moving load, compressed oil and a chamber that runs empty give it another flow.
template <class T>
struct DrivingDrop {
  T drop_Pa;
  T deviation_Pa;
};

template <class T>
constexpr DrivingDrop<T> driving_drop(const PathDrops<T>& drops, T share) {
  const T drop_Pa = drops.inlet_Pa / share;
  const T noise_Pa = T(1.4142135623730951 * port_pressure_deviation_Pa) / share;
  return {drop_Pa, sqrt(squared(noise_Pa) + squared(T(inlet_share_deviation) / share * drop_Pa))};
}

/// Root with the sign of its argument: what a turbulent edge makes of a drop.
template <class T>
constexpr T signed_root(T drop_Pa) {
  const T root = sqrt(magnitude(drop_Pa));
  return drop_Pa < T(0) ? -root : root;
}

}  // namespace spoolflow::sensor
