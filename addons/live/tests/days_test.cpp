/// Hours and days of a valve: what the store gives of them, and how they are asked for.
#include <atomic>
#include <cmath>
#include <sqlite3.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "addons/live/demo_model.hpp"
#include "addons/live/engine.hpp"
#include "addons/live/history/long_history.hpp"
#include "addons/live/history/store.hpp"
#include "addons/live/http/target.hpp"
#include "addons/live/page/answer.hpp"
#include "addons/live/page/plotjuggler.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

constexpr std::int64_t minute_ms = 60'000, begin_ms = 1'700'000'000'000;

class Days : public InFolder {
 protected:
  /// A day of a valve whose friction grows, a row a minute; it is raised in the last hour.
  void keep_a_day() const {
    Store store(path("s.sqlite"));
    std::vector<Event> none;
    for (int minute = 0; minute < 1440; ++minute) {
      ValveCommit valve;
      valve.state = {"a", 7, 1000, 1000, 5, "layout", {std::byte{1}, std::byte{2}}};
      valve.since_last = {.samples = 1000,
                          .time_s = 60.0 * minute,
                          .flow_min_m3_per_s = 0,
                          .flow_mean_m3_per_s = 1e-3,
                          .flow_max_m3_per_s = minute == 700 ? 9e-3 : 2e-3,
                          .lower_min_m3_per_s = -1e-4,
                          .upper_max_m3_per_s = 3e-3,
                          .energy_J = 5,
                          .status = 0};
      valve.indicators = {{"friction_ratio", 1 + minute / 1440.0, 0.1, 1, minute < 1380 ? "good" : "raised"},
                          {"edge_rounding", NAN, NAN, 0, "unknown"}};
      store.commit({begin_ms + minute * minute_ms, minute * minute_ms}, {valve}, none);
    }
  }
};

/// Counts the steps of SQLite's machine in statements of connections that are opened while it lives.
class CountedSteps {
 public:
  CountedSteps() { sqlite3_auto_extension(entry()); }
  ~CountedSteps() { sqlite3_cancel_auto_extension(entry()); }
  CountedSteps(const CountedSteps&) = delete;
  CountedSteps& operator=(const CountedSteps&) = delete;

  template <class Work>
  [[nodiscard]] std::uint64_t of(Work&& work) const {
    steps = 0;
    work();
    return steps;
  }

 private:
  static void (*entry())() { return reinterpret_cast<void (*)()>(&opened); }
  static int opened(sqlite3* connection, char** /*error*/, const void* /*api*/) {
    return sqlite3_trace_v2(connection, SQLITE_TRACE_PROFILE, &ended, nullptr);
  }
  static int ended(unsigned /*kind*/, void* /*context*/, void* statement, void* /*time*/) {
    steps += static_cast<std::uint64_t>(
        sqlite3_stmt_status(static_cast<sqlite3_stmt*>(statement), SQLITE_STMTSTATUS_VM_STEP, 1));
    return 0;
  }
  inline static std::atomic<std::uint64_t> steps = 0;
};

TEST_F(Days, AreThinnedWithoutLosingPeaks) {
  keep_a_day();
  const Span day{begin_ms, begin_ms + 1440 * minute_ms, 100};
  IndicatorHistories indicators = read_indicators(path("s.sqlite"), "a", day);
  const std::vector<IndicatorPoint>& friction = indicators["friction_ratio"];
  ASSERT_GE(friction.size(), 100U);
  ASSERT_LE(friction.size(), 102U);
  EXPECT_EQ(friction.front().smallest, 1);
  EXPECT_LT(friction.front().value, friction.front().largest);
  EXPECT_NEAR(friction.back().largest, 1 + 1439 / 1440.0, 1e-9);
  EXPECT_FALSE(friction[50].raised);
  EXPECT_TRUE(friction.back().raised);
  for (std::size_t k = 1; k < friction.size(); ++k) EXPECT_GT(friction[k].wall_ms, friction[k - 1].wall_ms);
  EXPECT_TRUE(std::isnan(indicators["edge_rounding"].front().value));
  const auto flow = read_flow(path("s.sqlite"), "a", day);
  double largest = 0;
  for (const FlowPoint& point : flow) largest = std::max(largest, point.largest_m3_per_s);
  EXPECT_EQ(largest, 9e-3);
  EXPECT_EQ(flow.front().power_W, 5);
  EXPECT_TRUE(read_flow(path("s.sqlite"), "b", day).empty());
  EXPECT_TRUE(read_indicators(path("s.sqlite"), "b", day).empty());
  const Span hour{begin_ms, begin_ms + 60 * minute_ms, 1000};
  EXPECT_EQ(read_indicators(path("s.sqlite"), "a", hour)["friction_ratio"].size(), 60U);  // never more than there are
}

TEST_F(Days, HavePowerOverTheTimeOfTheSamplesHoweverFastTheyCame) {
  Store store(path("s.sqlite"));
  std::vector<Event> none;
  double time_s = 0;
  for (int row = 0; row < 60; ++row) {  // 2 kW; from the middle on eight seconds a row, as after a disk was full
    const double lasts_s = row < 30 ? 1 : 8;
    time_s += lasts_s;
    ValveCommit valve;
    valve.state = {"a", 7, 1000, 1000, 5, "layout", {std::byte{1}}};
    valve.since_last = {.samples = static_cast<std::int64_t>(1000 * lasts_s),
                        .time_s = time_s,
                        .flow_min_m3_per_s = 1e-3,
                        .flow_mean_m3_per_s = 1e-3,
                        .flow_max_m3_per_s = 1e-3,
                        .lower_min_m3_per_s = 1e-3,
                        .upper_max_m3_per_s = 1e-3,
                        .energy_J = 2000 * lasts_s,
                        .status = 0};
    store.commit({begin_ms + row * 1000, row * 1000}, {valve}, none);
  }
  for (const FlowPoint& point : read_flow(path("s.sqlite"), "a", {begin_ms, begin_ms + minute_ms, 10}))
    EXPECT_NEAR(point.power_W, 2000, 1e-9) << point.wall_ms;
}

TEST_F(Days, AMinuteIsReadWithoutTheDaysAroundIt) {
  keep_a_day();
  Database(path("s.sqlite"), Database::Access::write)
      .run(
          "WITH RECURSIVE row(k) AS (SELECT 1 UNION ALL SELECT k + 1 FROM row WHERE k < 200000) "
          "INSERT INTO second_of_valve(valve, wall_ms, samples, flow_mean, status) SELECT 1 + k % 2, 1000 * k, 1, "
          "1e-3, 0 "
          "FROM row");
  const std::uint64_t all_days = CountedSteps().of([&] {
    EXPECT_GT(read_flow(path("s.sqlite"), "a", {0, begin_ms}).size(), 0U);
  });
  const std::uint64_t minute = CountedSteps().of([&] {
    EXPECT_EQ(read_flow(path("s.sqlite"), "a", {1000, 61'000}).size(), 30U);
  });
  EXPECT_GT(minute, 30U);
  EXPECT_LT(1000 * minute, all_days);
}

TEST_F(Days, AreAskedForByInstants) {
  keep_a_day();
  const EmbeddedFile& file = demo_model().front();
  SiteSettings site;
  site.valves.push_back(
      {"a",
       {std::make_shared<const model::Model>(model::parse_model(std::string(file.bytes), std::string(file.name))), "s"},
       UdpSettings{}});
  site.udp = Address{"127.0.0.1", 0};
  site.store = path("s.sqlite");
  const Engine engine(site, "test");
  const PageAnswer asked = answer_to(engine, "GET", "/api/v1/valves/a/indicators?from=1700000000&to=2023-11-15T00:00Z");
  ASSERT_EQ(asked.status, 200U);
  const auto answer = nlohmann::json::parse(asked.body);
  ASSERT_FALSE(answer["indicators"].empty());
  EXPECT_EQ(answer["indicators"][0]["name"], "friction_ratio");
  EXPECT_EQ(answer["indicators"][0]["value"].size(), answer["indicators"][0]["time_ms"].size());
  EXPECT_TRUE(answer["indicators"][1]["value"][0].is_null());
  const auto flow =
      nlohmann::json::parse(answer_to(engine, "GET", "/api/v1/valves/a/history?from=1.7e9&to=1.71e9").body);
  EXPECT_EQ(flow["flow_mean_L_min"][0], 60);
  const auto whole = read_flow(path("s.sqlite"), "a", {begin_ms, begin_ms + 1440 * minute_ms});
  const auto pieces =
      nlohmann::json::parse(answer_to(engine, "GET", "/api/v1/valves/a/history?from=1700000000&to=1700086400").body);
  ASSERT_EQ(pieces["time_ms"].size(), whole.size());
  for (std::size_t k = 0; k < whole.size(); ++k) EXPECT_EQ(pieces["time_ms"][k], whole[k].wall_ms);
  EXPECT_EQ(answer_to(engine, "GET", "/api/v1/valves/b/indicators").status, 404U);
  std::stop_source ends;
  ends.request_stop();
  EXPECT_EQ(answer_to(engine, "GET", "/api/v1/valves/a/history?from=0&to=1.71e9", ends.get_token()).status, 503U);
  EXPECT_EQ(answer_to(engine, "GET", "/api/v1/valves/a/indicators").status, 200U);
  for (const char* wrong : {"from=yesterday", "from=2&to=1", "to=nan", "from=1e300", "from=", "from=2023-02-30"}) {
    EXPECT_EQ(answer_to(engine, "GET", std::string("/api/v1/valves/a/history?") + wrong).status, 400U) << wrong;
  }
}

TEST(Target, IsReadAsItWasWritten) {
  EXPECT_EQ(valve_asked("/api/v1/valves/press.1/indicators", "indicators"), "press.1");
  for (const char* none : {"/api/v1/valves/indicators", "/api/v1/valves//indicators", "/api/v1/valves/aindicators"}) {
    EXPECT_FALSE(valve_asked(none, "indicators")) << none;
  }
  EXPECT_EQ(query_value("/x?a=1&b=2%3A3", "b"), "2:3");
  EXPECT_EQ(query_value("/x?a=100%", "a"), "100%");
  EXPECT_FALSE(query_value("/x?ab=1", "b"));
  EXPECT_FALSE(query_value("/x", "a"));
  EXPECT_EQ(instant_ms("1970-01-02"), 86'400'000);
  EXPECT_EQ(instant_ms("2023-11-14T22:13:20Z"), begin_ms);
  EXPECT_EQ(instant_ms("2023-11-14T22:13:20.5"), begin_ms + 500);
  EXPECT_EQ(instant_ms("1700000000.25"), begin_ms + 250);
  for (const char* none : {"", "x", "2023-13-01", "2023-11-14T", "2023-11-14T22", "2023-11-14T22:13x", "inf"}) {
    EXPECT_FALSE(instant_ms(none)) << none;
  }
}

TEST(PlotJugglerMessage, LeavesOutWhatIsNotKnown) {
  const PlotPoint point{.time_s = 2.5,
                        .flow_min_m3_per_s = 1e-3F,
                        .flow_max_m3_per_s = 2e-3F,
                        .lower_min_m3_per_s = 0,
                        .upper_max_m3_per_s = 3e-3F,
                        .position_m = NAN,
                        .current_A = 1.5F,
                        .status = 6};
  const auto read = nlohmann::json::parse(plotjuggler_message("v", point, monitor::Ne107::function_check, 1.7e9));
  EXPECT_EQ(read["timestamp"], 1.7e9);
  EXPECT_NEAR(read["v"]["flow_max_L_min"].get<double>(), 120, 1e-3);
  EXPECT_FALSE(read["v"].contains("position_mm"));
  EXPECT_EQ(read["v"]["status"], 6);
  EXPECT_EQ(read["v"]["ne107"], 3);
}

}  // namespace
}  // namespace spoolflow::live
