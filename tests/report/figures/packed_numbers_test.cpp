#include "spoolflow/report/figures/packed_numbers.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/report/figures/packed_bytes.hpp"

namespace spoolflow::report {
namespace {

TEST(PackedNumbers, AreTrueToA65000thOfTheirRange) {
  std::vector<float> values;
  for (int k = 0; k < 1000; ++k) values.push_back(static_cast<float>(1e-3 * std::sin(0.1 * k)));
  const PackedNumbers column = packed(values, 60000);
  const std::vector<double> back = unpacked(column);
  ASSERT_EQ(back.size(), values.size());
  for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(back[k], 60000.0 * values[k], 120.0 / 65000);
}

TEST(PackedNumbers, KeepTheLargestAndSmallestValueAndWhatIsMissing) {
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  const std::vector<double> back = unpacked(packed(std::vector<float>{-3, nothing, 1000}, 1));
  EXPECT_NEAR(back[0], -3, 1e-9);
  EXPECT_TRUE(std::isnan(back[1]));
  EXPECT_NEAR(back[2], 1000, 1e-9);
}

TEST(PackedNumbers, OfOneValueOfNoneAndOfNothingKnown) {
  EXPECT_EQ(unpacked(packed(std::vector<float>{4, 4}, 2)), (std::vector<double>{8, 8}));
  EXPECT_TRUE(unpacked(packed(std::vector<float>{}, 1)).empty());
  EXPECT_TRUE(std::isnan(unpacked(packed(std::vector<float>{std::numeric_limits<float>::infinity()}, 1)).front()));
}

TEST(PackedTimes, OfEvenStepsNeedNoTable) {
  std::vector<double> time_s;
  for (int k = 0; k < 1000; ++k) time_s.push_back(5 + 1e-3 * k);
  const PackedTimes times = packed_times(time_s);
  EXPECT_TRUE(times.base64.empty());
  EXPECT_NEAR(times.step_s, 1e-3, 1e-12);
  EXPECT_EQ(times.count, 1000U);
}

TEST(PackedTimes, OfUnevenStepsAreTrueToAMicrosecondOfAnHour) {
  const std::vector<double> time_s{0, 0.5, 2.25, 3600};
  const PackedTimes times = packed_times(time_s);
  const std::vector<std::uint32_t> counts = numbers_of<std::uint32_t>(times.base64);
  ASSERT_EQ(counts.size(), time_s.size());
  for (std::size_t k = 0; k < time_s.size(); ++k)
    EXPECT_NEAR(times.start_s + times.step_s * counts[k], time_s[k], 1e-6);
}

TEST(PackedTimes, NeverRunBackwards) {
  const PackedTimes times = packed_times(std::vector<double>{0, 5, 1, 10});
  const std::vector<std::uint32_t> counts = numbers_of<std::uint32_t>(times.base64);
  for (std::size_t k = 1; k < counts.size(); ++k) EXPECT_GE(counts[k], counts[k - 1]);
}

}  // namespace
}  // namespace spoolflow::report
