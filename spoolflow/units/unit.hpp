#pragma once
/// Units by their written name, as they stand in column headers and channel maps.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::units {

enum class Dimension { time, current, voltage, length, ratio, force, pressure, temperature, flow, none };

/// value_SI = scale * value + offset.
struct Unit {
  std::string name;  ///< the spelling used in our own files: "L_min"
  Dimension dimension;
  double scale;
  double offset;
};

/// The unit of any accepted spelling: "L/min", "l/min", "L_min", "degC", "°C", "um", "µm" …; nothing for other names.
[[nodiscard]] std::optional<Unit> unit_named(std::string_view spelling);
/// Our own spelling of every unit of a dimension, for messages: "m, mm, um".
[[nodiscard]] std::string units_of(Dimension dimension);
[[nodiscard]] std::string_view name(Dimension dimension);

}  // namespace spoolflow::units
