/// What comes from real senders by TCP, UDP and pipes, and what does not.
#include <algorithm>
#include <chrono>
#include <fcntl.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/tests/engine_site.hpp"

namespace spoolflow::live {
namespace {

using ::testing::HasSubstr;

using SendersTest = EngineTest;

TEST_F(SendersTest, AnswersWhatComesByTcp) {
  Engine engine(site({{"t", TcpSettings{{"127.0.0.1", 0}}}}), "test");
  engine.start();
  const std::uint16_t port = engine.source(0).port;
  {
    const Sender sender(port);
    sender.send(engine_header + rows(0, 50));
    ASSERT_TRUE(has(engine, 0, 50));  // though the connection stays open
    sender.send("rubbish\n0.05,what?,4.8,1.0,50\n" + rows(51, 52));
    ASSERT_TRUE(has(engine, 0, 52));
    EXPECT_NEAR(engine.view(0).time_s, 0.051, 1e-9);
    EXPECT_EQ(engine.source(0).counters.unreadable, 1U);
  }
  const Sender next(port);  // the next connection goes on, with a header of its own
  next.send(engine_header + rows(60, 70));
  ASSERT_TRUE(has(engine, 0, 62));
  const Sender stronger(port);  // and the newest takes the place of the one before
  stronger.send(engine_header + rows(80, 90));
  ASSERT_TRUE(has(engine, 0, 72));
  EXPECT_EQ(engine.source(0).counters.connections, 3U);
}

TEST_F(SendersTest, AColumnThatMayBeMeantIsNotLeftOutInSilence) {
  Engine engine(site({{"t", TcpSettings{{"127.0.0.1", 0}}}}), "test");
  engine.start();
  const Sender sender(engine.source(0).port);
  sender.send("time_s,current_A,U_coil_V,position_mm,oil_temperature_C\n" + rows(0, 50));
  ASSERT_TRUE(has(engine, 0, 50));
  ASSERT_TRUE(comes_true([&] {
    const std::vector<Event> events = engine.events();
    return std::ranges::any_of(events, [](const Event& one) {
      return one.text.find("the sender's samples: column 'U_coil_V' is not read: if it is voltage, name it") == 0;
    });
  }));
}

TEST_F(SendersTest, AStrangerWhoConnectsDoesNotCutOffTheSenderThatIsAllowed) {
  SiteSettings settings = site({{"t", TcpSettings{{"127.0.0.1", 0}}}});
  settings.allow = {"127.0.0.1"};
  Engine engine(settings, "test");
  engine.start();
  const std::uint16_t port = engine.source(0).port;
  const Sender sender(port);
  sender.send(engine_header + rows(0, 50));
  ASSERT_TRUE(has(engine, 0, 50));
  for (int k = 0; k < 40; ++k) {
    const Sender stranger(port, 2);
  }
  ASSERT_TRUE(comes_true([&] { return engine.source(0).trouble.find("127.0.0.2") != std::string::npos; }));
  sender.send(rows(50, 100));
  ASSERT_TRUE(has(engine, 0, 100));
  EXPECT_EQ(engine.source(0).counters.connections, 1U);
}

TEST_F(SendersTest, OneSourceOfRubbishDisturbsNoOther) {
  Engine engine(site({{"bad", TcpSettings{{"127.0.0.1", 0}}}, {"good", TcpSettings{{"127.0.0.1", 0}}}}), "test");
  engine.start();
  const Sender bad(engine.source(0).port);
  bad.send(std::string(5000, '\xff') + "\n\n" + std::string(1000, '\0') + "\n1,2,3\n");
  const Sender good(engine.source(1).port);
  good.send(engine_header + rows(0, 20));
  ASSERT_TRUE(has(engine, 1, 20));
  EXPECT_TRUE(comes_true([&] { return !engine.source(0).trouble.empty(); }));
  EXPECT_EQ(engine.view(0).samples, 0U);
  EXPECT_EQ(engine.view(0).condition, monitor::Ne107::function_check);  // stalled
  const Sender again(engine.source(0).port);
  again.send(engine_header + rows(0, 20));
  EXPECT_TRUE(has(engine, 0, 20));
}

TEST_F(SendersTest, AnswersDatagramsAndCountsWhatIsNone) {
  Engine engine(site({{"u", UdpSettings{}}}), "test");
  engine.start();
  send_datagrams(engine, 0, 20);
  ASSERT_TRUE(has(engine, 0, 20));
  send_datagrams(engine, 30, 20);  // ten are lost
  ASSERT_TRUE(has(engine, 0, 40));
  send_datagrams(engine, 30, 20);  // came before
  send_bytes(engine, {1, 2, 3});
  ASSERT_TRUE(comes_true([&] { return engine.udp_counters().datagrams == 4; }));
  EXPECT_TRUE(comes_true([&] { return engine.udp_counters().unreadable == 1; }));
  const IntakeCounters counters = engine.source(0).counters;
  EXPECT_EQ(counters.lost, 10U);
  EXPECT_EQ(counters.repeated, 20U);
  EXPECT_EQ(engine.view(0).samples, 40U);
  EXPECT_GT(engine.view(0).answer.flow_m3_per_s, 0);
}

TEST_F(SendersTest, TwoSendersOfOneIdAreNoMixtureAndAreReportedOnce) {
  SiteSettings settings = site({{"u", UdpSettings{}}});
  settings.stalled_after_s = 30;  // the test's machine may be slow
  Engine engine(settings, "test");
  engine.start();
  std::uint64_t sequence = 0;
  for (; sequence < 200; sequence += 20) {
    send_datagrams(engine, sequence, 20, 7);
    send_datagrams(engine, 1000 + sequence, 20, 8);  // of the second: the first of this session comes as a new sender
  }
  ASSERT_TRUE(comes_true([&] { return engine.udp_counters().datagrams == 20; }));
  ASSERT_TRUE(comes_true([&] { return engine.view(0).samples == 220; }));  // one block of session 7, then 8 alone
  EXPECT_EQ(engine.udp_counters().refused, 9U);
  const std::string trouble = engine.source(0).trouble;
  EXPECT_THAT(trouble, HasSubstr("two senders use this id: samples of 127.0.0.1:"));
  EXPECT_THAT(trouble, HasSubstr("(session 8) are taken, those of 127.0.0.1:"));
  EXPECT_THAT(trouble, HasSubstr("(session 7) are refused"));
  const auto reported = [&] {
    const std::vector<Event> all = engine.events();
    return std::count_if(all.begin(), all.end(), [&](const Event& one) { return one.text == trouble; });
  };
  ASSERT_TRUE(comes_true([&] { return reported() == 1; }));
  for (; sequence < 600; sequence += 20) {
    send_datagrams(engine, sequence, 20, 7);
    send_datagrams(engine, 1000 + sequence, 20, 8);
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
  }
  EXPECT_EQ(reported(), 1);
}

TEST_F(SendersTest, ReadsAPipeAgainAndAgain) {
  ASSERT_EQ(::mkfifo(path("fifo").c_str(), 0600), 0);
  Engine engine(site({{"p", PipeSettings{path("fifo")}}}), "test");
  engine.start();
  for (int round = 1; round <= 3; ++round) {
    const Descriptor writer(::open(path("fifo").c_str(), O_WRONLY | O_CLOEXEC));
    const std::string text = engine_header + rows(100 * round, 100 * round + 10);
    ASSERT_EQ(::write(writer.number(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ASSERT_TRUE(has(engine, 0, static_cast<std::uint64_t>(10 * round)));
  }
  write("file", "");
  EXPECT_THAT(refusal([&] {
                Engine other(site({{"p", PipeSettings{path("file")}}}), "test");
                other.start();
              }),
              HasSubstr("is no pipe; make it with mkfifo"));
}

// With what was sent while no program ran: its sequence numbers say how much that is.
TEST_F(EngineTest, CountsOfASourceGoOnAtEachStart) {
  SiteSettings kept = site({{"u", UdpSettings{}}});
  kept.store = path("kept.sqlite");
  for (std::uint64_t start = 0; start < 4; ++start) {
    Engine engine(kept, "test");
    EXPECT_EQ(engine.source(0).counters.lost, start == 0 ? 0 : 60 * start - 50) << start;
    engine.start();
    send_datagrams(engine, 100 * start, 20);
    ASSERT_TRUE(has(engine, 0, 40 * start + 20));
    send_datagrams(engine, 100 * start, 20);       // again
    send_datagrams(engine, 100 * start + 30, 20);  // ten are lost before them, and fifty behind them
    ASSERT_TRUE(has(engine, 0, 40 * start + 40));
    const IntakeCounters counters = engine.source(0).counters;
    EXPECT_EQ(counters.received, 40 * (start + 1));
    EXPECT_EQ(counters.lost, 60 * start + 10);
    EXPECT_EQ(counters.repeated, 20 * (start + 1));
    EXPECT_EQ(counters.connections, 1U);  // one session
  }
  const Engine again(kept, "test");
  EXPECT_EQ(again.source(0).counters.lost, 190U);
  EXPECT_EQ(again.source(0).counters.received, 160U);
  EXPECT_EQ(again.source(0).counters.connections, 1U);
}

// A kill leaves what was kept: a gap in front of samples that were not worked on is met again.
TEST_F(EngineTest, AGapIsCountedOnceThoughAKillComesBeforeItsSamplesAreKept) {
  Intake intake([] {});
  DatagramOrder order;
  ValveAtWork valve("u", model, "test");
  std::vector<SampleBlock> blocks;
  const auto came = [&](DatagramOrder& in, Intake& to, std::uint64_t sequence) {
    const std::vector<estimation::TimedSample> samples(10, {1e-3 * static_cast<double>(sequence), 1.5, 4.8, 1e-3, 323});
    to.push(in.next({"u", 7, sequence, samples}, to));
  };
  came(order, intake, 0);
  came(order, intake, 30);
  intake.take(blocks);
  for (const SampleBlock& block : blocks) valve.work(block);
  came(order, intake, 100);  // waits still
  const KeptState kept = valve.take_commit(false).state;
  EXPECT_EQ(kept.counts.lost, 20U);
  EXPECT_EQ(kept.counts.connections, 1U);

  Intake next_intake([] {});
  DatagramOrder next_order({kept.session, kept.next});
  ValveAtWork next("u", model, "test");
  ASSERT_TRUE(next.restore(kept));
  came(next_order, next_intake, 110);
  next_intake.take(blocks);
  for (const SampleBlock& block : blocks) next.work(block);
  EXPECT_EQ(next.take_commit(false).state.counts.lost, 90U);  // 20, and 40 to 109
}

// A sender that writes and leaves at once, as a script of echo lines does: each finds a reader, and no row is lost.
TEST_F(SendersTest, ReadsSendersThatFollowEachOtherAtOnce) {
  ASSERT_EQ(::mkfifo(path("fifo").c_str(), 0600), 0);
  Engine engine(site({{"p", PipeSettings{path("fifo")}}}), "test");
  engine.start();
  constexpr int senders = 200;
  for (int k = 0; k < senders; ++k) {
    const Descriptor writer(::open(path("fifo").c_str(), O_WRONLY | O_CLOEXEC));
    const std::string text = engine_header + rows(10 * k, 10 * k + 10);
    ASSERT_EQ(::write(writer.number(), text.data(), text.size()), static_cast<ssize_t>(text.size())) << k;
  }
  ASSERT_TRUE(has(engine, 0, 10 * senders));
  EXPECT_EQ(engine.view(0).samples, 10U * senders);  // no header was taken for a sample
  EXPECT_NEAR(engine.view(0).time_s, 0.001 * (10 * senders - 1), 1e-9);
}

TEST_F(SendersTest, AHeaderOfOtherColumnsInTheMiddleIsReportedAndNotMisread) {
  Engine engine(site({{"t", TcpSettings{{"127.0.0.1", 0}}}}), "test");
  engine.start();
  const Sender sender(engine.source(0).port);
  sender.send(engine_header + rows(0, 10));
  ASSERT_TRUE(has(engine, 0, 10));
  sender.send("time_s,voltage_V,current_A,position_mm,oil_temperature_C\n" + rows(10, 20));
  EXPECT_TRUE(comes_true([&] { return engine.source(0).trouble.find("in another order") != std::string::npos; }));
  EXPECT_EQ(engine.view(0).samples, 10U);
}

}  // namespace
}  // namespace spoolflow::live
