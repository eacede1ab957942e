/// What the engine of a site keeps, takes up again, deletes and reports.
#include "addons/live/engine.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/tests/engine_site.hpp"

namespace spoolflow::live {
namespace {

using ::testing::HasSubstr;

TEST_F(EngineTest, GoesOnWhereItWas) {
  write("run.csv", engine_header + rows(0, 5000));
  const SourceSettings replay = ReplaySettings{path("run.csv"), 0};
  double energy_J = 0;
  {
    Engine whole(site({{"r", replay}}), "test");
    whole.start();
    ASSERT_TRUE(has(whole, 0, 5000));
    energy_J = whole.view(0).energy_J;
    EXPECT_EQ(whole.source(0).trouble, "the recording has ended");
  }
  write("half.csv", engine_header + rows(0, 2000));
  SiteSettings kept = site({{"r", ReplaySettings{path("half.csv"), 0}}});
  kept.store = path("kept.sqlite");
  double half_J = 0;
  {
    Engine first(kept, "test");
    first.start();
    ASSERT_TRUE(has(first, 0, 2000));
    half_J = first.view(0).energy_J;
  }
  kept.valves[0].source = replay;  // the longer recording begins with what was worked on before
  Engine second(kept, "test");
  EXPECT_EQ(second.view(0).samples, 2000U);
  EXPECT_EQ(second.view(0).energy_J, half_J);
  second.start();
  ASSERT_TRUE(comes_true([&] { return second.source(0).trouble == "the recording has ended"; }));
  ASSERT_TRUE(has(second, 0, 5000));
  EXPECT_EQ(second.view(0).samples, 5000U);
  EXPECT_EQ(second.view(0).energy_J, energy_J);  // to the last digit
}

// Sensor, monitor, doubt, and the time behind which energy counts on: all that matters is kept.
TEST_F(EngineTest, AValveThatIsTakenUpAgainAnswersAsIfItHadNeverStopped) {
  const auto course = [](std::uint64_t begin, std::size_t count) {
    SampleBlock block{.after = {0, begin + count}, .arrived_ns = 1};
    for (std::size_t k = 0; k < count; ++k) {
      const double t = 0.001 * static_cast<double>(begin + k);
      const double place = std::sin(3 * t) + 0.2 * std::sin(41 * t);
      block.samples.push_back({t, 1.2 + 0.3 * place, 4.8 + place, 1e-3 + 4e-4 * place, 323.15});
    }
    return block;
  };
  ValveAtWork whole("v", model, "test");
  auto resumed = std::make_unique<ValveAtWork>("v", model, "test");
  std::int64_t samples = 0;
  for (std::uint64_t begin = 0; begin < 20'000;) {
    const std::size_t count = 1 + begin * 7919 % 900;
    whole.work(course(begin, count));
    resumed->work(course(begin, count));
    begin += count;
    const ValveCommit kept = resumed->take_commit(false);
    samples += kept.since_last.samples;
    resumed = std::make_unique<ValveAtWork>("v", model, "test");
    ASSERT_TRUE(resumed->restore(kept.state));
  }
  const ValveCommit expected = whole.take_commit(false), got = resumed->take_commit(false);
  EXPECT_EQ(got.state.bytes, expected.state.bytes);
  EXPECT_EQ(got.state.energy_J, expected.state.energy_J);
  EXPECT_EQ(got.state.next, expected.state.next);
  EXPECT_EQ(samples, expected.since_last.samples);
  EXPECT_GT(expected.state.energy_J, 0);
}

TEST_F(EngineTest, AValveWhoseKeptStateIsDamagedStartsAgainAndCountsOn) {
  ValveAtWork before("v", model, "test");
  ValveCommit kept = before.take_commit(false);
  kept.state.samples = 7;
  EXPECT_TRUE(ValveAtWork("v", model, "test").restore(kept.state));
  for (const std::size_t at : {std::size_t{0}, kept.state.bytes.size() / 2, kept.state.bytes.size() - 1}) {
    KeptState damaged = kept.state;
    damaged.bytes[at] ^= std::byte{0x80};
    ValveAtWork again("v", model, "test");
    EXPECT_FALSE(again.restore(damaged)) << "byte " << at;
    EXPECT_EQ(again.view(false).samples, 7U);
  }
}

TEST_F(EngineTest, AnotherModelStartsAgainAndCountsOn) {
  write("run.csv", engine_header + rows(0, 100));
  SiteSettings kept = site({{"r", ReplaySettings{path("run.csv"), 0}}});
  kept.store = path("kept.sqlite");
  {
    Engine first(kept, "test");
    first.start();
    ASSERT_TRUE(has(first, 0, 100));
  }
  kept.valves[0].model.sha256 = "another";
  const Engine second(kept, "test");
  EXPECT_EQ(second.view(0).samples, 100U);
  ASSERT_FALSE(second.events().empty());
  EXPECT_THAT(second.events().back().text, HasSubstr("are reset"));
}

// A file that may not grow stands for the full disk.
TEST_F(EngineTest, AFullDiskStopsKeepingNotWatching) {
  SiteSettings kept = site({{"t", TcpSettings{{"127.0.0.1", 0}}}});
  kept.store = path("kept.sqlite");
  Engine engine(kept, "test");
  engine.start();
  const Sender sender(engine.source(0).port);
  sender.send(engine_header + rows(0, 100));
  ASSERT_TRUE(has(engine, 0, 100));
  const auto before = ::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit no_more{4096, limit.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &no_more);
  sender.send(rows(100, 200));
  const bool reported = comes_true([&] { return !engine.store_view().trouble.empty(); });
  sender.send(rows(200, 300));
  const bool watched = has(engine, 0, 300);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, before);
  EXPECT_TRUE(reported);
  EXPECT_TRUE(watched);
  EXPECT_TRUE(comes_true([&] { return engine.store_view().trouble.empty(); }));
  EXPECT_TRUE(comes_true([&] {
    return engine.events().back().text ==
           "the store works again; what came while it failed is in it, the flow as one row";
  }));
  engine.stop();
  std::int64_t samples = 0;
  read_history(kept.store, "t", 0, std::int64_t{1} << 60,
               [&](const HistoryRow& row) { samples += row.summary.samples; });
  EXPECT_EQ(samples, 300);
}

TEST_F(EngineTest, BlocksThatADiskWithoutRoomRefusesAreGivenUpBeyondTheLimitAndTheLossIsAnEvent) {
  SiteSettings kept = site({{"t", TcpSettings{{"127.0.0.1", 0}}}});
  kept.store = path("kept.sqlite");
  kept.fleet.servers = {"nats://127.0.0.1:1"};  // nobody is asked: the store alone is looked at
  kept.fleet.site = "hall";
  kept.fleet.block_s = 0.1;
  kept.fleet.largest_MB = 0.002;
  Engine engine(kept, "test");
  const auto reported = [&engine](const char* text) {
    return comes_true([&] {
      const std::vector<Event> all = engine.events();
      return std::any_of(all.begin(), all.end(),
                         [&](const Event& one) { return one.text.find(text) != std::string::npos; });
    });
  };
  engine.start();
  const Sender sender(engine.source(0).port);
  sender.send(engine_header + rows(0, 100));
  ASSERT_TRUE(has(engine, 0, 100));
  const auto before = ::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit no_more{4096, limit.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &no_more);
  sender.send(rows(100, 5000));
  const bool reported_at_once = reported("the oldest are given up");
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, before);
  EXPECT_TRUE(reported_at_once);
  EXPECT_TRUE(reported("blocks that the fleet had not got were given up while the store kept nothing"));
  engine.stop();
  Database store = open_store_to_read(kept.store);
  const std::int64_t newest = store.number("SELECT max(number) FROM outbox");
  EXPECT_GE(newest, 49);
  EXPECT_LT(store.number("SELECT count(*) FROM outbox"), newest);
  EXPECT_EQ(store.number("SELECT number FROM outbox_position"), newest);
}

TEST_F(EngineTest, WhatIsTooOldIsDeletedWhileItRuns) {
  SiteSettings kept = site({{"t", TcpSettings{{"127.0.0.1", 0}}}});
  kept.store = path("kept.sqlite");
  kept.retention.days = 1;
  {
    Store store(kept.store);
    std::vector<Event> none;
    constexpr std::int64_t day_ms = 86'400'000;
    const ValveCommit old{.state = {.valve = "t", .layout = "old"}, .since_last = {.samples = 7}, .indicators = {}};
    store.commit({1000, 1000}, {old}, none);
    store.commit({2000, 1000 + 2 * day_ms}, {old}, none);  // after two days of work
  }
  const auto samples = [&] {
    std::int64_t out = 0;
    read_history(kept.store, "t", 0, std::int64_t{1} << 60, [&](const HistoryRow& row) { out += row.summary.samples; });
    return out;
  };
  ASSERT_EQ(samples(), 14);
  Engine engine(kept, "test");
  engine.start();
  const Sender sender(engine.source(0).port);
  sender.send(engine_header + rows(0, 100));
  EXPECT_TRUE(comes_true([&] { return samples() == 107; }));  // those of two days ago are gone
}

TEST_F(EngineTest, AStepOfTheSystemClockIsAnEventAndTakesNothingFromTheHistory) {
  constexpr std::int64_t day_ms = 86'400'000, hour_ms = 3'600'000;
  SiteSettings kept = site({{"t", TcpSettings{{"127.0.0.1", 0}}}});
  kept.store = path("kept.sqlite");
  const auto reported = [](const Engine& engine, const char* text) {
    return comes_true([&] {
      const std::vector<Event> all = engine.events();
      return std::any_of(all.begin(), all.end(),
                         [&](const Event& one) { return one.text.find(text) != std::string::npos; });
    });
  };
  const auto samples = [&] {
    std::int64_t out = 0;
    (void)refusal([&] {  // until the first second is kept it knows no valve
      read_history(kept.store, "t", 0, std::int64_t{1} << 60,
                   [&](const HistoryRow& row) { out += row.summary.samples; });
    });
    return out;
  };
  {
    std::atomic<std::int64_t> set_ms = 0;
    Engine engine(kept, "test");
    engine.go_by([&set_ms] {
      Instant now = instant();
      now.wall_ms += set_ms;
      return now;
    });
    engine.start();
    const Sender sender(engine.source(0).port);
    sender.send(engine_header + rows(0, 100));
    ASSERT_TRUE(comes_true([&] { return samples() == 100; }));
    set_ms = 45 * day_ms;
    EXPECT_TRUE(reported(engine, "set forward by 45.0 days"));
    sender.send(rows(100, 200));
    ASSERT_TRUE(comes_true([&] { return samples() == 200; }));
    set_ms = 45 * day_ms - hour_ms;
    EXPECT_TRUE(reported(engine, "set back by 60.0 min"));
  }
  EXPECT_EQ(samples(), 200);
  Engine again(kept, "test");
  again.start();
  EXPECT_TRUE(reported(again, "set back by 45.0 days"));  // while no program ran
  again.stop();
  EXPECT_EQ(samples(), 200);
}

TEST_F(EngineTest, ARigValveWorks) {
  const RigSettings rig{.valve = rig::valve_preset("size_6"), .seed = 3, .speed = 20};
  Engine engine(site({{"v", rig}}), "test");
  engine.start();
  ASSERT_TRUE(has(engine, 0, 3000));
  EXPECT_TRUE(std::isfinite(engine.view(0).answer.flow_m3_per_s));
  EXPECT_FALSE(engine.view(0).indicators.empty());
}

TEST_F(EngineTest, ARigValveThatWorksAsFastAsItCanIsHeardAndEnds) {
  const RigSettings rig{.valve = rig::valve_preset("size_6"), .seed = 3, .speed = 1e9};
  Engine engine(site({{"v", rig}}), "test");
  engine.start();
  EXPECT_TRUE(has(engine, 0, 3000));
  engine.stop();
}

TEST_F(EngineTest, APlotKeepsEveryPeak) {
  PlotTrace trace;
  sensor::Estimate<double> answer{};
  for (int k = 0; k < 100000; ++k) {
    answer.flow_m3_per_s = k == 99950 ? 9 : 1;
    trace.add(0.001 * k, 1e-3, 1, answer);
  }
  std::vector<PlotPoint> points;
  EXPECT_EQ(trace.copy_from(0, points), trace.size() - plot_points);
  float largest = 0;
  for (const PlotPoint& point : points) largest = std::max(largest, point.flow_max_m3_per_s);
  EXPECT_EQ(largest, 9);
  EXPECT_EQ(trace.size(), 5000U);
}

}  // namespace
}  // namespace spoolflow::live
