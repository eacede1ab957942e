/// What speaks against a sender's first samples, and what is counted while a fault stands.
#include "addons/live/first_samples.hpp"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/sources/csv_stream.hpp"
#include "addons/live/tests/engine_site.hpp"
#include "addons/live/valve/valve_at_work.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"

namespace spoolflow::live {
namespace {

using estimation::TimedSample;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A minute of valve A at work, and its model.
struct Minute {
  SharedModel model{std::make_shared<const model::Model>(model::read_model(SPOOLFLOW_EXAMPLE_MODEL)), "sha"};
  std::vector<TimedSample> samples;

  Minute() {
    const auto reader = estimation::open_sensor_channels(SPOOLFLOW_EXAMPLES "/valve_a/duty_cycle_1.h5",
                                                         estimation::sensor_channels(*model.model, {}));
    recording::SampleBlock block;
    while (reader->next(block)) {
      const std::vector<TimedSample> more = samples_of(block);
      samples.insert(samples.end(), more.begin(), more.end());
    }
  }
};

const Minute& minute() {
  static const Minute read;
  return read;
}

class FirstSamplesTest : public ::testing::Test {
 protected:
  FirstSamplesTest() {
    for (const char* id : {"sound", "wrong", "mirror"}) site.valves.push_back({id, minute().model, UdpSettings{}});
    site.valves[2].source = RigSettings{};
    checks.emplace(site);
  }
  /// The samples as they come when somebody made a mistake.
  void send(
      std::size_t valve, const std::function<void(TimedSample&)>& mistake = [](TimedSample&) {}) {
    ++connections;
    SampleBlock block{.counted = {.connections = connections}};
    for (const TimedSample& one : minute().samples) {
      block.samples.push_back(one);
      mistake(block.samples.back());
      if (block.samples.size() < 20) continue;
      checks->take(valve, block);
      block.samples.clear();
    }
  }
  [[nodiscard]] std::string found(std::size_t valve) const {
    comes_true([&] { return !checks->findings(valve).empty(); });
    const auto all = checks->findings(valve);
    return all.empty() ? "nothing" : all.back();
  }
  SiteSettings site;
  std::optional<FirstSamples> checks;
  std::uint64_t connections = 0;
};

TEST_F(FirstSamplesTest, SpeakAgainstUnitsThatNoValveHasAndForSoundOnes) {
  send(0);
  send(2, [](TimedSample& one) { one.position_m *= 1e3; });  // of no sender: not looked at
  send(1, [](TimedSample& one) { one.position_m *= 1e3; });
  EXPECT_THAT(found(1), AllOf(HasSubstr("position"), HasSubstr("is its unit mm")));
  // One after the other: the sound one was judged before.
  EXPECT_THAT(checks->findings(0), IsEmpty());
  EXPECT_THAT(checks->findings(2), IsEmpty());
  send(1, [](TimedSample& one) { one.current_A *= 1e3; });
  EXPECT_THAT(found(1), AllOf(HasSubstr("current"), HasSubstr("is its unit mA")));
}

TEST_F(FirstSamplesTest, SpeakAgainstWhatOnlyForcesShow) {
  send(1, [](TimedSample& one) { one.position_m *= 0.5; });
  EXPECT_THAT(found(1), HasSubstr("position looks halved"));
  send(1, [](TimedSample& one) { one.current_A *= 0.1; });
  EXPECT_THAT(found(1), HasSubstr("current looks ten times too small"));
}

TEST_F(FirstSamplesTest, SayNothingOfASpoolAtRestAndForgetTheSenderOfBefore) {
  send(1, [](TimedSample& one) { one.position_m *= 1e3; });
  EXPECT_THAT(found(1), HasSubstr("mm"));
  int k = 0;
  send(1, [&](TimedSample& one) {
    one.position_m = 1e-6 * (++k * 7919 % 5);
    one.current_A = 0.01 + 1e-4 * (k * 7907 % 5);
    one.voltage_V = 0.05;
  });
  send(0, [](TimedSample& one) { one.position_m *= 1e3; });
  EXPECT_THAT(found(0), HasSubstr("mm"));
  EXPECT_THAT(checks->findings(1), IsEmpty());
}

class WrongUnits : public EngineTest {};

TEST_F(WrongUnits, OfAConnectionAreAskedForInItsOwnTerms) {
  Engine engine(site({{"t", TcpSettings{{"127.0.0.1", 0}}}}), "test");
  engine.start();
  const Sender sender(engine.source(0).port);
  std::string text = "time_s,current_A,position_mm\n";  // micrometres
  for (int k = 0; k < 8000; ++k) text += fmt::format("{:.3f},1.0,{}\n", 0.001 * k, 1000 + k % 500);
  sender.send(text);
  ASSERT_TRUE(comes_true([&] { return !engine.source(0).findings.empty(); }));
  EXPECT_THAT(engine.source(0).findings[0], AllOf(HasSubstr("position is 1.499 m, beyond"),
                                                  HasSubstr("in the unit that the header or channel map states?")));
}

double counted(const ValveView& view, std::string_view name) {
  for (const monitor::Indicator& one : view.indicators) {
    if (one.name == name) return one.value;
  }
  return NAN;
}

TEST(Counters, StopWhileAFaultStandsAndGoOnBehindIt) {
  const std::vector<std::function<void(TimedSample&)>> faults{
      [](TimedSample& one) { one.position_m = estimation::not_measured; },
      [](TimedSample& one) { one.current_A = 1000; }};
  for (const auto& fault : faults) {
    ValveAtWork valve("v", minute().model, "test");
    const auto work = [&](std::size_t from, std::size_t to, bool faulty) {
      SampleBlock block;
      for (std::size_t k = from; k < to; ++k) {
        block.samples.push_back(minute().samples[k]);
        if (faulty) fault(block.samples.back());
      }
      valve.work(block);
      return valve.view();
    };
    (void)work(0, 10'000, false);
    const ValveView begun = work(10'000, 11'000, true);  // the fault is reported within it
    EXPECT_TRUE(sensor::has(begun.answer.status, monitor::uncounted));
    const ValveView later = work(11'000, 25'000, true);
    EXPECT_TRUE(sensor::has(later.answer.status, monitor::uncounted));
    EXPECT_GT(begun.energy_J, 0);
    EXPECT_EQ(later.energy_J, begun.energy_J);
    for (const char* name : {"watched_time", "strokes", "distance", "oil_volume", "hydraulic_energy"}) {
      EXPECT_GT(counted(begun, name), 0) << name;
      EXPECT_EQ(counted(later, name), counted(begun, name)) << name;
    }
    (void)work(25'000, 30'000, false);
    const ValveView after = work(30'000, 45'000, false);
    EXPECT_GT(after.energy_J, later.energy_J);
    EXPECT_GT(counted(after, "distance"), counted(later, "distance"));
  }
}

class Strangers : public EngineTest {};

TEST_F(Strangers, AreListedWithTheirSender) {
  Engine engine(site({{"u", UdpSettings{}}}), "test");
  engine.start();
  const auto send = [&](const std::string& id) {
    const std::vector<TimedSample> one(1, {0, 1.5, 4.8, 1e-3, 323.15});
    send_bytes(engine, write_datagram({id, 7, 0, 0, 1'000'000, 0x000F}, one));
  };
  send("press_9");
  send("press_9");
  send("pr\x01ss");
  ASSERT_TRUE(comes_true([&] { return engine.udp_counters().unknown_valve == 3; }));
  const auto seen = engine.unknown_senders();
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].valve, "press_9");
  EXPECT_EQ(seen[0].sender, "127.0.0.1");
  EXPECT_EQ(seen[0].pieces, 2U);
  EXPECT_LE(seen[0].first_ms, seen[0].last_ms);
  EXPECT_EQ(seen[1].valve, "pr?ss");
  for (std::size_t k = 0; k < UnknownSenders::most; ++k) send("x" + std::to_string(k));
  ASSERT_TRUE(comes_true([&] { return engine.udp_counters().unknown_valve == 3 + UnknownSenders::most; }));
  EXPECT_EQ(engine.unknown_senders().size(), UnknownSenders::most);
  EXPECT_EQ(engine.unknown_senders().back().valve, "x31");
}

}  // namespace
}  // namespace spoolflow::live
