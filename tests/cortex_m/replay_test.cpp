#include "tests/cortex_m/replay.hpp"

#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace spoolflow::cortex_m {
namespace {

using estimation::Estimator;
using sensor::Status;

constexpr double most_percent = 0.11;      // of the rated flow: a tenth of what the best flow meters claim
constexpr std::uint32_t painting = 32;     // bytes next to the caller that are not painted
constexpr std::uint32_t handing_over = 3;  // instructions of main that put the step's arguments into registers

/// The limits of instructions are those of the page's compiler, GCC 12; another takes up to so many times as many.
#ifdef SPOOLFLOW_EMBEDDED_PAGE
constexpr double of_compiler = 1;
#else
constexpr double of_compiler = 1.05;
#endif

struct Limits {
  std::uint32_t instructions;
  std::size_t ways;
  std::uint32_t longest_way;
  std::uint32_t stack_bytes;
  std::uint32_t flash_bytes = 65536;
};

void expect_fit_for_a_valve(const Replay& replay, const Limits& limits) {
  EXPECT_GE(replay.points, 60000U);
  EXPECT_LT(replay.largest_error_percent, most_percent);
  EXPECT_EQ(replay.not_a_number, 0U);
  EXPECT_FALSE(replay.made_nan);
  EXPECT_FALSE(replay.met_denormal);
  EXPECT_LE(replay.all.largest, of_compiler * limits.instructions);
  EXPECT_LE(replay.longest_way.value_or(0), of_compiler * limits.longest_way);  // which no input exceeds
  if (replay.longest_way) {
    EXPECT_LE(replay.all.largest, *replay.longest_way + handing_over);
  }
  EXPECT_EQ(replay.ways.size(), limits.ways);
  EXPECT_LT(replay.state_bytes, 2048U);
  EXPECT_LE(replay.stack_bytes, replay.worst_stack_bytes + painting);
  EXPECT_LE(replay.worst_stack_bytes, limits.stack_bytes);
  EXPECT_LT(replay.flash_bytes, limits.flash_bytes);
}

/// docs/embedded.md shows these figures, of GCC 12; not those of a sanitized build, whose model differs in last digits.
void expect_documented([[maybe_unused]] const Core& core, [[maybe_unused]] const char* sensor,
                       [[maybe_unused]] const Replay& replay) {
#ifdef SPOOLFLOW_EMBEDDED_PAGE
  if (core.name == std::string("Cortex-M7")) return;  // the page says that it costs as the M4F
  std::ifstream page(SPOOLFLOW_EMBEDDED_PAGE);
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  const std::string longest = replay.longest_way ? std::to_string(*replay.longest_way) : "-";
  const std::string row =
      fmt::format("| {} | {} | {} | {} | {} |\n", core.name, sensor, replay.all.median, replay.all.largest, longest);
  EXPECT_NE(text.find(row), std::string::npos) << "docs/embedded.md has other figures; put into its table: " << row;
#endif
}

class CortexM : public ::testing::TestWithParam<Core> {
 protected:
  const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  const std::filesystem::path minute = SPOOLFLOW_EXAMPLES "/valve_a/duty_cycle_1.h5";
};

TEST_P(CortexM, ObserverAnswersAsTheHostOverAMinuteOfOperation) {
  const Replay observer = replay(model, Estimator::observer, minute, GetParam());
  expect_fit_for_a_valve(observer, {1490, 9, 2630, 480});
  expect_documented(GetParam(), "observer", observer);
  for (const Status status :
       {Status::closed, Status::spool_at_rest, Status::outside_force_map, Status::outside_temperature,
        Status::position_fault, Status::sample_missing, Status::dithered, Status::temperature_fault}) {
    EXPECT_TRUE(has(observer.statuses, status)) << static_cast<std::uint32_t>(status);
  }
}

TEST_P(CortexM, CondensedSensorAnswersAsTheHostOverAMinuteOfOperation) {
  const Replay condensed = replay(model, Estimator::condensed, minute, GetParam());
  expect_fit_for_a_valve(condensed, {120, 4, 135, 40});
  expect_documented(GetParam(), "condensed", condensed);
}

TEST_P(CortexM, WholeValveCostsAQuarterMoreThanOneDirection) {
  const Replay valve = replay(on_both_sides(model), Estimator::observer, minute, GetParam());
  expect_fit_for_a_valve(valve, {1770, 9, 3540, 740, 98304});
  expect_documented(GetParam(), "observer, whole valve", valve);
  EXPECT_LE(valve.state_bytes, 1536U);
  for (const Status status : {Status::closed, Status::spool_at_rest, Status::outside_temperature,
                              Status::position_fault, Status::sample_missing, Status::dithered}) {
    EXPECT_TRUE(has(valve.statuses, status)) << static_cast<std::uint32_t>(status);
  }
}

TEST_P(CortexM, CondensedSensorOfAWholeValveAnswersAsTheHost) {
  // 150 but for a sample without a position, after which the band opens to both sides.
  const Replay valve = replay(on_both_sides(model), Estimator::condensed, minute, GetParam());
  expect_fit_for_a_valve(valve, {350, 4, 370, 400, 131072});
  expect_documented(GetParam(), "condensed, whole valve", valve);
}

TEST_P(CortexM, SelfTestOfAnExportFindsItSound) {
  EXPECT_EQ(self_test_status(model, GetParam()), 0);
  EXPECT_EQ(self_test_status(on_both_sides(model), GetParam()), 0);
}

class SoftFloat : public CortexM {};

/// Minutes; run by the long tests. There is no unit that would report a NaN it made.
TEST_P(SoftFloat, DISABLED_BothSensorsAnswerAsTheHostWithoutAFloatingPointUnit) {
  const bool m0plus = GetParam().name == std::string("Cortex-M0+");
  const Replay observer = replay(model, Estimator::observer, minute, GetParam());
  expect_fit_for_a_valve(observer, {m0plus ? 61000U : 33200U, 9, 0, 690, 98304});
  expect_documented(GetParam(), "observer", observer);
  const Replay condensed = replay(model, Estimator::condensed, minute, GetParam());
  expect_fit_for_a_valve(condensed, {m0plus ? 5500U : 3100U, 4, 0, 120, 98304});
  expect_documented(GetParam(), "condensed", condensed);
  EXPECT_EQ(self_test_status(model, GetParam()), 0);
}

INSTANTIATE_TEST_SUITE_P(Cores, SoftFloat, ::testing::ValuesIn(soft_float_cores),
                         [](const auto& core) { return core.index == 0 ? "M3" : "M0plus"; });

INSTANTIATE_TEST_SUITE_P(M4F, CortexM, ::testing::Values(cores[0]));
/// The same instructions as the M4F's; run by the long tests.
INSTANTIATE_TEST_SUITE_P(DISABLED_M7, CortexM, ::testing::Values(cores[1]));

}  // namespace
}  // namespace spoolflow::cortex_m
