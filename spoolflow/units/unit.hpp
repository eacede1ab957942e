#pragma once
/// Units by their written name, each with its dimension and its way to SI.
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace spoolflow::units {

enum class Dimension : std::uint8_t {
  ratio,
  time,
  current,
  voltage,
  length,
  force,
  pressure,
  temperature,
  volume_flow,
  kinematic_viscosity,
  density,
};
[[nodiscard]] std::string_view name(Dimension dimension);

/// value in SI = factor * value + offset. The SI unit itself has factor 1 and offset 0.
struct Unit {
  std::string_view name;    ///< as people write it: "L/min"
  std::string_view header;  ///< as it ends a column name: "L_min"
  Dimension dimension;
  double factor;
  double offset = 0.0;

  [[nodiscard]] constexpr double to_SI(double value) const { return factor * value + offset; }
  [[nodiscard]] constexpr double from_SI(double value_SI) const { return (value_SI - offset) / factor; }
};

/// Every known unit; those of one dimension stand together, the most usual first.
[[nodiscard]] std::span<const Unit> all_units();

/// The unit written so, or in another usual spelling: "°C", "degC", "mm^2/s", "l/min", "L_min", "µm", "%", "MBAR".
/// Case does not count: no unit of the table differs from another by case alone, and nobody records oil pressures in
/// millipascal or currents in megaampere. Bytes above 127 are read as UTF-8 or as Latin-1.
[[nodiscard]] std::optional<Unit> unit_named(std::string_view written);

}  // namespace spoolflow::units
