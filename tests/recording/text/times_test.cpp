/// Times and samples as recorders and spreadsheets write them: rounded, in minutes, saturated.
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/reader.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using testing::HasSubstr;

/// A thousand samples at 1 kHz.
std::string with_decimals(int decimals) {
  std::string out = "time_s,current_A\n";
  for (int k = 0; k < 1000; ++k) out += fmt::format("{:.{}f},1\n", 1e-3 * k, decimals);
  return out;
}

TEST(Times, AreRefusedWhereMostSamplesRepeatTheOneBefore) {
  const TemporaryFile rounded("run.csv", with_decimals(2)), fine("fine.csv", with_decimals(3));
  EXPECT_THAT(refusal([&] { (void)read_recording(rounded.path(), {}); }),
              HasSubstr("column 'time_s': the times are rounded: 9.9 samples have the same one on average"));
  EXPECT_EQ(read_recording(fine.path(), {}).size(), 1000u);
}

TEST(Times, MayBeInMinutesAndHours) {
  const TemporaryFile minutes("min.csv", "Time [min],current_A\n0,1\n0.001,1\n"),
      hours("h.csv", "time_h,current_A\n0,1\n0.00001,1\n");
  EXPECT_NEAR(read_recording(minutes.path(), {})[Channel::time][1], 0.06, 1e-12);
  EXPECT_NEAR(read_recording(hours.path(), {})[Channel::time][1], 0.036, 1e-12);
}

TEST(Samples, AreSaturatedWhereAScopeWritesInfinity) {
  const TemporaryFile file("run.csv", "time_s,current_A\n0,1\n0.001,-∞\n");
  EXPECT_THAT(refusal([&] { (void)read_recording(file.path(), {}); }), HasSubstr("where a channel is saturated"));
}

}  // namespace
}  // namespace spoolflow::recording
