/// Sources that misbehave, through the whole program: each changes its valve's status and counters, and the program
/// goes on.
#include <algorithm>
#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/tests/command/live_site.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::StartsWith;
using Json = nlohmann::json;

class LiveSource : public LiveSite {
 protected:
  void SetUp() override {
    LiveSite::SetUp();
    write_site("{ kind = \"tcp\", listen = \"127.0.0.1:0\" }", "[sources]\nstalled_after_s = 0.3\n");
    live =
        std::make_unique<RunningCommand>(folder, std::vector<std::string>{"live", "site.toml", "--store", "s.sqlite"});
    const std::string valve = live->message_line();
    ASSERT_THAT(valve, StartsWith("valve v: CSV over TCP at 127.0.0.1:"));
    source = port_in(valve);
    page = port_in(live->message_line());
  }
  void TearDown() override {
    live->signal(SIGTERM);
    EXPECT_EQ(live->wait(), 0);
    LiveSite::TearDown();
  }
  [[nodiscard]] Json with_samples(int wanted) const {
    return valve_once(page, [&](const Json& valve) { return valve["samples"] >= wanted; });
  }
  static bool says(const Json& valve, const char* status) {
    const auto all = valve["status"].get<std::vector<std::string>>();
    return std::count(all.begin(), all.end(), status) > 0;
  }
  std::unique_ptr<RunningCommand> live;
  std::uint16_t source = 0, page = 0;
};

TEST_F(LiveSource, ThatStallsIsReportedAndTakenUpAgain) {
  const LoopbackSender sender(source);
  sender.send(std::string(live_header) + live_rows(100));
  EXPECT_EQ(with_samples(100)["samples"], 100);
  const Json stalled = valve_once(page, [](const Json& valve) { return says(valve, "stalled"); });
  EXPECT_TRUE(says(stalled, "stalled"));
  EXPECT_EQ(stalled["ne107"], "C");
  EXPECT_EQ(stalled["samples"], 100);
  sender.send(live_rows(1, 400));
  const Json again = valve_once(page, [](const Json& valve) { return !says(valve, "stalled"); });
  EXPECT_FALSE(says(again, "stalled"));
}

TEST_F(LiveSource, ThatRepeatsItselfHasATimeFault) {
  const LoopbackSender sender(source);
  sender.send(std::string(live_header) + live_rows(100) + live_rows(1, 99));
  const Json valve = with_samples(101);
  EXPECT_EQ(valve["samples"], 101);
  EXPECT_TRUE(says(valve, "time_fault"));
  sender.send(live_rows(1, 100));
  EXPECT_FALSE(says(with_samples(102), "time_fault"));
}

TEST_F(LiveSource, ThatRunsBackHoldsTheAnswer) {
  const LoopbackSender sender(source);
  sender.send(std::string(live_header) + live_rows(300));
  const Json before = with_samples(300);
  sender.send(live_rows(1, 10));
  const Json valve = with_samples(301);
  EXPECT_TRUE(says(valve, "time_fault"));
  EXPECT_EQ(valve["flow_L_min"], before["flow_L_min"]);
  sender.send(live_rows(100, 11));
  EXPECT_FALSE(says(with_samples(401), "time_fault"));
}

TEST_F(LiveSource, ThatSkipsGoesOnBehindTheGap) {
  const LoopbackSender sender(source);
  sender.send(std::string(live_header) + live_rows(300) + live_rows(1, 5000));
  const Json valve = with_samples(301);
  EXPECT_TRUE(says(valve, "time_fault"));  // nobody knows what was in so many seconds: it is reset
  EXPECT_NEAR(valve["time_s"].get<double>(), 5.0, 1e-9);
  sender.send(live_rows(300, 5001));
  EXPECT_FALSE(says(with_samples(601), "time_fault"));
}

TEST_F(LiveSource, OfRubbishIsCountedAndTheNextOneTaken) {
  {
    const LoopbackSender rubbish(source);
    rubbish.send(std::string(20'000, '\xfe') + "\n\n\n");
    const Json valve =
        valve_once(page, [](const Json& at) { return at["source"]["trouble"] != "nobody is connected"; });
    EXPECT_EQ(valve["source"]["trouble"], "127.0.0.1 is connected and has sent no line of names yet");
    EXPECT_EQ(valve["samples"], 0);
    EXPECT_TRUE(says(valve, "stalled"));
  }
  const LoopbackSender sender(source);
  sender.send(std::string(live_header) + live_rows(50) + "rubbish\n" + live_rows(50, 60));
  const Json valve = with_samples(100);
  EXPECT_EQ(valve["samples"], 100);
  EXPECT_EQ(valve["source"]["unreadable"], 1);
}

TEST_F(LiveSource, OfNothingMeasuredHoldsWithStatus) {
  const LoopbackSender sender(source);
  sender.send(std::string(live_header) + live_rows(100) + "0.100,nan,nan,nan,nan\n");
  const Json valve = with_samples(101);
  EXPECT_TRUE(says(valve, "sample_missing"));
}

}  // namespace
}  // namespace spoolflow::apps
