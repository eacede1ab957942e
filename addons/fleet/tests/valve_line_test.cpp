#include "addons/fleet/valve_line.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/blocks/steps.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::fleet {
namespace {

using ::testing::HasSubstr;
using Turn = ValveLine::Turn;

const live::SharedModel& size_6(const char* sha256 = "a") {
  static std::map<std::string, live::SharedModel> models;
  live::SharedModel& one = models[sha256];
  if (!one.model) {
    one.model = std::make_shared<const model::Model>(model::read_model(SPOOLFLOW_EXAMPLES "/live/size_6.json"));
    one.sha256 = sha256;
  }
  return one;
}

constexpr live::AlarmDelays delays{.raised_after_s = 1, .gone_after_s = 2};

/// A second of a valve that strokes slowly; without its position where that is not `measured`.
Block second(std::uint64_t number, bool measured = true) {
  Block block{.valve = "hall/v", .model_sha256 = "a", .session = 7, .number = number, .first = number};
  block.wall_ms = 1'700'000'000'000 + 1000 * static_cast<std::int64_t>(number);
  for (int k = 0; k < 1000; ++k) {
    const double t = static_cast<double>(number) + 1e-3 * k;
    const double stroke = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * t / 8);
    block.samples.push_back(
        on_grid({t, 0.3 + 1.2 * stroke, 4 + 6 * stroke, measured ? 1.5e-3 * stroke : estimation::not_measured, 313}));
  }
  return block;
}

std::string text_of(const ValveRows& rows) {
  std::string out;
  const auto number = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  for (const SecondRow& one : rows.seconds) {
    out += fmt::format("second {} {} {} {} {}\n", one.block.number, one.wall_ms, number(one.summary.flow_mean_m3_per_s),
                       number(one.summary.energy_J), one.summary.status);
  }
  for (const IndicatorRow& one : rows.indicators) {
    out += fmt::format("indicator {} {} {}\n", one.block.number, one.indicator.name, number(one.indicator.value));
  }
  for (const live::Event& one : rows.events) out += fmt::format("event {} {}\n", one.wall_ms, one.text);
  for (const live::Alarm& one : rows.alarms) {
    out += fmt::format("alarm {} {} {} {} {}\n", one.id, one.cause, one.raised_ms, one.gone_ms, one.times);
  }
  return out;
}

TEST(ValveLine, TakesEachBlockOnceAndInItsTurn) {
  ValveLine at("hall/v", "test", delays);
  EXPECT_EQ(at.turn(second(2)), Turn::early);
  ASSERT_EQ(at.turn(second(1)), Turn::next);
  at.work(second(1), size_6());
  EXPECT_EQ(at.turn(second(1)), Turn::duplicate);
  EXPECT_EQ(at.turn(second(2)), Turn::next);
  EXPECT_EQ(at.turn(second(3)), Turn::early);
  Block older = second(2);
  older.session = 6;
  EXPECT_EQ(at.turn(older), Turn::duplicate);
  EXPECT_EQ(at.take_rows()->position.state.samples, 1000U);
  EXPECT_FALSE(at.take_rows().has_value());
}

TEST(ValveLine, ReportsBlocksThatTheSiteHasLost) {
  ValveLine at("hall/v", "test", delays);
  at.work(second(1), size_6());
  Block later = second(5);
  later.first = 3;
  EXPECT_EQ(at.turn(later), Turn::early);  // 2 may still come
  later.first = 2;
  ASSERT_EQ(at.turn(later), Turn::next);
  at.work(later, size_6());
  const ValveRows rows = *at.take_rows();
  EXPECT_EQ(rows.position.block.number, 5U);
  ASSERT_FALSE(rows.events.empty());
  EXPECT_THAT(rows.events.front().text, HasSubstr("blocks 2 to 4 are lost"));
}

TEST(ValveLine, CountsFromOneAgainWithAnotherStoreOfTheSite) {
  ValveLine at("hall/v", "test", delays);
  at.work(second(1), size_6());
  at.work(second(2), size_6());
  Block other = second(1);
  other.session = 8;
  ASSERT_EQ(at.turn(other), Turn::next);
  at.work(other, size_6());
  const ValveRows rows = *at.take_rows();
  EXPECT_EQ(rows.position.block.session, 8U);
  EXPECT_EQ(rows.position.state.samples, 3000U);
  EXPECT_THAT(rows.events.front().text, HasSubstr("counted from 1 again"));
}

TEST(ValveLine, ReportsFromWhichBlockOnAModelIsInForce) {
  ValveLine at("hall/v", "test", delays);
  at.work(second(1), size_6("a"));
  at.work(second(2), size_6("b"));
  const ValveRows rows = *at.take_rows();
  ASSERT_EQ(rows.models.size(), 2U);
  EXPECT_EQ(rows.models[1].from.number, 2U);
  EXPECT_EQ(rows.models[1].sha256, "b");
  EXPECT_EQ(rows.position.state.samples, 2000U);  // totals go on
}

/// One worker does all; of others each goes on from what the one before has kept.
TEST(ValveLine, GoesOnAnywhereBitForBit) {
  constexpr std::uint64_t blocks = 150;
  const auto measured = [](std::uint64_t number) { return number % 60 < 20 || number % 60 > 45; };
  std::string expected, got;
  ValvePosition end;
  ValveLine alone("hall/v", "test", delays);
  for (std::uint64_t number = 1; number <= blocks; ++number) {
    alone.work(second(number, measured(number)), size_6());
    const ValveRows rows = *alone.take_rows();
    expected += text_of(rows);
    end = rows.position;
  }
  EXPECT_THAT(expected, HasSubstr("alarm 1 "));
  EXPECT_THAT(expected, HasSubstr("indicator "));

  KeptValve kept;
  std::map<std::int64_t, live::Alarm> alarms;
  for (std::uint64_t number = 1; number <= blocks;) {
    ValveLine worker("hall/v", "test", delays);
    if (number > 1) worker.restore(kept, size_6());
    const std::uint64_t last = std::min(blocks, number + number % 7);
    for (; number <= last; ++number) {
      ASSERT_EQ(worker.turn(second(number)), Turn::next);
      worker.work(second(number, measured(number)), size_6());
      const ValveRows rows = *worker.take_rows();
      got += text_of(rows);
      kept.position = rows.position;
      for (const live::Alarm& one : rows.alarms) alarms[one.id] = one;
    }
    kept.alarms.clear();
    for (const auto& [id, one] : alarms) kept.alarms.push_back(one);
  }
  EXPECT_EQ(got, expected);
  EXPECT_EQ(kept.position.state.samples, end.state.samples);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(kept.position.state.energy_J),
            std::bit_cast<std::uint64_t>(end.state.energy_J));
}

TEST(ValveLine, AnAcknowledgementTakesEffectBehindABlockAndGoesOnWithAnotherWorker) {
  ValveLine line("hall/v", "test", delays);
  KeptValve kept;
  const Acknowledgement seen{.valve = "hall/v", .alarm = 1, .wall_ms = 17, .by = "anna"};
  line.acknowledge(seen);  // there is none yet
  for (std::uint64_t number = 1; number <= 6; ++number) {
    line.work(second(number, false), size_6());
    const ValveRows rows = *line.take_rows();
    kept.position = rows.position;
    if (!rows.alarms.empty()) kept.alarms = rows.alarms;
  }
  ASSERT_EQ(kept.alarms.size(), 1U);
  EXPECT_EQ(kept.alarms[0].acknowledged_ms, 0);

  ValveLine other("hall/v", "test", delays);
  other.restore(kept, size_6());
  EXPECT_EQ(other.acknowledge(seen).number, 6U);
  const auto rows = other.take_rows();
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->alarms.size(), 1U);
  EXPECT_EQ(rows->alarms[0].acknowledged_by, "anna");
  EXPECT_EQ(rows->alarms[0].acknowledged_ms, 17);
  EXPECT_THAT(rows->events.at(0).text, HasSubstr("acknowledged by anna"));
  EXPECT_EQ(rows->position.block.number, 6U);
  other.acknowledge({.valve = "hall/v", .alarm = 1, .wall_ms = 18, .by = "eve"});
  EXPECT_FALSE(other.take_rows());  // the first one counts
}

TEST(ValveLine, KeepsWhatASiteReportsAndWorksOnSamplesAgainWhenTheyCome) {
  const auto reported = [](std::uint64_t number) {
    Block block{.valve = "hall/v", .model_sha256 = "a", .session = 7, .number = number, .first = number};
    block.report = SiteReport{.summary = {.samples = 1000, .flow_mean_m3_per_s = 2e-4}, .samples = 1000 * number};
    block.report->energy_J = 5;
    block.report->alarms.push_back({.id = 4, .cause = "friction", .sign = "M", .raised_ms = 1});
    return block;
  };
  ValveLine line("hall/v", "test", delays);
  line.work(reported(1), size_6());
  const ValveRows first = *line.take_rows();
  EXPECT_EQ(first.models.size(), 1U);
  EXPECT_EQ(first.seconds.at(0).summary.flow_mean_m3_per_s, 2e-4);
  EXPECT_EQ(first.alarms.at(0).valve, "hall/v");
  EXPECT_GT(first.alarms.at(0).id, std::int64_t{1} << 40U);
  EXPECT_TRUE(first.position.state.bytes.empty());

  ValveLine other("hall/v", "test", delays);
  other.restore({first.position, first.alarms}, size_6());
  EXPECT_EQ(other.turn(reported(1)), Turn::duplicate);
  EXPECT_EQ(other.turn(reported(3)), Turn::early);
  other.work(reported(2), size_6());
  other.work(second(3), size_6());
  const ValveRows rows = *other.take_rows();
  EXPECT_TRUE(rows.models.empty());
  EXPECT_EQ(rows.seconds.size(), 2U);
  EXPECT_EQ(rows.position.state.samples, 3000U);
  EXPECT_GE(rows.position.state.energy_J, 5);
  EXPECT_FALSE(rows.position.state.bytes.empty());
}

}  // namespace
}  // namespace spoolflow::fleet
