#pragma once
/// What an estimate of the flow rate depends on, and how well each is known.
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "spoolflow/uncertainty/distribution.hpp"

namespace spoolflow::uncertainty {

/// Errors are value less truth. In this order they appear in tables.
enum class InputQuantity {
  position_zero,        ///< [m]
  position_gain,        ///< share of the reading; linearity counts as one
  position_noise,       ///< of one sample [m]
  current_gain,         ///< share of the reading
  current_offset,       ///< [A]
  current_noise,        ///< of one sample [A]
  voltage_offset,       ///< [V]
  oil_temperature,      ///< [K]; of a sensor that does not read it: how far the oil is from its map's
  magnetic_force_map,   ///< [N]
  magnetic_load_cell,   ///< of the bench, share of the reading
  magnetic_hysteresis,  ///< share of the loops' half width, where the sensor has no model of them
  magnetising_current,  ///< [A]: what the sensor's model of hysteresis leaves
  flow_force_map,       ///< [N]
  axial_load_cell,      ///< of the bench, share of the reading
  flow_map,             ///< of the calibrated flow [m3/s]
  flow_meter,           ///< of the bench, share of the reading
  friction,             ///< share of the friction's half width
  spring,               ///< [N]
  oil_density,          ///< share of the calibrated oil's
  oil_viscosity,        ///< share of the calibrated oil's
  pressure_belief,      ///< of the observer's filter [Pa]
};

/// Whether each sample has an error of its own.
[[nodiscard]] constexpr bool is_noise(InputQuantity quantity) {
  return quantity == InputQuantity::position_noise || quantity == InputQuantity::current_noise;
}
inline constexpr std::size_t quantity_count = 21;

/// How a quantity is written.
struct QuantityAbout {
  std::string_view name;   ///< in files: "position_zero"
  std::string_view title;  ///< for people: "position sensor, zero"
  std::string_view group;  ///< what one would improve: "position sensor"
  std::string_view unit;   ///< for people: "um"
  double per_SI;           ///< value in `unit` over value in SI
  bool part_of_model;      ///< of the sensor's model; else of an instrument or the oil
};
[[nodiscard]] const QuantityAbout& about(InputQuantity quantity);

/// One number a quantity.
template <class T>
struct PerQuantity {
  std::array<T, quantity_count> values{};
  [[nodiscard]] constexpr T& operator[](InputQuantity q) { return values[static_cast<std::size_t>(q)]; }
  [[nodiscard]] constexpr const T& operator[](InputQuantity q) const { return values[static_cast<std::size_t>(q)]; }
};

/// Type A: from repeated measurements; type B: from anything else (JCGM 100, 3.3.4).
enum class Evaluation { type_a, type_b };

/// What is known of one quantity's error.
struct InputUncertainty {
  InputQuantity quantity{};
  double standard_uncertainty = 0;  ///< in the quantity's SI unit
  Evaluation evaluation = Evaluation::type_b;
  Distribution distribution = Distribution::normal;
  double degrees_of_freedom = 0;  ///< may be infinite
  std::string source;             ///< where the figure is from
};

/// Two quantities whose errors have something in common.
struct Correlation {
  InputQuantity one, other;
  double coefficient;  ///< -1 to 1
  std::string source;
};

}  // namespace spoolflow::uncertainty
