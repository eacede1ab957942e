#include "addons/live/blocks/block.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "addons/live/blocks/steps.hpp"

namespace spoolflow::fleet {
namespace {

using estimation::TimedSample;

constexpr double none = estimation::not_measured;

/// A valve at work for so many milliseconds, with what goes wrong with samples now and then.
Block random_block(std::mt19937_64& random, std::size_t samples) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto rarely = [&](double value) { return unit(random) > 0.98 ? none : value; };
  Block block{.valve = "hall_3/press_1", .model_sha256 = std::string(62, 'a') + "07"};
  block.session = random() >> 2U;
  block.number = 1 + (random() >> 3U);
  block.first = block.number - (random() % 2);
  block.wall_ms = static_cast<std::int64_t>(random() % 4'000'000'000'000ULL);
  const bool whole = random() % 2 == 0;
  double time_s = 2e9 * unit(random);
  for (std::size_t k = 0; k < samples; ++k) {
    time_s += unit(random) > 0.99 ? unit(random) : 1e-3;
    TimedSample sample{rarely(time_s), rarely(3 * unit(random)), rarely(24 * unit(random)), rarely(1e-3 * unit(random)),
                       rarely(313 + unit(random))};
    if (whole) {
      sample.current_a_A = unit(random) > 0.95 ? std::numeric_limits<double>::infinity() : unit(random);
      sample.ports.a_Pa = rarely(2e7 * (1 + unit(random)));
    }
    if (unit(random) > 0.999) sample.current_A = 1e30 * unit(random);
    block.samples.push_back(on_grid(sample));
  }
  return block;
}

bool same_bits(const TimedSample& a, const TimedSample& b) {
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) || (std::isnan(x) && std::isnan(y));
  };
  bool out = same(a.time_s, b.time_s);
  for (const BlockChannel& channel : block_channels) out = out && same(member(a, channel), member(b, channel));
  return out;
}

TEST(Block, ComesBackBitForBit) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 200; ++round) {
    const Block block = random_block(random, random() % 1200);
    const std::vector<std::uint8_t> bytes = write_block(block);
    const auto read = read_block(bytes);
    ASSERT_TRUE(std::holds_alternative<Block>(read)) << name(std::get<NoBlock>(read));
    const Block& back = std::get<Block>(read);
    EXPECT_EQ(back.valve, block.valve);
    EXPECT_EQ(back.model_sha256, block.model_sha256);
    EXPECT_EQ(back.session, block.session);
    EXPECT_EQ(back.number, block.number);
    EXPECT_EQ(back.first, block.first);
    EXPECT_EQ(back.wall_ms, block.wall_ms);
    ASSERT_EQ(back.samples.size(), block.samples.size());
    for (std::size_t k = 0; k < block.samples.size(); ++k) {
      ASSERT_TRUE(same_bits(back.samples[k], block.samples[k])) << round << ", sample " << k;
    }
    EXPECT_EQ(write_block(back), bytes);
  }
}

TEST(Block, GridsAreHalfAStepAwayAtMostAndStay) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 1000; ++round) {
    const TimedSample sample{1e9 * unit(random), 5 * unit(random), 30 * unit(random), 1e-3 * unit(random), 313};
    const TimedSample once = on_grid(sample);
    EXPECT_LE(std::abs(once.time_s - sample.time_s), 0.5 * time_step_s);
    EXPECT_LE(std::abs(once.position_m - sample.position_m), 0.5e-9);
    EXPECT_LE(std::abs(once.current_A - sample.current_A), 8e-6);
    EXPECT_TRUE(same_bits(on_grid(once), once));
  }
}

TEST(Block, ValuesBeyondTheGridStayImplausibleAndInfiniteOnesAreMissing) {
  TimedSample sample{std::numeric_limits<double>::infinity(), 1e30, -1e30, std::numeric_limits<double>::infinity(),
                     313};
  sample = on_grid(sample);
  EXPECT_TRUE(std::isnan(sample.time_s));
  EXPECT_GT(sample.current_A, 1e4);
  EXPECT_LT(sample.voltage_V, -1e5);
  EXPECT_TRUE(std::isnan(sample.position_m));
}

TEST(Block, RefusesEveryDamagedByteAndEveryOtherLength) {
  std::mt19937_64 random(3);
  const std::vector<std::uint8_t> whole = write_block(random_block(random, 100));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const unsigned bits : {0x01U, 0x80U, 0xFFU}) {
      std::vector<std::uint8_t> damaged = whole;
      damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ bits);
      EXPECT_TRUE(std::holds_alternative<NoBlock>(read_block(damaged))) << at;
    }
  }
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_TRUE(std::holds_alternative<NoBlock>(read_block({whole.data(), length}))) << length;
  }
}

TEST(Block, TakesAFewBytesASample) {
  Block block{.valve = "site/v", .model_sha256 = std::string(64, '0')};
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise;
  for (int k = 0; k < 1000; ++k) {
    const double t = 1e-3 * k;
    block.samples.push_back(
        on_grid({1000 + t, 1 + 0.1 * std::sin(900 * t) + 1e-3 * noise(random), 12 + 0.02 * noise(random),
                 5e-4 + 2e-7 * noise(random), 313 + 0.01 * noise(random)}));
  }
  EXPECT_LT(write_block(block).size(), 8'000U);  // 32 kB as datagrams' numbers are 16 kB
}

Block reporting() {
  Block block{.valve = "hall/v", .model_sha256 = std::string(64, 'b'), .session = 5, .number = 9, .first = 8};
  block.wall_ms = 1'700'000'000'000;
  SiteReport report{
      .summary = {1000, 7.5, 1e-5, 2e-5, 3e-5, none, 4e-5, 90, 1U << 31U}, .samples = 7500, .energy_J = 0.1};
  report.indicators.push_back({"friction_ratio", 1.5, 0.1, none, "raised", "1"});
  report.events.push_back({.wall_ms = 12, .time_s = 7, .kind = "source", .text = "Ventil f\xC3\xBCr Presse"});
  report.alarms.push_back({.id = 3, .cause = "friction", .sign = "M", .raised_ms = 11, .gone_ms = 13, .text = "seen"});
  report.alarms.back().indicators = report.indicators;
  block.report = std::move(report);
  return block;
}

TEST(Block, AReportComesBackAsItWasWritten) {
  const std::vector<std::uint8_t> bytes = write_block(reporting());
  const auto read = read_block(bytes);
  const Block* const block = std::get_if<Block>(&read);
  ASSERT_TRUE(block != nullptr && block->report);
  EXPECT_EQ(block->first, 8U);
  EXPECT_EQ(block->report->summary.status, 1U << 31U);
  EXPECT_TRUE(std::isnan(block->report->summary.lower_min_m3_per_s));
  EXPECT_EQ(block->report->energy_J, 0.1);
  EXPECT_EQ(block->report->events.at(0).text, "Ventil f\xC3\xBCr Presse");
  EXPECT_EQ(block->report->alarms.at(0).indicators.at(0).name, "friction_ratio");
  EXPECT_EQ(write_block(*block), bytes);
}

NoBlock reason(const std::vector<std::uint8_t>& bytes) {
  const auto read = read_block(bytes);
  EXPECT_TRUE(std::holds_alternative<NoBlock>(read));
  return std::holds_alternative<NoBlock>(read) ? std::get<NoBlock>(read) : NoBlock::no_mark;
}

TEST(Block, AValveNameThatNoSiteFileTakesIsRefused) {
  const std::string longest(32, 'a');
  for (const std::string& valve : {longest + "/" + longest, std::string("H-1_a/v.2-_")}) {
    Block block = reporting();
    block.valve = valve;
    EXPECT_TRUE(std::holds_alternative<Block>(read_block(write_block(block)))) << valve;
  }
  for (const std::string& valve :
       {std::string("hall/\xFF"), std::string("hall/\xC3"), std::string("hall/a\0b", 8), std::string("hall/a\nb"),
        std::string("hall/a b"), std::string("hall/a/b"), std::string("hall"), std::string("/v"), std::string("hall/"),
        std::string("h.all/v"), std::string("hall/\x1B[31m"), std::string("hall/\xC3\xBC"), longest + "a/v"}) {
    Block block = reporting();
    block.valve = valve;
    EXPECT_EQ(reason(write_block(block)), NoBlock::wrong_name) << valve;
    EXPECT_FALSE(read_block_header(write_block(block)));
  }
}

TEST(Block, ASitesClockBeyondTheCalendarIsRefused) {
  constexpr std::int64_t year_10000_ms = 253'402'300'800'000;
  for (const std::int64_t wall_ms : {std::int64_t{-1}, year_10000_ms, std::numeric_limits<std::int64_t>::max(),
                                     std::numeric_limits<std::int64_t>::min()}) {
    Block block = reporting();
    block.wall_ms = wall_ms;
    EXPECT_EQ(reason(write_block(block)), NoBlock::wrong_number) << wall_ms;
    block = reporting();
    block.report->events[0].wall_ms = wall_ms;
    EXPECT_EQ(reason(write_block(block)), NoBlock::wrong_content) << wall_ms;
    block = reporting();
    block.report->alarms[0].gone_ms = wall_ms;
    EXPECT_EQ(reason(write_block(block)), NoBlock::wrong_content) << wall_ms;
  }
}

TEST(Block, TheHeaderOfOneWhoseContentIsWrongIsKnown) {
  Block block = reporting();
  block.report->energy_J = none;
  const std::vector<std::uint8_t> bytes = write_block(block);
  EXPECT_EQ(reason(bytes), NoBlock::wrong_content);
  const auto header = read_block_header(bytes);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->valve, "hall/v");
  EXPECT_EQ(header->number, 9U);
  EXPECT_EQ(header->first, 8U);
  EXPECT_FALSE(header->report);
}

TEST(Block, AReportIsWrittenAsItCanBeKept) {
  Block block = reporting();
  block.report->summary.upper_max_m3_per_s = std::numeric_limits<double>::infinity();
  block.report->indicators[0].value = -1e300;
  block.report->events[0].text = "a\tb\xFF" + std::string(5000, 'c');
  block.report->alarms[0].cause = std::string(255, 'd') + "\xC3\xBC";  // of which a half has no room
  const auto read = read_block(write_block(block));
  ASSERT_TRUE(std::holds_alternative<Block>(read)) << name(std::get<NoBlock>(read));
  const SiteReport& report = *std::get<Block>(read).report;
  EXPECT_TRUE(std::isnan(report.summary.upper_max_m3_per_s));
  EXPECT_TRUE(std::isnan(report.indicators[0].value));
  EXPECT_EQ(report.events[0].text, "a?b?" + std::string(longest_text - 4, 'c'));
  EXPECT_EQ(report.alarms[0].cause, std::string(255, 'd'));
}

TEST(Block, AReportThatADatabaseCouldNotKeepIsRefused) {
  const std::vector<std::uint8_t> sound = write_report(*reporting().report);
  const std::string_view known = "Ventil";
  const auto at = std::search(sound.begin(), sound.end(), known.begin(), known.end());
  ASSERT_NE(at, sound.end());
  for (const std::string_view text : {"\xFF", "\xC3", "\xC0\x80", "\xED\xA0\x80", "\xF8\x80\x80\x80\x80",
                                      "\xF4\x90\x80\x80", "\x1B", "\n", "\x7F", "\xC2\x85"}) {
    std::vector<std::uint8_t> body = sound;
    std::copy(text.begin(), text.end(), body.begin() + (at - sound.begin()));
    SiteReport report;
    EXPECT_FALSE(read_report(body, report)) << text;
  }
  for (const double number :
       {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 2e15}) {
    std::vector<std::uint8_t> body = sound;
    std::memcpy(body.data() + sizeof(std::uint64_t), &number, sizeof number);  // the summary's time
    SiteReport report;
    EXPECT_FALSE(read_report(body, report)) << number;
  }
  for (const std::int64_t id : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1} << 40U}) {
    Block block = reporting();
    block.report->alarms[0].id = id;
    EXPECT_TRUE(std::holds_alternative<NoBlock>(read_block(write_block(block)))) << id;
  }
  std::vector<std::uint8_t> body = write_report(*reporting().report);
  for (std::size_t length = 0; length < body.size(); ++length) {
    SiteReport cut;
    EXPECT_FALSE(read_report(std::span(body).first(length), cut)) << length;
  }
}

TEST(Partition, IsThatOfTheNameAlone) {
  EXPECT_EQ(partition_of("hall_3/press_1"), partition_of(std::string("hall_3/") + "press_1"));
  std::vector<int> valves(partition_count);
  for (int k = 0; k < 1600; ++k) ++valves[partition_of("site/valve_" + std::to_string(k))];
  for (const int count : valves) EXPECT_NEAR(count, 100, 50);
}

}  // namespace
}  // namespace spoolflow::fleet
