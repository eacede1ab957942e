/// What a store deletes and what it does not, whatever the system's clock shows.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/history/preparation.hpp"
#include "addons/live/history/store.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

using ::testing::ElementsAre;

constexpr std::int64_t second_ms = 1000, hour_ms = 3'600'000, day_ms = 24 * hour_ms;
constexpr std::int64_t first_row_ms = 1'700'000'000'000;

class RetentionTest : public InFolder {
 protected:
  void keep(Store& store, bool with_indicators = false) {
    ValveCommit valve;
    valve.state = {.valve = "a", .layout = "layout", .bytes = {std::byte{1}}};
    valve.since_last = {.samples = ++kept_, .time_s = 1};
    if (with_indicators) valve.indicators = {{"friction_ratio", 1, 0.1, 1, "good"}};
    std::vector<Event> none;
    store.commit(now_, {valve}, none);
  }
  /// A row a second.
  void work(Store& store, int seconds) {
    for (int k = 0; k < seconds; ++k) {
      pass(second_ms);
      keep(store, true);
    }
  }
  void pass(std::int64_t length_ms) {
    now_.wall_ms += length_ms;
    now_.steady_ms += length_ms;
  }
  /// Each row's samples are the number of its commit.
  [[nodiscard]] std::vector<std::int64_t> history() const {
    std::vector<std::int64_t> rows;
    read_history(path("s.sqlite"), "a", 0, std::int64_t{1} << 60,
                 [&](const HistoryRow& row) { rows.push_back(row.summary.samples); });
    return rows;
  }
  [[nodiscard]] std::int64_t count(const char* table) const {
    Database database(path("s.sqlite"), Database::Access::read);
    return database.number(std::string("SELECT count(*) FROM ") + table);
  }

  Instant now_{first_row_ms, 77 * hour_ms};
  std::int64_t kept_ = 0;
};

TEST_F(RetentionTest, AClockThatJumpsForwardBy45DaysDeletesNothing) {
  Store store(path("s.sqlite"));
  work(store, 100);
  (void)store.keep_recording({.wall_ms = now_.wall_ms, .valve = "a", .why = "alarm 1", .csv = "time_s\n1\n"});
  std::vector<Event> events{{.wall_ms = now_.wall_ms, .kind = "program", .text = "it works"}};
  store.commit(now_, {}, events);
  now_.wall_ms += 45 * day_ms;
  work(store, 10);
  store.retain({.days = 30, .largest_MB = 100});
  EXPECT_EQ(history().size(), 110U);
  EXPECT_EQ(count("indicator"), 110);
  EXPECT_EQ(count("recording"), 1);
  EXPECT_EQ(count("event"), 1);
}

TEST_F(RetentionTest, AClockThatIsSetBackOverwritesNothing) {
  for (const std::int64_t back_ms : {5 * second_ms, 60 * second_ms, hour_ms, std::int64_t{0}}) {
    Store store(path("s.sqlite"));  // its rows lie in the one table or the other
    work(store, 90);
    now_.wall_ms -= back_ms;
    work(store, 90);
    now_.wall_ms -= back_ms;
    store.retain({.days = 30, .largest_MB = 100});
    work(store, 30);
  }
  EXPECT_EQ(history().size(), 4 * 210U);
  EXPECT_EQ(count("indicator"), 4 * 210);
}

TEST_F(RetentionTest, RowsGoByTheTimeForWhichProgramsRan) {
  for (int day = 0; day < 10; ++day) {  // a program of its own each day, and the machine rests as long
    Store store(path("s.sqlite"));
    keep(store);
    pass(day_ms);
    keep(store);
    now_ = {now_.wall_ms + day_ms, 5000};
    store.retain({.days = 4.5, .largest_MB = 100});
  }
  EXPECT_THAT(history(), ElementsAre(12, 13, 14, 15, 16, 17, 18, 19, 20));
}

TEST_F(RetentionTest, RowsBehindAStepBackStayWhereOlderOnesOfTheSameTimeOfDayGo) {
  Store store(path("s.sqlite"));
  work(store, 100);
  now_.steady_ms += 40 * day_ms;
  now_.wall_ms -= 100 * second_ms;
  work(store, 100);
  store.retain({.days = 30, .largest_MB = 100});
  const std::vector<std::int64_t> left = history();
  EXPECT_EQ(left.size(), 100U);
  EXPECT_EQ(left.front(), 101);
  EXPECT_EQ(count("indicator"), 100);
}

TEST_F(RetentionTest, TheOldestGoWhereTheFileIsTooLargeAndTheNewestStay) {
  Store store(path("s.sqlite"));
  for (int k = 0; k < 8000; ++k) {
    pass(second_ms);
    keep(store);
  }
  store.retain({.days = 100, .largest_MB = 0.15});
  EXPECT_LT(history().size(), 5000U);
  EXPECT_GT(history().size(), 60U);
  EXPECT_EQ(history().back(), 8000);
  store.retain({.days = 100, .largest_MB = 1e-3});
  EXPECT_EQ(history().back(), 8000);
}

TEST_F(RetentionTest, BlocksThatWaitForAFleetTakeNoHistoryWithThem) {
  Store store(path("s.sqlite"));
  work(store, 200);
  ValveCommit valve;
  valve.state.valve = "a";
  valve.outbox_session = 1;
  for (std::uint64_t k = 1; k <= 300; ++k) valve.blocks.push_back({k, std::vector<std::uint8_t>(10'000)});
  std::vector<Event> none;
  store.commit(now_, {valve}, none);
  store.retain({.days = 30, .largest_MB = 1});
  EXPECT_EQ(history().size(), 200U);
}

TEST_F(RetentionTest, OnePassDeletesSoMuchAtMost) {
  constexpr std::int64_t rows = 700'000;
  {
    Store store(path("s.sqlite"));
    keep(store);
  }
  {
    Database database(path("s.sqlite"), Database::Access::write);
    database.run(
        "INSERT INTO second_of_valve WITH RECURSIVE k(at) AS (SELECT 1 UNION ALL SELECT at + 1 FROM k WHERE at < "
        "700000) SELECT 1, 1000 * at, at, 1, 0, 0, 0, 0, 0, 0, 0, 0 FROM k; "
        "INSERT INTO stretch VALUES(0, 1000, 700000000)");
  }
  Store store(path("s.sqlite"));
  keep(store);
  pass(40 * day_ms);
  keep(store);
  std::int64_t left = rows;
  for (int pass = 0; pass < 3; ++pass) {
    store.retain({.days = 30, .largest_MB = 1000});
    const std::int64_t now = count("second_of_valve WHERE run_ms = 0");
    EXPECT_LE(left - now, most_rows_a_pass + 700);
    EXPECT_GE(left - now, most_rows_a_pass);
    left = now;
  }
  store.retain({.days = 30, .largest_MB = 1000});
  EXPECT_EQ(count("second_of_valve WHERE run_ms = 0"), 0);
  EXPECT_EQ(history().back(), 3);
}

/// As programs of version 2 made it, with rows in both tables; the clock had been set back to where a row was.
constexpr const char* store_of_version_2 = R"(
CREATE TABLE valve(number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE);
CREATE TABLE second_of_valve(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, time_s REAL, samples INTEGER NOT NULL,
  flow_min REAL, flow_mean REAL, flow_max REAL, lower_min REAL, upper_max REAL, energy_J REAL, status INTEGER NOT NULL,
  PRIMARY KEY(valve, wall_ms)) WITHOUT ROWID;
CREATE TABLE newest_second(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, time_s REAL, samples INTEGER NOT NULL,
  flow_min REAL, flow_mean REAL, flow_max REAL, lower_min REAL, upper_max REAL, energy_J REAL, status INTEGER NOT NULL,
  PRIMARY KEY(wall_ms, valve)) WITHOUT ROWID;
CREATE VIEW second AS SELECT * FROM second_of_valve UNION ALL SELECT * FROM newest_second;
CREATE TABLE indicator(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, name TEXT NOT NULL, value REAL, uncertainty_95 REAL, baseline REAL,
  state TEXT NOT NULL, PRIMARY KEY(valve, wall_ms, name)) WITHOUT ROWID;
CREATE TABLE event(
  id INTEGER PRIMARY KEY AUTOINCREMENT, wall_ms INTEGER NOT NULL, valve TEXT NOT NULL, time_s REAL, kind TEXT NOT NULL,
  text TEXT NOT NULL, acknowledged_ms INTEGER NOT NULL DEFAULT 0);
CREATE TABLE recording(
  id INTEGER PRIMARY KEY AUTOINCREMENT, wall_ms INTEGER NOT NULL, valve TEXT NOT NULL, why TEXT NOT NULL,
  csv BLOB NOT NULL);
CREATE TABLE state(
  valve INTEGER PRIMARY KEY, session INTEGER NOT NULL, next INTEGER NOT NULL, samples INTEGER NOT NULL,
  energy_J REAL NOT NULL);
CREATE TABLE state_change(one INTEGER PRIMARY KEY CHECK(one = 1), of_valves BLOB NOT NULL);
CREATE TABLE older_state(valve INTEGER PRIMARY KEY, layout TEXT NOT NULL, bytes INTEGER NOT NULL, content BLOB NOT NULL);
CREATE TABLE alarm(
  id INTEGER PRIMARY KEY, valve TEXT NOT NULL, cause TEXT NOT NULL, sign TEXT NOT NULL, raised_ms INTEGER NOT NULL,
  gone_ms INTEGER NOT NULL, acknowledged_ms INTEGER NOT NULL, acknowledged_by TEXT NOT NULL, times INTEGER NOT NULL,
  time_s REAL, text TEXT NOT NULL, recording INTEGER NOT NULL);
INSERT INTO valve VALUES(1, 'a');
INSERT INTO second_of_valve VALUES(1, 1000, 1, 101, 0, 0, 0, 0, 0, 0, 0), (1, 2000, 2, 102, 0, 0, 0, 0, 0, 0, 0);
INSERT INTO newest_second VALUES(1, 2000, 3, 103, 0, 0, 0, 0, 0, 0, 0), (1, 3000, 4, 104, 0, 0, 0, 0, 0, 0, 0);
INSERT INTO indicator VALUES(1, 500, 'friction_ratio', 1, 0, 0, 'good');
INSERT INTO event VALUES(1, 1000, 'a', 1, 'program', 'it works', 0);
INSERT INTO recording VALUES(1, 1000, 'a', 'alarm 1', 'time_s');
INSERT INTO alarm VALUES(1, 'a', 'friction', 'M', 1000, 2000, 2000, 'anna', 1, 1, '', 1);
PRAGMA application_id=1397115991; PRAGMA user_version=2; PRAGMA journal_mode=WAL;
)";

TEST_F(RetentionTest, AStoreOfVersion2IsReadAsItIsAndGoesOnWithAllThatItHolds) {
  Database(path("s.sqlite"), Database::Access::write).run(store_of_version_2);
  EXPECT_EQ(history().size(), 4U);
  EXPECT_EQ(list_recordings(path("s.sqlite"), 10).size(), 1U);
  {
    Store store(path("s.sqlite"));
    EXPECT_THAT(history(), ElementsAre(101, 102, 103, 104));
    keep(store);  // in 2023; the rows are of 1970
    store.retain({.days = 30, .largest_MB = 100});
  }
  Store store(path("s.sqlite"));
  EXPECT_THAT(history(), ElementsAre(101, 102, 103, 104, 1));
  EXPECT_EQ(count("indicator"), 1);
  EXPECT_EQ(store.events(10).size(), 1U);
  EXPECT_EQ(store.alarms(10).size(), 1U);
  EXPECT_EQ(list_recordings(path("s.sqlite"), 10).size(), 1U);
  keep(store);
  pass(31 * day_ms);
  keep(store);
  store.retain({.days = 30, .largest_MB = 100});
  EXPECT_THAT(history(), ElementsAre(3));
  for (const char* const table : {"indicator", "event", "recording", "alarm"}) EXPECT_EQ(count(table), 0) << table;
}

}  // namespace
}  // namespace spoolflow::live
