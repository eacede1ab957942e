/// `live` killed at random instants: what comes out is what an uninterrupted run gives. A handful of kills; as many as
/// SPOOLFLOW_KILLS says in ci/long.sh.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/tests/command/live_site.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::StartsWith;

class Kills : public LiveSite {
 protected:
  /// What is left of a run, to the last digit.
  struct Totals {
    double samples, rows, energy_J, strokes, distance_m, volume_m3, watched_s;
  };
  [[nodiscard]] double last(const std::string& indicator) const {
    return kept(("SELECT value FROM indicator WHERE name = '" + indicator + "' ORDER BY wall_ms DESC").c_str());
  }
  /// Plays to the end, ends it, and takes the store away.
  Totals ended(double samples) {
    RunningCommand live(folder, {"live", "site.toml", "--store", "s.sqlite"});
    EXPECT_THAT(live.message_line(), StartsWith("1 valve; page at"));
    EXPECT_EQ(kept_samples(samples), samples);
    live.signal(SIGTERM);
    EXPECT_EQ(live.wait(), 0);
    const Totals out{kept("SELECT samples FROM state"),
                     kept("SELECT sum(samples) FROM second"),
                     kept("SELECT energy_J FROM state"),
                     last("strokes"),
                     last("distance"),
                     last("oil_volume"),
                     last("watched_time")};
    for (const char* file : {"s.sqlite", "s.sqlite-wal", "s.sqlite-shm"}) std::filesystem::remove(folder / file);
    return out;
  }
};

TEST_F(Kills, AtAnyInstantLeaveTotalsAsTheyWouldBe) {
  const char* const wanted = std::getenv("SPOOLFLOW_KILLS");
  const int kills = wanted == nullptr ? 4 : std::max(1, std::atoi(wanted));
  const int samples = 3000 * kills;
  write("run.csv", std::string(live_header) + live_rows(samples));
  write_site("{ kind = \"replay\", recording = \"run.csv\", speed = 0 }");
  const Totals whole = ended(samples);
  EXPECT_EQ(whole.samples, samples);
  EXPECT_EQ(whole.rows, samples);
  EXPECT_GT(whole.strokes, 1);
  EXPECT_GT(whole.energy_J, 0);

  write_site("{ kind = \"replay\", recording = \"run.csv\", speed = 3 }");
  std::mt19937 random(11);
  std::uniform_int_distribution<useconds_t> lives_us(0, 1'800'000);
  for (int k = 0; k < kills; ++k) {
    RunningCommand live(folder, {"live", "site.toml", "--store", "s.sqlite"});
    EXPECT_THAT(live.message_line(), StartsWith("1 valve; page at"));
    ::usleep(lives_us(random));
    live.signal(SIGKILL);
    EXPECT_EQ(live.wait(), 128 + SIGKILL);
  }
  EXPECT_GT(kept("SELECT samples FROM state"), 0);  // it had come on between the kills
  const Totals killed = ended(samples);
  EXPECT_EQ(killed.samples, whole.samples);
  EXPECT_EQ(killed.rows, whole.rows);
  EXPECT_EQ(killed.energy_J, whole.energy_J);
  EXPECT_EQ(killed.strokes, whole.strokes);
  EXPECT_EQ(killed.distance_m, whole.distance_m);
  EXPECT_EQ(killed.volume_m3, whole.volume_m3);
  EXPECT_EQ(killed.watched_s, whole.watched_s);
}

}  // namespace
}  // namespace spoolflow::apps
