/// `live` and `history` as they are called: beginning, ends, kills, what is refused.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/tests/command/live_site.hpp"
#include "tests/apps/running_command.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Live : public LiveSite {};

TEST_F(Live, RunsUntilItIsEnded) {
  for (const int ended_by : {SIGINT, SIGTERM}) {
    RunningCommand live(folder, {"live", "--listen", "127.0.0.1:0", "--store", "s.sqlite"});
    EXPECT_THAT(live.message_line(), StartsWith("8 valves; page at http://127.0.0.1:"));
    live.signal(ended_by);
    ::usleep(20000);
    live.signal(SIGTERM);  // as `timeout` does: to the program, and to its group
    EXPECT_EQ(live.wait(), 0);
    EXPECT_THAT(live.message_line(), HasSubstr("what came until now is kept"));
  }
}

// Files that may not grow stand for the full disk.
TEST_F(Live, EndsOnAFullDiskWithStatus1AndSaysSinceWhenNothingIsKept) {
  write_site("{ kind = \"rig\", seed = 1 }");
  const std::vector<std::string> command{"live", "site.toml", "--store", "s.sqlite"};
  {
    RunningCommand live(folder, command);
    EXPECT_THAT(live.message_line(), StartsWith("1 valve; page at"));
    live.signal(SIGTERM);
    EXPECT_EQ(live.wait(), 0);
  }
  const auto before = ::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit no_more{40000, limit.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &no_more);
  RunningCommand live(folder, command);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, before);
  EXPECT_THAT(live.message_line(), StartsWith("1 valve; page at"));
  EXPECT_THAT(live.message_line(), HasSubstr("/s.sqlite: "));
  live.signal(SIGTERM);
  EXPECT_EQ(live.wait(), 1);
  EXPECT_THAT(live.message_line(), AllOf(HasSubstr("ended; what came since 20"),
                                         HasSubstr("could not be kept and is lost: "), HasSubstr("/s.sqlite: ")));
}

TEST_F(Live, HistoryIsWhatCame) {
  write("run.csv", std::string(live_header) + live_rows(3000));
  write_site("{ kind = \"replay\", recording = \"run.csv\", speed = 0 }");
  {
    RunningCommand live(folder, {"live", "site.toml", "--store", "s.sqlite"});
    EXPECT_THAT(live.message_line(), StartsWith("1 valve; page at"));
    for (int k = 0; k < 3000 && kept("SELECT samples FROM state") < 3000; ++k) ::usleep(10000);
    live.signal(SIGINT);
    EXPECT_EQ(live.wait(), 0);
  }
  const Answer history = run("history s.sqlite --valve v -o -");
  EXPECT_EQ(history.status, 0);
  EXPECT_THAT(history.output, StartsWith("time_utc,time_s,samples,flow_min_L_min,flow_mean_L_min,flow_max_L_min,"));
  EXPECT_EQ(kept("SELECT sum(samples) FROM second"), 3000);
  EXPECT_EQ(run("history s.sqlite --valve v --to 2020-01-01T00:00:00Z -o -").output.find("\n20"), std::string::npos);
  const Answer other = run("history s.sqlite --valve w -o -");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.message, HasSubstr("knows no valve 'w'; it knows: v"));
  EXPECT_THAT(run("history s.sqlite --valve v --to 2020-01-01 -o -").message,
              HasSubstr("keeps nothing of v in that time"));
  for (const auto& [asked, said] : {std::pair{"--recording 1 --valve v -o -", "leave --valve, --from and --to away"},
                                    std::pair{"--recording 0 -o -", "holds no recording 0"},
                                    std::pair{"--valve v -o v.parquet", "written as CSV alone"},
                                    std::pair{"--valve v -o v.xlsx", "written as CSV alone"},
                                    std::pair{"--valve v --from 2026-02-30 -o -", "no instant"}}) {
    const Answer refused = run(std::string("history s.sqlite ") + asked);
    EXPECT_EQ(refused.status, 2) << asked;
    EXPECT_THAT(refused.message, HasSubstr(said)) << asked;
  }
  EXPECT_THAT(run("history . --valve v -o -").message, HasSubstr("is a folder; name a store in it"));
  EXPECT_EQ(run("history s.sqlite --valve v --from yesterday -o -").status, 2);
  EXPECT_EQ(run("history model.json --valve v -o -").status, 2);
}

// Each pass is read by a new process, which a thread asks for.
TEST_F(Live, AnHdf5FileIsReplayedOverAndOver) {
  write_site("{ kind = \"replay\", recording = \"" SPOOLFLOW_EXAMPLES
             "/valve_a/ramp_60bar.h5\", speed = 0, repeats = true }");
  RunningCommand live(folder, {"live", "site.toml", "--store", "s.sqlite"});
  EXPECT_THAT(live.message_line(), StartsWith("1 valve; page at"));
  constexpr double three_passes = 3 * 47000;
  for (int k = 0; k < 3000 && kept("SELECT samples FROM state") <= three_passes; ++k) ::usleep(10000);
  live.signal(SIGINT);
  EXPECT_EQ(live.wait(), 0);
  EXPECT_GT(kept("SELECT samples FROM state"), three_passes);
}

// The senders of examples/live, as processes of their own.
TEST_F(Live, TheExamplesSendersAreUnderstood) {
  write("run.csv", std::string(live_header) + live_rows(1000));
  write("site.toml",
        "[page]\nlisten = \"127.0.0.1:0\"\n[sources]\nudp = \"127.0.0.1:0\"\n[[valve]]\nid = \"v\"\nmodel = "
        "\"model.json\"\nsource = { kind = \"udp\" }\n");
  RunningCommand live(folder, {"live", "site.toml", "--store", "s.sqlite"});
  const std::string where = live.message_line();
  EXPECT_THAT(where, StartsWith("datagrams over UDP at 127.0.0.1:"));
  const std::string port = where.substr(where.rfind(':') + 1);
  const auto comes = [&](double samples) {
    for (int k = 0; k < 3000 && kept("SELECT samples FROM state") < samples; ++k) ::usleep(10000);
    return kept("SELECT samples FROM state");
  };
  EXPECT_EQ(std::system(
                fmt::format("'{}' v 127.0.0.1 {} 25 > '{}/c.txt'", SPOOLFLOW_C_SENDER, port, folder.string()).c_str()),
            0);
  EXPECT_EQ(comes(500), 500);
  EXPECT_EQ(std::system(fmt::format("'{}/live/send_samples.py' '{}/run.csv' v 127.0.0.1:{} --speed 5 > '{}/py.txt'",
                                    SPOOLFLOW_EXAMPLES, folder.string(), port, folder.string())
                            .c_str()),
            0);
  EXPECT_EQ(comes(1500), 1500);
  EXPECT_GT(kept("SELECT max(flow_max) FROM second"), 0);
}

TEST_F(Live, TheExamplesSenderSendsNoHalfSamples) {
  write("whole.csv", "time_s,current_a_A,current_b_A,position_mm\n0,0,1,1\n0.001,0,1,1\n");
  write("gap.csv", "time_s,current_A,position_mm\n0,1,1\n0.001,1,1\n0.002,1,1\n0.5,1,1\n");
  for (const auto& [file, said] :
       {std::pair{"whole.csv", "lacks current_A"}, std::pair{"gap.csv", "sample 4: is 0.498 s from the one before"}}) {
    const int status = std::system(fmt::format("'{0}/live/send_samples.py' '{1}/{2}' v 127.0.0.1:9 2> '{1}/said.txt'",
                                               SPOOLFLOW_EXAMPLES, folder.string(), file)
                                       .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2) << file;
    std::ifstream text(folder / "said.txt");
    EXPECT_THAT(std::string(std::istreambuf_iterator<char>(text), {}), HasSubstr(said));
  }
}

TEST_F(Live, WhatCannotBeUsedIsRefusedAtOnce) {
  write_site("{ kind = \"replay\", recording = \"missing.csv\" }");
  for (const char* asked : {"live missing.toml", "live model.json", "live site.toml", "live --listen 127.0.0.1",
                            "live --listen 0.0.0.0:0", "live --store missing/s.sqlite --listen 127.0.0.1:0"}) {
    const Answer answer = run(asked);
    EXPECT_EQ(answer.status, 2) << asked << answer.message;
    EXPECT_EQ(std::count(answer.message.begin(), answer.message.end(), '\n'), 1) << asked << answer.message;
  }
  EXPECT_THAT(run("live --listen 0.0.0.0:0").message, AllOf(HasSubstr("needs TLS and a token"), HasSubstr("ssh -L")));
  RunningCommand first(folder, {"live", "--listen", "127.0.0.1:0", "--store", "s.sqlite"});
  EXPECT_THAT(first.message_line(), StartsWith("8 valves"));
  const Answer second = run("live --listen 127.0.0.1:0 --store s.sqlite");
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.message, HasSubstr("another spoolflow live is running on it"));
}

TEST_F(Live, APortThatIsInUseLeavesNoStoreBehind) {
  RunningCommand first(folder, {"live", "--listen", "127.0.0.1:0"});
  (void)first.message_line();  // nothing is kept
  const std::string page = first.message_line();
  const std::string port = page.substr(page.rfind(':') + 1, page.rfind("/ ;") - page.rfind(':') - 1);
  const Answer second = run("live --listen 127.0.0.1:" + port + " --store s.sqlite");
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.message, HasSubstr("end the program that listens there or choose another port"));
  EXPECT_FALSE(std::filesystem::exists(folder / "s.sqlite"));
}

}  // namespace
}  // namespace spoolflow::apps
