#pragma once
/// A site's valves as Modbus registers. The map is in docs/fieldbus.md.
#include <cstdint>
#include <vector>

#include "addons/live/protocols/plant_answer.hpp"

namespace spoolflow::fieldbus {

inline constexpr std::size_t modbus_head = 16, modbus_per_valve = 32;
inline constexpr std::size_t modbus_most_valves = (65536 - modbus_head) / modbus_per_valve;

/// Numbers of several registers have the high word first; float is IEEE 754, NaN: not known. Valves beyond
/// modbus_most_valves are left out.
[[nodiscard]] std::vector<std::uint16_t> modbus_registers(const std::vector<PlantAnswer>& valves);

}  // namespace spoolflow::fieldbus
