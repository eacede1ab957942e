#include "spoolflow/validation/trace.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::validation {
namespace {

struct Wave {
  std::vector<double> time_s;
  std::vector<float> value;

  explicit Wave(int samples) {
    for (int k = 0; k < samples; ++k) {
      time_s.push_back(k * 1e-3);
      value.push_back(static_cast<float>(std::sin(k * 1e-3)));
    }
  }
};

TEST(Trace, KeepsEverySpikeHoweverShort) {
  Wave wave(100000);
  wave.value[12345] = 7;
  wave.value[54321] = -9;
  const Line thin = thinned(wave.time_s, wave.value, 500);
  EXPECT_LE(thin.time_s.size(), 1100U);
  EXPECT_EQ(*std::max_element(thin.value.begin(), thin.value.end()), 7.0F);
  EXPECT_EQ(*std::min_element(thin.value.begin(), thin.value.end()), -9.0F);
  const auto at = std::max_element(thin.value.begin(), thin.value.end()) - thin.value.begin();
  EXPECT_DOUBLE_EQ(thin.time_s[static_cast<std::size_t>(at)], 12.345);
  EXPECT_TRUE(std::is_sorted(thin.time_s.begin(), thin.time_s.end()));
}

TEST(Trace, LeavesAShortSeriesAsItIs) {
  const Wave wave(300);
  const Line thin = thinned(wave.time_s, wave.value, 500);
  EXPECT_EQ(thin.time_s, wave.time_s);
  EXPECT_EQ(thin.value, wave.value);
}

TEST(Trace, BreaksWhereNothingWasRecordedAndWhereValuesAreMissing) {
  Wave wave(20000);
  for (std::size_t k = 10000; k < wave.time_s.size(); ++k) wave.time_s[k] += 30;  // half a minute without samples
  for (std::size_t k = 2000; k < 4000; ++k) wave.value[k] = std::nanf("");
  const Line thin = thinned(wave.time_s, wave.value, 200);
  const auto missing = [&](double from_s, double to_s) {
    for (std::size_t k = 0; k < thin.time_s.size(); ++k) {
      if (std::isnan(thin.value[k]) && thin.time_s[k] >= from_s && thin.time_s[k] <= to_s) return true;
    }
    return false;
  };
  EXPECT_TRUE(missing(2, 4));
  EXPECT_TRUE(missing(9.9, 40.1));
  EXPECT_FALSE(missing(4.3, 9.5));
}

TEST(Trace, OfABandCoversTheWholeBand) {
  const Wave wave(50000);
  std::vector<float> upper = wave.value;
  for (float& value : upper) value += 1;
  upper[777] = 5;
  const Ribbon thin = thinned_band(wave.time_s, wave.value, upper, 100);
  EXPECT_LE(thin.time_s.size(), 102U);
  EXPECT_EQ(*std::max_element(thin.upper.begin(), thin.upper.end()), 5.0F);
  EXPECT_EQ(*std::min_element(thin.lower.begin(), thin.lower.end()),
            *std::min_element(wave.value.begin(), wave.value.end()));
}

TEST(Trace, OfNothingOrOneSampleIsNothingOrThatSample) {
  EXPECT_TRUE(thinned({}, {}, 100).time_s.empty());
  const std::vector<double> time_s{3.0};
  const std::vector<float> value{4.0F};
  EXPECT_EQ(thinned(time_s, value, 100).value, value);
  EXPECT_EQ(thinned_band(time_s, value, value, 100).upper, value);
}

}  // namespace
}  // namespace spoolflow::validation
