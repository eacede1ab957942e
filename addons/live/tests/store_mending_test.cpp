/// The store's file deleted, replaced, cut off or overwritten while the program works on it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/history/store.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class StoreMending : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    store_ = std::make_unique<Store>(path("s.sqlite"));
    keep(1000);
    keep(2000);
  }
  void TearDown() override {
    store_.reset();
    InFolder::TearDown();
  }
  static ValveCommit valve(std::int64_t samples) {
    ValveCommit out;
    out.state = {"a", 7, 1000, 1000, 12.5, "layout", {std::byte{1}, std::byte{2}}};
    out.since_last = {.samples = samples, .time_s = 3.5};
    return out;
  }
  void keep(std::int64_t wall_ms, std::int64_t samples = 1000) {
    std::vector<Event> events{{.wall_ms = wall_ms, .kind = "program", .text = std::to_string(wall_ms)}};
    store_->commit({.wall_ms = wall_ms, .steady_ms = wall_ms}, {valve(samples)}, events);
    known_.push_back(events.front());
  }
  [[nodiscard]] std::vector<std::int64_t> seconds() const {
    std::vector<std::int64_t> out;
    read_history(path("s.sqlite"), "a", 0, std::int64_t{1} << 60,
                 [&](const HistoryRow& row) { out.push_back(row.wall_ms); });
    return out;
  }
  void mend(const std::string& words) {
    EXPECT_THAT(store_->look_after(3000), HasSubstr(words));
    store_->keep_again(known_, {});
    EXPECT_THAT(store_->look_after(4000), IsEmpty());
  }
  /// The only one whose name begins so.
  [[nodiscard]] std::string beside(const std::string& begin) const {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(begin) && !name.ends_with("-wal")) return entry.path().string();
    }
    return {};
  }
  /// What another start would go on from.
  void expect_goes_on(std::size_t events) {
    store_ = {};
    Store again(path("s.sqlite"));
    ASSERT_EQ(again.states().size(), 1U);
    EXPECT_EQ(again.states()[0].bytes, (std::vector{std::byte{1}, std::byte{2}}));
    EXPECT_EQ(again.events(10).size(), events);
    EXPECT_EQ(again.events(10).back().text, "5000");
  }

  std::unique_ptr<Store> store_;
  std::vector<Event> known_;
};

TEST_F(StoreMending, ADeletedFileIsWrittenAgainWithAllThatItHeld) {
  fs::remove(path("s.sqlite"));
  mend("was deleted");
  keep(5000);
  EXPECT_THAT(seconds(), ElementsAre(1000, 2000, 5000));
  expect_goes_on(3);
}

TEST_F(StoreMending, SoItIsWhereTheLogWentWithIt) {
  for (const char* end : {"", "-wal", "-shm"}) fs::remove(path(std::string("s.sqlite") + end));
  mend("was deleted");
  keep(5000);
  EXPECT_THAT(seconds(), ElementsAre(1000, 2000, 5000));
  EXPECT_THAT(refusal([&] { const Store second(path("s.sqlite")); }), HasSubstr("another spoolflow live"));
  expect_goes_on(3);
}

TEST_F(StoreMending, ADeletedLogTakesNothingWithIt) {
  fs::remove(path("s.sqlite-wal"));
  mend("s.sqlite-wal was deleted");
  keep(5000);
  EXPECT_THAT(seconds(), ElementsAre(1000, 2000, 5000));
  expect_goes_on(3);
}

// Without new samples, too: the new store has the state of every valve.
TEST_F(StoreMending, AFileThatWasCutOffIsSetAsideAndANewOneGoesOnFromTheSameStates) {
  fs::resize_file(path("s.sqlite"), 0);
  mend("cut off or overwritten");
  EXPECT_NE(beside("s.sqlite.damaged-"), "");
  keep(5000, 0);
  expect_goes_on(3);
}

TEST_F(StoreMending, AnOverwrittenFileLikewiseAndWhatIsLeftOfItStays) {
  const auto bytes = fs::file_size(path("s.sqlite"));
  {
    std::fstream file(path("s.sqlite"), std::ios::in | std::ios::out | std::ios::binary);
    file << std::string(bytes, 'x');
  }
  mend("cut off or overwritten");
  const std::string aside = beside("s.sqlite.damaged-");
  EXPECT_EQ(fs::file_size(aside), bytes);
  EXPECT_GT(fs::file_size(aside + "-wal"), 0U);
  keep(5000);
  EXPECT_THAT(seconds(), ElementsAre(5000));
  expect_goes_on(3);
}

TEST_F(StoreMending, AnotherStoreInItsPlaceIsGoneOnInAndTheFirstIsSaved) {
  {
    Store other(path("other.sqlite"));
    std::vector<Event> none;
    other.commit({500, 500}, {valve(10)}, none);
  }
  fs::rename(path("other.sqlite"), path("s.sqlite"));
  mend("another file was put in its place");
  keep(5000);
  EXPECT_THAT(seconds(), ElementsAre(500, 5000));
  std::vector<std::int64_t> saved;
  read_history(beside("s.sqlite.replaced-"), "a", 0, std::int64_t{1} << 60,
               [&](const HistoryRow& row) { saved.push_back(row.wall_ms); });
  EXPECT_THAT(saved, ElementsAre(1000, 2000));
  expect_goes_on(3);
}

TEST_F(StoreMending, WhereNothingCanBeKeptItIsReportedAndTriedAgain) {
  fs::remove(path("s.sqlite"));
  fs::create_directory(path("s.sqlite"));
  EXPECT_THAT(refusal([&] { (void)store_->look_after(3000); }), HasSubstr("s.sqlite"));
  EXPECT_THAT(refusal([&] { keep(3500); }), HasSubstr("nothing is kept"));
  EXPECT_THAT(refusal([&] { (void)store_->look_after(3600); }), HasSubstr("s.sqlite"));
  fs::remove(path("s.sqlite"));
  mend("can be used again");
  keep(5000);
  EXPECT_NE(beside("s.sqlite.replaced-"), "");
  expect_goes_on(3);
}

TEST_F(StoreMending, DamageThatSqliteMeetsWhereItReadsIsMendedTheNextSecond) {
  store_.reset();
  store_ = std::make_unique<Store>(path("s.sqlite"));  // the log is empty, all pages are in the file
  KeptRecording large{.wall_ms = 2500, .valve = "a", .why = "it takes the place of all pages in memory"};
  large.csv.assign(8 << 20, 'x');
  EXPECT_EQ(store_->keep_recording(large), 1);
  {
    std::fstream file(path("s.sqlite"), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(4096);
    file << std::string(fs::file_size(path("s.sqlite")) - 4096, 'x');
  }
  EXPECT_THAT(store_->look_after(3000), IsEmpty());
  bool damaged = false;
  for (int second = 4; second < 70 && !damaged; ++second) {
    damaged = !refusal([&] { keep(1000 * second); }).empty();
  }
  EXPECT_TRUE(damaged);
  mend("cut off or overwritten");
  keep(5000);
  EXPECT_NE(beside("s.sqlite.damaged-"), "");
}

}  // namespace
}  // namespace spoolflow::live
