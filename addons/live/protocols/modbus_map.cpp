#include "addons/live/protocols/modbus_map.hpp"

#include <algorithm>
#include <bit>

namespace spoolflow::fieldbus {
namespace {

void put(std::uint16_t* at, std::uint64_t bits, unsigned registers) {
  for (unsigned k = 0; k < registers; ++k) at[k] = static_cast<std::uint16_t>(bits >> 16U * (registers - 1 - k));
}
void put(std::uint16_t* at, double value) {
  put(at, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 2);
}

}  // namespace

std::vector<std::uint16_t> modbus_registers(const std::vector<PlantAnswer>& valves) {
  constexpr std::uint16_t mark = 0x5346, version = 1;  // "SF"
  const std::size_t count = std::min(valves.size(), modbus_most_valves);
  std::vector<std::uint16_t> out(modbus_head + count * modbus_per_valve);
  out[0] = mark;
  out[1] = version;
  out[2] = static_cast<std::uint16_t>(count);
  out[3] = modbus_per_valve;
  for (std::size_t k = 0; k < count; ++k) {
    const PlantAnswer& valve = valves[k];
    std::uint16_t* const at = out.data() + modbus_head + k * modbus_per_valve;
    put(at, valve.flow_m3_per_s * L_per_min_per_m3_per_s);
    put(at + 2, valve.flow_lower_m3_per_s * L_per_min_per_m3_per_s);
    put(at + 4, valve.flow_upper_m3_per_s * L_per_min_per_m3_per_s);
    put(at + 6, valve.pressure_difference_Pa / pascal_per_bar);
    put(at + 8, valve.rated_flow_m3_per_s * L_per_min_per_m3_per_s);
    put(at + 10, static_cast<std::uint32_t>(valve.status), 2);
    at[12] = valve.ne107;
    at[13] = valve.stalled ? 1 : 0;
    put(at + 14, valve.samples, 4);
    put(at + 18, valve.energy_J);
    for (std::size_t c = 0; c < std::min<std::size_t>(valve.id.size(), 24); ++c) {
      const auto letter = static_cast<unsigned char>(valve.id[c]);
      at[20 + c / 2] = static_cast<std::uint16_t>(at[20 + c / 2] | (c % 2 == 0 ? letter << 8U : letter));
    }
  }
  return out;
}

}  // namespace spoolflow::fieldbus
