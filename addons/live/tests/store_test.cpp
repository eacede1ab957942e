#include "addons/live/history/store.hpp"

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sys/resource.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

using ::testing::HasSubstr;

class StoreTest : public InFolder {
 protected:
  static ValveCommit kept(const std::string& valve, std::uint64_t next, double flow_m3_per_s) {
    ValveCommit out;
    out.state = {valve, 7, next, next, 12.5, "layout", {std::byte{1}, std::byte{2}, std::byte{3}}};
    out.since_last = {.samples = 1000,
                      .time_s = 3.5,
                      .flow_min_m3_per_s = 0.5 * flow_m3_per_s,
                      .flow_mean_m3_per_s = flow_m3_per_s,
                      .flow_max_m3_per_s = 2 * flow_m3_per_s,
                      .lower_min_m3_per_s = 0.25 * flow_m3_per_s,
                      .upper_max_m3_per_s = 3 * flow_m3_per_s,
                      .energy_J = 5,
                      .status = 3};
    return out;
  }
  void commit(Store& store, std::int64_t wall_ms, const std::vector<ValveCommit>& valves) {
    std::vector<Event> none;
    store.commit({.wall_ms = wall_ms, .steady_ms = wall_ms}, valves, none);
  }
  [[nodiscard]] std::vector<HistoryRow> history(const std::string& valve, std::int64_t from = 0,
                                                std::int64_t to = std::int64_t{1} << 60) const {
    std::vector<HistoryRow> rows;
    read_history(path("s.sqlite"), valve, from, to, [&](const HistoryRow& row) { rows.push_back(row); });
    return rows;
  }
};

TEST_F(StoreTest, GivesBackWhatItWasGiven) {
  {
    Store store(path("s.sqlite"));
    std::vector<Event> events{{.wall_ms = 1000, .valve = "a", .time_s = 3, .kind = "condition", .text = "NE 107 M"}};
    store.commit({1000, 1000}, {kept("a", 1000, 1e-4), kept("b", 500, 2e-4)}, events);
    EXPECT_EQ(events[0].id, 1);
    commit(store, 2000, {kept("a", 2000, 3e-4)});
  }
  Store again(path("s.sqlite"));
  const auto states = again.states();
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0].valve, "a");
  EXPECT_EQ(states[0].next, 2000U);
  EXPECT_EQ(states[0].bytes, (std::vector{std::byte{1}, std::byte{2}, std::byte{3}}));
  ASSERT_EQ(again.events(10).size(), 1U);
  EXPECT_EQ(again.events(10)[0].text, "NE 107 M");
  const auto rows = history("a");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].wall_ms, 2000);
  EXPECT_DOUBLE_EQ(rows[1].summary.flow_max_m3_per_s, 6e-4);
  EXPECT_EQ(rows[1].summary.status, 3U);
  EXPECT_EQ(history("a", 1001, 2000).size(), 0U);
  EXPECT_THAT(refusal([&] { (void)history("c"); }), HasSubstr("knows no valve 'c'; it knows: a, b"));
}

// What changes little is written as its changes; at whatever second it ends, the last state comes back byte for byte.
TEST_F(StoreTest, AStateComesBackByteForByteAfterAnyCommit) {
  std::mt19937 random(3);
  ValveCommit valve = kept("a", 0, 1e-4);
  valve.state.bytes.assign(20'003, std::byte{0});  // no whole number of words
  for (int second = 1; second <= 200; ++second) {
    Store store(path("s.sqlite"));
    for (int commits = 0; commits < 3; ++commits) {
      const std::size_t changed = random() % (second % 50 == 0 ? valve.state.bytes.size() : 400);
      for (std::size_t k = 0; k < changed; ++k) {
        valve.state.bytes[random() % valve.state.bytes.size()] = static_cast<std::byte>(random());
      }
      valve.state.next += 1000;
      commit(store, 10'000 * second + commits, {valve});
    }
    const auto states = store.states();
    ASSERT_EQ(states.size(), 1U);
    ASSERT_EQ(states[0].bytes, valve.state.bytes) << second;
    ASSERT_EQ(states[0].next, valve.state.next);
  }
  EXPECT_EQ(history("a").size(), 600U);
}

TEST_F(StoreTest, AStateOfAnotherLengthOrLayoutTakesThePlaceOfTheOneBefore) {
  Store store(path("s.sqlite"));
  ValveCommit valve = kept("a", 1, 1e-4);
  for (const std::size_t length : {100U, 40U, 40U, 0U, 300U}) {
    valve.state.bytes.assign(length, static_cast<std::byte>(length));
    valve.state.layout += "'";
    commit(store, static_cast<std::int64_t>(1000 + length), {valve});
    ASSERT_EQ(store.states()[0].bytes, valve.state.bytes);
    ASSERT_EQ(store.states()[0].layout, valve.state.layout);
  }
}

// A site may lose a valve and get it back: what others write meanwhile leaves its state as it was.
TEST_F(StoreTest, AValveThatRestsKeepsItsState) {
  ValveCommit a = kept("a", 1, 1e-4), b = kept("b", 1, 1e-4);
  {
    Store store(path("s.sqlite"));
    commit(store, 1000, {a, b});
    a.state.bytes[1] = b.state.bytes[1] = std::byte{77};
    commit(store, 2000, {a, b});
  }
  Store store(path("s.sqlite"));
  a.state.bytes[2] = std::byte{78};
  for (int second = 3; second < 6; ++second) commit(store, 1000 * second, {a});
  ASSERT_EQ(store.states().size(), 2U);
  EXPECT_EQ(store.states()[0].bytes, a.state.bytes);
  EXPECT_EQ(store.states()[1].bytes, b.state.bytes);
}

TEST_F(StoreTest, RowsAreWholeInWhicheverTableTheyLie) {
  Store store(path("s.sqlite"));
  for (int second = 0; second < 150; ++second) commit(store, 1000 * second, {kept("a", 1, 1e-4), kept("b", 1, 2e-4)});
  const auto rows = history("b");
  ASSERT_EQ(rows.size(), 150U);
  for (int second = 0; second < 150; ++second) EXPECT_EQ(rows[static_cast<std::size_t>(second)].wall_ms, 1000 * second);
  EXPECT_EQ(history("a", 100'000, 130'000).size(), 30U);
}

// A file that may not grow stands for the full disk: what came meanwhile is kept with the first commit that finds room.
TEST_F(StoreTest, NothingIsLostThatADiskWithoutRoomRefused) {
  Store store(path("s.sqlite"));
  ValveCommit valve = kept("a", 1000, 1e-4);
  valve.state.bytes.assign(30'000, std::byte{1});
  commit(store, 1000, {valve});
  const auto before = ::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit no_more{4096, limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &no_more), 0);
  ValveCommit next = kept("new", 2000, 1e-4);
  next.state.bytes.assign(30'000, std::byte{2});
  std::vector<Event> events{{.wall_ms = 2000, .valve = "new", .time_s = 3, .kind = "condition", .text = "NE 107 M"}};
  EXPECT_THAT(refusal([&] { store.commit({2000, 2000}, {valve, next}, events); }), HasSubstr("check the disk"));
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, before);
  EXPECT_EQ(events[0].id, 0);  // still to be kept
  EXPECT_EQ(store.states().size(), 1U);
  store.commit({3000, 3000}, {valve, next}, events);
  EXPECT_EQ(events[0].id, 1);
  ASSERT_EQ(store.states().size(), 2U);
  EXPECT_EQ(store.states()[1].bytes, next.state.bytes);
  EXPECT_EQ(history("new").size(), 1U);
}

TEST_F(StoreTest, AFullDiskIsReportedWithWhatToDo) {
  Database database(path("small.sqlite"), Database::Access::write);
  database.run("CREATE TABLE x(y); PRAGMA max_page_count=3");
  EXPECT_THAT(refusal([&] { database.run("INSERT INTO x VALUES(zeroblob(100000))"); }),
              HasSubstr("the disk is full; free some space, or let the store keep less"));
}

TEST_F(StoreTest, NumbersOfAnySizeComeBack) {
  Store store(path("s.sqlite"));
  ValveCommit valve = kept("a", ~std::uint64_t{0}, NAN);
  commit(store, 1000, {valve});
  EXPECT_EQ(store.states()[0].next, ~std::uint64_t{0});
  EXPECT_TRUE(std::isnan(history("a")[0].summary.flow_mean_m3_per_s));
}

TEST_F(StoreTest, IsOneProgramsAtATimeByWhateverName) {
  const auto first = std::make_unique<Store>(path("s.sqlite"));
  std::filesystem::create_symlink("s.sqlite", path("symbolic.sqlite"));
  std::filesystem::create_hard_link(path("s.sqlite"), path("hard.sqlite"));
  for (const char* const name : {"s.sqlite", "symbolic.sqlite", "hard.sqlite"}) {
    EXPECT_THAT(refusal([&] { Store second(path(name)); }), HasSubstr("another spoolflow live is running on it"))
        << name;
  }
}

TEST_F(StoreTest, ASymbolicLinkLeadsToAStoreThatIsMendedWhereItLies) {
  std::filesystem::create_directory(path("disk"));
  std::filesystem::create_symlink("disk/s.sqlite", path("link.sqlite"));
  Store store(path("link.sqlite"));
  commit(store, 1000, {kept("a", 1000, 1e-4)});
  std::filesystem::remove(path("disk/s.sqlite"));
  EXPECT_THAT(store.look_after(2000), HasSubstr("written again"));
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.sqlite")));
  EXPECT_TRUE(std::filesystem::exists(path("disk/s.sqlite")));
  EXPECT_EQ(store.states().size(), 1U);
}

/// Rights bind everybody but the system's administrator, who runs tests in containers: for this long he is nobody.
class Nobody {
 public:
  Nobody() : before_(::geteuid()) {
    if (before_ != 0) return;
    EXPECT_EQ(::seteuid(65534), 0);
  }
  ~Nobody() { EXPECT_EQ(::seteuid(before_), 0); }
  Nobody(const Nobody&) = delete;
  Nobody& operator=(const Nobody&) = delete;

 private:
  uid_t before_;
};

TEST_F(StoreTest, IsRefusedAtOnceWhereItMayNotBeWrittenTo) {
  namespace fs = std::filesystem;
  fs::permissions(folder, fs::perms::all);
  const Nobody nobody;
  {
    Store store(path("s.sqlite"));
    commit(store, 1000, {kept("a", 1000, 1e-4)});
  }
  fs::permissions(path("s.sqlite"), fs::perms::owner_read);
  EXPECT_THAT(refusal([&] { Store store(path("s.sqlite")); }), HasSubstr("s.sqlite: may not be written to"));
  fs::permissions(path("s.sqlite"), fs::perms::owner_read | fs::perms::owner_write);
  write("s.sqlite-wal", "");
  fs::permissions(path("s.sqlite-wal"), fs::perms::owner_read);
  EXPECT_THAT(refusal([&] { Store store(path("s.sqlite")); }), HasSubstr("s.sqlite-wal may not be written to"));
  fs::remove(path("s.sqlite-wal"));
  { const Store store(path("s.sqlite")); }
  fs::create_directory(path("readable"));
  fs::copy_file(path("s.sqlite"), path("readable/s.sqlite"));
  fs::permissions(path("readable"), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(refusal([&] { Store store(path("readable/s.sqlite")); }), HasSubstr("its folder"));
  EXPECT_THAT(refusal([&] { Store store(path("readable/new.sqlite")); }), HasSubstr("may not be written to"));
  fs::permissions(path("readable"), fs::perms::all);
  EXPECT_EQ(history("a").size(), 1U);
}

TEST_F(StoreTest, RefusesWhatItCannotKnow) {
  { Store store(path("s.sqlite")); }
  {
    Database database(path("s.sqlite"), Database::Access::write);
    database.run("PRAGMA user_version=99");
  }
  EXPECT_THAT(refusal([&] { Store store(path("s.sqlite")); }), HasSubstr("store of version 99, this program knows"));
  {
    Database database(path("other.sqlite"), Database::Access::write);
    database.run("CREATE TABLE x(y)");
  }
  EXPECT_THAT(refusal([&] { Store store(path("other.sqlite")); }), HasSubstr("database of another program"));
  write("text.sqlite", std::string(5000, 'x'));
  EXPECT_THAT(refusal([&] { Store store(path("text.sqlite")); }), HasSubstr("is no store of spoolflow live"));
  EXPECT_THAT(refusal([&] { Store store(path("none/s.sqlite")); }), HasSubstr("folder does not exist"));
  EXPECT_THAT(refusal([&] { read_history(path("none.sqlite"), "a", 0, 1, {}); }), HasSubstr("there is no such file"));
}

TEST_F(StoreTest, ADamagedFileIsReported) {
  {
    Store store(path("s.sqlite"));
    for (int k = 0; k < 200; ++k) commit(store, 1000 * k, {kept("a", 1000, 1e-4), kept("b", 500, 2e-4)});
  }
  std::fstream file(path("s.sqlite"), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(4096);
  file << std::string(8192, '\x5a');
  file.close();
  EXPECT_THAT(refusal([&] { Store store(path("s.sqlite")); }), HasSubstr("is damaged"));
}

TEST_F(StoreTest, HistoryIsReadWhileItIsWritten) {
  Store store(path("s.sqlite"));
  commit(store, 1000, {kept("a", 1000, 1e-4)});
  std::size_t rows = 0;
  read_history(path("s.sqlite"), "a", 0, 10000, [&](const HistoryRow&) {
    ++rows;
    commit(store, 2000, {kept("a", 2000, 1e-4)});
  });
  EXPECT_EQ(rows, 1U);
  EXPECT_EQ(history("a").size(), 2U);
}

}  // namespace
}  // namespace spoolflow::live
