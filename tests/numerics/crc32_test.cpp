#include "spoolflow/numerics/crc32.hpp"

#include <array>

#include <gtest/gtest.h>

namespace spoolflow::numerics {
namespace {

TEST(Crc32, IsThatOfZlib) {
  constexpr std::array<std::uint8_t, 9> digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  static_assert(crc32(digits) == 0xCBF43926U);
  EXPECT_EQ(crc32({}), 0U);
}

TEST(Crc32, FindsEverySingleBit) {
  std::array<std::uint8_t, 32> bytes{};
  const std::uint32_t whole = crc32(bytes);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] = static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_NE(crc32(bytes), whole) << bit;
    bytes[bit / 8] = 0;
  }
}

}  // namespace
}  // namespace spoolflow::numerics
