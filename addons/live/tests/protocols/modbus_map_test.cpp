#include "addons/live/protocols/modbus_map.hpp"

#include <gtest/gtest.h>

namespace spoolflow::fieldbus {
namespace {

TEST(ModbusMap, HasTheHighWordFirst) {
  PlantAnswer valve;
  valve.id = "press_1";
  valve.flow_m3_per_s = 20.0 / 60000;
  valve.pressure_difference_Pa = 35e5;
  valve.samples = 0x0001000200030004;
  valve.status = sensor::Status::coil_fault;
  valve.ne107 = 4;
  valve.stalled = false;
  const std::vector<std::uint16_t> registers = modbus_registers({PlantAnswer{}, valve});
  ASSERT_EQ(registers.size(), modbus_head + 2 * modbus_per_valve);
  EXPECT_EQ(registers[0], 0x5346);
  EXPECT_EQ(registers[2], 2);
  const std::uint16_t* at = registers.data() + modbus_head + modbus_per_valve;
  EXPECT_EQ(at[0], 0x41A0);  // 20.0F is 41A00000
  EXPECT_EQ(at[1], 0x0000);
  EXPECT_EQ(at[6], 0x420C);   // 35.0F
  EXPECT_EQ(at[10], 0x0010);  // bit 20
  EXPECT_EQ(at[11], 0x0000);
  EXPECT_EQ(at[12], 4);
  EXPECT_EQ(at[13], 0);
  EXPECT_EQ(at[14], 1);
  EXPECT_EQ(at[17], 4);
  EXPECT_EQ(at[20], 'p' << 8 | 'r');
  EXPECT_EQ(at[23], '1' << 8);
}

TEST(ModbusMap, WritesWhatIsNotKnownAsNotANumber) {
  const std::vector<std::uint16_t> registers = modbus_registers({PlantAnswer{}});
  EXPECT_EQ(registers[modbus_head] & 0x7FC0, 0x7FC0);
  EXPECT_EQ(registers[modbus_head + 13], 1);
}

TEST(ModbusMap, LeavesOutWhatAnAddressOf16BitsCannotReach) {
  EXPECT_LE(modbus_registers(std::vector<PlantAnswer>(3000)).size(), 65536U);
}

}  // namespace
}  // namespace spoolflow::fieldbus
