#include "addons/live/valve/alarms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/history/store.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

using monitor::Fault;
using monitor::IndicatorState;
using monitor::Ne107;
using ::testing::HasSubstr;

ValveView healthy() {
  ValveView valve;
  valve.id = "v";
  valve.time_s = 10;
  valve.answer.flow_m3_per_s = 1e-4;
  return valve;
}

ValveView worn() {
  ValveView valve = healthy();
  valve.condition = Ne107::maintenance_required;
  valve.causes = {{Fault::friction, 120}};
  valve.indicators = {{"friction_ratio", 1.6, "1", 0.1, 1, IndicatorState::raised},
                      {"strokes", 40, "1", 0, 0, IndicatorState::counts}};
  return valve;
}

/// Raised after two seconds, gone after ten, looked at each second.
class AlarmList : public ::testing::Test {
 protected:
  std::vector<AlarmChange> look(const ValveView& valve, int times, bool stalled = false) {
    std::vector<AlarmChange> out;
    for (int k = 0; k < times; ++k) {
      now_ms += 1000;
      for (auto& change : alarms.follow(valve, troubles_of(valve, stalled), now_ms)) out.push_back(std::move(change));
    }
    return out;
  }
  [[nodiscard]] std::string state() const {
    const auto all = alarms.all();
    return all.empty() ? "none" : std::string(state_of(all.back()));
  }
  Alarms alarms{{.raised_after_s = 2, .gone_after_s = 10}};
  std::int64_t now_ms = 1'000'000'000'000;
};

TEST_F(AlarmList, WhatStandsLongEnoughIsRaisedWithWhatWasSeen) {
  EXPECT_TRUE(look(worn(), 2).empty());
  const auto raised = look(worn(), 5);
  ASSERT_EQ(raised.size(), 1U);
  const Alarm& alarm = raised[0].alarm;
  EXPECT_EQ(alarm.cause, "friction");
  EXPECT_EQ(alarm.sign, "M");
  EXPECT_EQ(alarm.time_s, 10);
  EXPECT_THAT(alarm.text, HasSubstr("odds 120 to 1; at 6 L/min"));
  ASSERT_EQ(alarm.indicators.size(), 1U);  // counters do not describe it
  EXPECT_EQ(alarm.indicators[0].value, 1.6);
  EXPECT_EQ(state(), "raised_unacknowledged");
}

TEST_F(AlarmList, WhatComesAndGoesAtOnceIsNotRaised) {
  for (int k = 0; k < 20; ++k) {
    EXPECT_TRUE(look(worn(), 2).empty());
    EXPECT_TRUE(look(healthy(), 1).empty());
  }
  EXPECT_EQ(state(), "none");
}

TEST_F(AlarmList, StaysUntilItIsGoneAndAcknowledged) {
  look(worn(), 3);
  EXPECT_TRUE(look(healthy(), 10).empty());
  look(worn(), 1);  // it is there again before it was gone
  EXPECT_TRUE(look(healthy(), 10).empty());
  EXPECT_EQ(state(), "raised_unacknowledged");
  const auto gone = look(healthy(), 1);
  ASSERT_EQ(gone.size(), 1U);
  EXPECT_EQ(gone[0].kind, AlarmChange::Kind::gone);
  look(healthy(), 1000);
  EXPECT_EQ(state(), "gone_unacknowledged");
  look(worn(), 3);
  EXPECT_EQ(alarms.all().size(), 1U);  // the same alarm once more
  EXPECT_EQ(alarms.all()[0].times, 2);
  EXPECT_EQ(state(), "raised_unacknowledged");
  ASSERT_TRUE(alarms.acknowledge(1, "anna", now_ms));
  EXPECT_EQ(state(), "raised_acknowledged");
  look(healthy(), 11);
  EXPECT_EQ(state(), "cleared");
  look(worn(), 3);
  EXPECT_EQ(alarms.all().size(), 2U);  // another alarm
  EXPECT_EQ(state(), "raised_unacknowledged");
}

TEST_F(AlarmList, AcknowledgedByTheFirstWhoDoes) {
  look(worn(), 3);
  EXPECT_FALSE(alarms.acknowledge(2, "anna", now_ms));
  EXPECT_EQ(alarms.acknowledge(1, "anna", now_ms)->acknowledged_by, "anna");
  EXPECT_EQ(alarms.acknowledge(1, "bert", now_ms + 5)->acknowledged_by, "anna");
}

TEST_F(AlarmList, WhatBecomesWorseIsToBeSeenAgain) {
  ValveView valve = worn();
  valve.causes = {{Fault::coil, 50}};
  look(valve, 3);
  (void)alarms.acknowledge(1, "anna", now_ms);
  valve.causes = {{Fault::coil, 1e6}};
  valve.condition = Ne107::failure;
  const auto worse = look(valve, 1);
  ASSERT_EQ(worse.size(), 1U);
  EXPECT_EQ(worse[0].kind, AlarmChange::Kind::worse);
  EXPECT_EQ(alarms.all()[0].sign, "F");
  EXPECT_EQ(state(), "raised_unacknowledged");
}

TEST_F(AlarmList, AClockThatIsSetBackHoldsNothingUp) {
  look(worn(), 1);
  now_ms -= 3'600'000;
  EXPECT_EQ(look(worn(), 3).size(), 1U);
  look(healthy(), 1);
  now_ms -= 3'600'000;
  EXPECT_EQ(look(healthy(), 11).size(), 1U);
}

TEST(Troubles, AreWhatIsDecidedAndNotWhatIsSuspected) {
  EXPECT_TRUE(troubles_of(healthy(), false).empty());
  ValveView suspected = healthy();
  suspected.causes = {{Fault::spring, 20}};
  EXPECT_TRUE(troubles_of(suspected, false).empty());
  suspected.condition = Ne107::out_of_specification;  // by its status
  const auto specification = troubles_of(suspected, false);
  ASSERT_EQ(specification.size(), 1U);
  EXPECT_EQ(specification[0].cause, "out_of_specification");
  // The charts have decided, and no indicator alone stands out.
  ValveView decided = healthy();
  decided.causes = {{Fault::friction, 0.8}};
  decided.condition = Ne107::maintenance_required;
  EXPECT_EQ(troubles_of(decided, false)[0].cause, "maintenance_required");
  decided.doubted = true;
  ASSERT_EQ(troubles_of(decided, false).size(), 1U);
  EXPECT_EQ(troubles_of(decided, false)[0].cause, "friction");
  const auto both = troubles_of(worn(), true);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].cause, "no_samples");
  EXPECT_EQ(both[0].sign, Ne107::function_check);
  EXPECT_EQ(both[1].cause, "friction");
}

class KeptAlarms : public InFolder {};

TEST_F(KeptAlarms, SurviveAnEndInEveryState) {
  const AlarmDelays at_once{0, 0};
  const auto kept_and_restored = [&](Alarms& alarms) {
    {
      Store store(path("s.sqlite"));
      std::vector<Event> none;
      store.commit({1000, 1000}, {}, none, alarms.take_changed());
    }
    Store store(path("s.sqlite"));
    Alarms again(at_once);
    again.restore(store.alarms(Alarms::most_cleared));
    EXPECT_EQ(again.all().size(), alarms.all().size());
    EXPECT_EQ(state_of(again.all().back()), state_of(alarms.all().back()));
    return again.all().back();
  };
  Alarms alarms(at_once);
  (void)alarms.follow(worn(), troubles_of(worn(), false), 5000);
  const Alarm raised = kept_and_restored(alarms);
  EXPECT_EQ(raised.raised_ms, 5000);
  ASSERT_EQ(raised.indicators.size(), 1U);
  EXPECT_EQ(raised.indicators[0].name, "friction_ratio");
  EXPECT_EQ(raised.indicators[0].unit, "1");
  alarms.name_recording(1, 7);
  (void)alarms.acknowledge(1, "anna", 6000);
  const Alarm acknowledged = kept_and_restored(alarms);
  EXPECT_EQ(acknowledged.acknowledged_by, "anna");
  EXPECT_EQ(acknowledged.recording, 7);
  (void)alarms.follow(healthy(), {}, 7000);
  EXPECT_EQ(kept_and_restored(alarms).gone_ms, 7000);
  EXPECT_TRUE(alarms.take_changed().empty());
  alarms.give_back(alarms.all());
  EXPECT_EQ(alarms.take_changed().size(), 1U);
}

TEST_F(KeptAlarms, OfLongAgoAreForgottenOnceTheyAreCleared) {
  Store store(path("s.sqlite"));
  std::vector<Event> none;
  Alarm open, cleared;
  open.id = 1;
  open.raised_ms = 1000;
  cleared.id = 2;
  cleared.raised_ms = cleared.gone_ms = cleared.acknowledged_ms = 1000;
  constexpr std::int64_t day_ms = 86'400'000;
  store.commit({1000, 1000}, {}, none, {open, cleared});
  store.commit({100 * day_ms, 2000}, {}, none);
  store.retain({.days = 30, .largest_MB = 100});
  EXPECT_EQ(store.alarms(10).size(), 2U);  // the system's clock alone was set forward
  store.commit({100 * day_ms, 100 * day_ms}, {}, none);
  store.retain({.days = 30, .largest_MB = 100});
  ASSERT_EQ(store.alarms(10).size(), 1U);
  EXPECT_EQ(store.alarms(10)[0].id, 1);
}

}  // namespace
}  // namespace spoolflow::live
