#pragma once
/// How one unit of a type differs from the next: a handful of directions in physics, each one number.
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include <Eigen/Core>

namespace spoolflow::calibration {

/// Directions of variation. Of the whole valve, as its own sensor reads it.
enum class Variation : unsigned char {
  turns,              ///< of the coil: force and flux linkage over ampere turns stay
  permeance,          ///< of the air gap at every position: the iron's share of the ampere turns stays
  coercivity,         ///< currents of the hysteresis loop at a given flux
  resistance,         ///< of the coil
  spring_preload,     ///< added to the spring force everywhere, as a share of its mean over the stroke
  spring_rate,        ///< what it rises by along the stroke
  edge_position,      ///< the spool's position at which the edge opens: > 0 opens later
  edge_width,         ///< conductance, and flow force with it
  flow_force,         ///< at a given flow and pressure difference: jet angle and the spool's shape
  flow_force_tilt,    ///< the same rising along the stroke: -1 at its beginning, 1 at its end
  spool_friction,     ///< without pressure
  pressure_friction,  ///< what pressure adds to it
  armature_friction,
  ageing_time,    ///< in which the spool's friction grows at rest
  position_zero,  ///< reading of the sensor at the closed end
  position_gain
};
inline constexpr std::size_t variations = 16;

/// One entry a direction, 0 at first: a share, metres for edge_position and position_zero, a natural logarithm for
/// ageing_time.
struct Deviations : Eigen::Matrix<double, variations, 1> {
  Deviations() { setZero(); }
  template <class Vector>
  Deviations(const Eigen::MatrixBase<Vector>& from) : Eigen::Matrix<double, variations, 1>(from) {}
};

/// What is known of a direction before a unit is measured.
struct VariationAbout {
  std::string_view name;  ///< key in [tolerances], and in a model's `type`
  std::string_view unit;  ///< "1", "m", or "ln" of a natural logarithm
  double tolerance;       ///< one standard deviation between units
  std::string_view meaning;
  std::string_view source;  ///< of the tolerance
};

[[nodiscard]] const std::array<VariationAbout, variations>& all_variations();

/// How people write a deviation whose unit is "1" or "m": in percent or micrometres; a logarithm stays.
struct WrittenUnit {
  double scale;           ///< times the deviation
  std::string_view name;  ///< "%", "um" or "ln"
};
[[nodiscard]] constexpr WrittenUnit written_unit(std::string_view unit) {
  if (unit == "ln") return {1, "ln"};
  return unit == "m" ? WrittenUnit{1e6, "um"} : WrittenUnit{1e2, "%"};
}
/// A deviation in that unit: "-4.36 %".
[[nodiscard]] std::string written_deviation(std::string_view unit, double value);

[[nodiscard]] constexpr std::size_t at(Variation variation) {
  return static_cast<std::size_t>(variation);
}

}  // namespace spoolflow::calibration
