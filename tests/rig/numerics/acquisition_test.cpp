#include "spoolflow/rig/numerics/acquisition.hpp"

#include <bit>

#include <gtest/gtest.h>

#include "spoolflow/rig/numerics/noise.hpp"

namespace spoolflow::rig {
namespace {

TEST(Acquisition, RoundsAsTheLibraryToTheLastBit) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  Noise numbers(1, "numbers");
  for (int k = 0; k < 20000; ++k) {
    const double whole = std::floor(numbers.uniform(-3000, 3000));
    for (const double value : {whole, whole + 0.5, std::nextafter(whole + 0.5, -1e9), numbers.uniform(-3, 3),
                               std::ldexp(numbers.uniform(-1, 1), k % 70)}) {
      EXPECT_EQ(bits(rounded(value)), bits(std::round(value))) << value;
    }
  }
  for (const double value : {0.0, -0.0, -0.3, 0x1p52, -0x1p53, HUGE_VAL}) {
    EXPECT_EQ(bits(rounded(value)), bits(std::round(value))) << value;
  }
  EXPECT_TRUE(std::isnan(rounded(std::nan(""))));
}

TEST(Acquisition, AMemoryOfTheLagChangesNothing) {
  LagMemory memory;
  double with = 0, without = 0;
  for (int k = 0; k < 100; ++k) {
    const double dt_s = k % 10 < 7 ? 1e-4 : 1e-3, time_constant_s = k < 60 ? 2e-3 : k < 70 ? 0.0 : 5e-3;
    with = lagged(with, k, dt_s, time_constant_s, memory);
    without = lagged(without, k, dt_s, time_constant_s);
    EXPECT_EQ(with, without) << k;
  }
}

}  // namespace
}  // namespace spoolflow::rig
