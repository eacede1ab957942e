/// Shelving and comments of alarms, and what of them is news for those who get messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/history/store.hpp"
#include "addons/live/notify/alarm_news.hpp"
#include "addons/live/tests/temporary_folder.hpp"
#include "addons/live/valve/alarms.hpp"

namespace spoolflow::live {
namespace {

using monitor::Ne107;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr std::int64_t whole_hour_ms = 3'600'000;

/// An alarm list without delays, of one valve whose source stalls or not.
class Shelf : public InFolder {
 protected:
  std::vector<AlarmChange> look(bool stalled, std::int64_t later_ms = 1000) {
    now_ms += later_ms;
    ValveView valve;
    valve.id = "press_1";
    return alarms.follow(valve, troubles_of(valve, stalled), now_ms);
  }
  [[nodiscard]] std::string_view state() const { return state_of(alarms.all().back()); }
  Alarms alarms{{.raised_after_s = 0, .gone_after_s = 0}};
  std::int64_t now_ms = 1'000'000'000'000;
};

TEST_F(Shelf, GivesAnAlarmBackAfterItsTimeUnacknowledgedWhereItStillStands) {
  (void)look(true);
  (void)alarms.acknowledge(1, "anna", now_ms);
  ASSERT_TRUE(alarms.shelve(1, "anna", now_ms + whole_hour_ms, now_ms));
  EXPECT_EQ(state(), "shelved");
  EXPECT_THAT(look(true, whole_hour_ms - 1), IsEmpty());
  const auto back = look(true, 1);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].kind, AlarmChange::Kind::back);
  EXPECT_EQ(state(), "raised_unacknowledged");
  EXPECT_TRUE(alarms.all()[0].shelved_by.empty());
}

TEST_F(Shelf, HoldsAnAlarmThatComesAndGoes) {
  (void)look(true);
  (void)alarms.shelve(1, "anna", now_ms + whole_hour_ms, now_ms);
  (void)alarms.acknowledge(1, "anna", now_ms);
  for (int k = 0; k < 5; ++k) {
    (void)look(false);
    (void)look(true);
  }
  (void)look(false);
  EXPECT_EQ(alarms.all().size(), 1U);  // the next of its kind is no other alarm
  EXPECT_EQ(alarms.all()[0].times, 6);
  (void)look(false, whole_hour_ms);
  EXPECT_EQ(state(), "cleared");
  EXPECT_EQ(alarms.shelve(1, "anna", now_ms + whole_hour_ms, now_ms)->shelved_until_ms, 0);
}

TEST_F(Shelf, IsNotMadeLongerByAClockThatIsSetBack) {
  (void)look(true);
  (void)alarms.shelve(1, "anna", now_ms + whole_hour_ms, now_ms);
  (void)look(true, -24 * whole_hour_ms);
  (void)look(true, whole_hour_ms);
  EXPECT_EQ(state(), "raised_unacknowledged");
}

TEST_F(Shelf, AndCommentsAreKept) {
  (void)look(true);
  (void)alarms.shelve(1, "anna", now_ms + whole_hour_ms, now_ms);
  (void)alarms.comment(1, {now_ms, "anna", "filter is ordered"});
  (void)alarms.comment(1, {now_ms + 5, "bert", "came today"});
  Store store(path("s.sqlite"));
  std::vector<Event> none;
  store.commit({1000, 1000}, {}, none, alarms.take_changed());
  Alarms again{{.raised_after_s = 0, .gone_after_s = 0}};
  again.restore(store.alarms(Alarms::most_cleared));
  const Alarm kept = again.all().at(0);
  EXPECT_EQ(state_of(kept), "shelved");
  EXPECT_EQ(kept.shelved_until_ms, now_ms + whole_hour_ms);
  ASSERT_EQ(kept.comments.size(), 2U);
  EXPECT_EQ(kept.comments[1].by, "bert");
  EXPECT_EQ(kept.comments[1].at_ms, now_ms + 5);
  EXPECT_EQ(kept.comments[0].text, "filter is ordered");
  ASSERT_TRUE(again.unshelve(1));
  store.commit({2000, 2000}, {}, none, again.take_changed());
  EXPECT_EQ(state_of(store.alarms(10).at(0)), "raised_unacknowledged");
}

TEST_F(Shelf, KeepsTheNewestComments) {
  (void)look(true);
  for (std::size_t k = 0; k <= Alarms::most_comments; ++k) (void)alarms.comment(1, {now_ms, "anna", std::to_string(k)});
  EXPECT_EQ(alarms.all()[0].comments.size(), Alarms::most_comments);
  EXPECT_EQ(alarms.all()[0].comments.front().text, "1");
}

class News : public Shelf {
 protected:
  [[nodiscard]] std::vector<std::string> seen() {
    (void)gathered.look(alarms.all());
    std::vector<std::string> out;
    for (const AlarmNews& one : gathered.news()) out.emplace_back(name(one.kind));
    return out;
  }
  GatheredNews gathered{{}, Ne107::maintenance_required};
};

TEST_F(News, AreOneAnAlarmHoweverOftenItComesAndGoes) {
  (void)look(true);
  EXPECT_THAT(seen(), ElementsAre("raised"));
  EXPECT_THAT(seen(), ElementsAre("raised"));
  (void)look(false);
  EXPECT_THAT(seen(), ElementsAre("raised and gone"));
  gathered.clear();
  EXPECT_THAT(seen(), IsEmpty());
  (void)look(true);
  EXPECT_THAT(seen(), ElementsAre("raised again"));
  gathered.clear();
  (void)look(false);
  EXPECT_THAT(seen(), ElementsAre("gone"));
}

TEST_F(News, AreNoneOfAShelvedAlarmUntilItComesBack) {
  (void)look(true);
  EXPECT_EQ(seen().size(), 1U);
  (void)alarms.shelve(1, "anna", now_ms + whole_hour_ms, now_ms);
  EXPECT_THAT(seen(), IsEmpty());  // what waited is not sent either
  (void)look(false);
  (void)look(true);
  EXPECT_THAT(seen(), IsEmpty());
  (void)look(true, whole_hour_ms);
  EXPECT_THAT(seen(), ElementsAre("back from the shelf"));
}

TEST_F(News, AreNoneOfLessThanAskedFor) {
  GatheredNews failures({}, Ne107::failure);
  (void)look(true);  // function check
  (void)failures.look(alarms.all());
  EXPECT_THAT(failures.news(), IsEmpty());
  std::vector<Alarm> worse = alarms.all();
  worse[0].sign = "F";
  (void)failures.look(worse);
  ASSERT_EQ(failures.news().size(), 1U);
  EXPECT_EQ(failures.news()[0].kind, AlarmNews::Kind::raised);
}

TEST_F(News, GoOnWhereTheyWereWritten) {
  (void)look(true);
  GatheredNews next(gathered.written(), alarms.all(), Ne107::maintenance_required);
  EXPECT_EQ(next.look(alarms.all()), 0U);
  ASSERT_EQ(next.news().size(), 1U);
  EXPECT_EQ(next.news()[0].kind, AlarmNews::Kind::raised);
  next.clear();
  GatheredNews reported(next.written(), alarms.all(), Ne107::maintenance_required);
  (void)reported.look(alarms.all());
  EXPECT_THAT(reported.news(), IsEmpty());
  (void)look(false);
  (void)reported.look(alarms.all());  // what happened while nobody looked is news
  ASSERT_EQ(reported.news().size(), 1U);
  EXPECT_EQ(reported.news()[0].kind, AlarmNews::Kind::gone);
  EXPECT_THAT(GatheredNews("rubbish", alarms.all(), Ne107::maintenance_required).news(), IsEmpty());
}

TEST_F(News, AreBounded) {
  std::vector<Alarm> many(GatheredNews::most + 7);
  for (std::size_t k = 0; k < many.size(); ++k) {
    many[k].id = static_cast<std::int64_t>(k) + 1;
    many[k].valve = "v";
    many[k].cause = "no_samples";
    many[k].sign = "C";
  }
  EXPECT_EQ(gathered.look(many), 7U);
  EXPECT_EQ(gathered.news().size(), GatheredNews::most);
  EXPECT_THAT(text_of(gathered, "hall"), HasSubstr("7 earlier ones are left out here"));
  EXPECT_THAT(subject_of(gathered, "hall"),
              StartsWith("spoolflow hall: 200 alarms raised: no samples at v (function check), "));
  gathered.clear();
  EXPECT_EQ(gathered.look(many), 0U);  // they are known
}

}  // namespace
}  // namespace spoolflow::live
