/// A site with real senders over loopback; every port is chosen by the system.
#include "spoolflow/live/engine.hpp"

#include <arpa/inet.h>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/live/demo_model.hpp"
#include "tests/live/temporary_folder.hpp"

namespace spoolflow::live {
namespace {

using ::testing::HasSubstr;

/// Waits until it is so, at most half a minute; false where it never was.
template <class Condition>
bool comes_true(Condition&& condition) {
  for (int k = 0; k < 6000; ++k) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_port = htons(port);
  out.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return out;
}

/// A TCP sender.
class Sender {
 public:
  explicit Sender(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in to = loopback(port);
    EXPECT_EQ(::connect(socket_.number(), reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  }
  void send(const std::string& text) const {
    EXPECT_EQ(::send(socket_.number(), text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }

 private:
  Descriptor socket_;
};

constexpr const char* engine_header = "time_s,current_A,voltage_V,position_mm,oil_temperature_C\n";

std::string rows(int from, int to) {
  std::string out;
  for (int k = from; k < to; ++k) out += fmt::format("{:.3f},1.500,4.8,1.000,50\n", 0.001 * k);
  return out;
}

class EngineTest : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    const EmbeddedFile& file = demo_model().front();
    static const auto shared =
        std::make_shared<const model::Model>(model::parse_model(std::string(file.bytes), std::string(file.name)));
    model = {shared, "sha"};
  }
  [[nodiscard]] SiteSettings site(std::vector<std::pair<std::string, SourceSettings>> sources) const {
    SiteSettings out;
    for (auto& [id, source] : sources) out.valves.push_back({id, model, source});
    out.udp = Address{"127.0.0.1", 0};
    return out;
  }
  static bool has(const Engine& engine, std::size_t valve, std::uint64_t samples) {
    return comes_true([&] { return engine.view(valve).samples >= samples; });
  }
  void send_datagrams(const Engine& engine, std::uint64_t sequence, int samples, std::uint32_t session = 7) const {
    std::vector<estimation::TimedSample> block(static_cast<std::size_t>(samples), {0, 1.5, 4.8, 1e-3, 323.15});
    const auto bytes = write_datagram(
        {"u", session, sequence, static_cast<std::int64_t>(sequence) * 1'000'000, 1'000'000, 0x000F}, block);
    send_bytes(engine, bytes);
  }
  static void send_bytes(const Engine& engine, const std::vector<std::uint8_t>& bytes) {
    const Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const sockaddr_in to = loopback(engine.udp_port());
    ASSERT_EQ(
        ::sendto(socket.number(), bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to),
        static_cast<ssize_t>(bytes.size()));
  }
  SharedModel model;
};

TEST_F(EngineTest, AnswersWhatComesByTcp) {
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

TEST_F(EngineTest, OneSourceOfRubbishDisturbsNoOther) {
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

TEST_F(EngineTest, AnswersDatagramsAndCountsWhatIsNone) {
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

TEST_F(EngineTest, ReadsAPipeAgainAndAgain) {
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

// A sender that writes and leaves at once, as a script of echo lines does: each finds a reader, and no row is lost.
TEST_F(EngineTest, ReadsSendersThatFollowEachOtherAtOnce) {
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

TEST_F(EngineTest, AHeaderOfOtherColumnsInTheMiddleIsToldAndNotMisread) {
  Engine engine(site({{"t", TcpSettings{{"127.0.0.1", 0}}}}), "test");
  engine.start();
  const Sender sender(engine.source(0).port);
  sender.send(engine_header + rows(0, 10));
  ASSERT_TRUE(has(engine, 0, 10));
  sender.send("time_s,voltage_V,current_A,position_mm,oil_temperature_C\n" + rows(10, 20));
  EXPECT_TRUE(comes_true([&] { return engine.source(0).trouble.find("in another order") != std::string::npos; }));
  EXPECT_EQ(engine.view(0).samples, 10U);
}

TEST_F(EngineTest, GoesOnWhereItWas) {
  write("run.csv", engine_header + rows(0, 5000));
  const SourceSettings replay = ReplaySettings{path("run.csv"), 0};
  double energy_J = 0;
  {
    Engine whole(site({{"r", replay}}), "test");
    whole.start();
    ASSERT_TRUE(has(whole, 0, 5000));
    energy_J = whole.view(0).energy_J;
    EXPECT_EQ(whole.source(0).trouble, "the recording has ended");
  }
  write("half.csv", engine_header + rows(0, 2000));
  SiteSettings kept = site({{"r", ReplaySettings{path("half.csv"), 0}}});
  kept.store = path("kept.sqlite");
  double half_J = 0;
  {
    Engine first(kept, "test");
    first.start();
    ASSERT_TRUE(has(first, 0, 2000));
    half_J = first.view(0).energy_J;
  }
  kept.valves[0].source = replay;  // the longer recording begins with what was worked on before
  Engine second(kept, "test");
  EXPECT_EQ(second.view(0).samples, 2000U);
  EXPECT_EQ(second.view(0).energy_J, half_J);
  second.start();
  ASSERT_TRUE(comes_true([&] { return second.source(0).trouble == "the recording has ended"; }));
  ASSERT_TRUE(has(second, 0, 5000));
  EXPECT_EQ(second.view(0).samples, 5000U);
  EXPECT_EQ(second.view(0).energy_J, energy_J);  // to the last digit
}

// Sensor, monitor, doubt, and the time behind which energy counts on: all that matters is kept.
TEST_F(EngineTest, AValveThatIsTakenUpAgainAnswersAsIfItHadNeverStopped) {
  const auto course = [](std::uint64_t begin, std::size_t count) {
    SampleBlock block{.after = {0, begin + count}, .arrived_ns = 1};
    for (std::size_t k = 0; k < count; ++k) {
      const double t = 0.001 * static_cast<double>(begin + k);
      const double place = std::sin(3 * t) + 0.2 * std::sin(41 * t);
      block.samples.push_back({t, 1.2 + 0.3 * place, 4.8 + place, 1e-3 + 4e-4 * place, 323.15});
    }
    return block;
  };
  ValveAtWork whole("v", model, "test");
  auto resumed = std::make_unique<ValveAtWork>("v", model, "test");
  std::int64_t samples = 0;
  for (std::uint64_t begin = 0; begin < 20'000;) {
    const std::size_t count = 1 + begin * 7919 % 900;
    whole.work(course(begin, count));
    resumed->work(course(begin, count));
    begin += count;
    const ValveCommit kept = resumed->take_commit(false);
    samples += kept.since_last.samples;
    resumed = std::make_unique<ValveAtWork>("v", model, "test");
    ASSERT_TRUE(resumed->restore(kept.state));
  }
  const ValveCommit expected = whole.take_commit(false), got = resumed->take_commit(false);
  EXPECT_EQ(got.state.bytes, expected.state.bytes);
  EXPECT_EQ(got.state.energy_J, expected.state.energy_J);
  EXPECT_EQ(got.state.next, expected.state.next);
  EXPECT_EQ(samples, expected.since_last.samples);
  EXPECT_GT(expected.state.energy_J, 0);
}

TEST_F(EngineTest, AValveWhoseKeptStateIsDamagedBeginsAnewAndCountsOn) {
  ValveAtWork before("v", model, "test");
  ValveCommit kept = before.take_commit(false);
  kept.state.samples = 7;
  EXPECT_TRUE(ValveAtWork("v", model, "test").restore(kept.state));
  for (const std::size_t at : {std::size_t{0}, kept.state.bytes.size() / 2, kept.state.bytes.size() - 1}) {
    KeptState damaged = kept.state;
    damaged.bytes[at] ^= std::byte{0x80};
    ValveAtWork again("v", model, "test");
    EXPECT_FALSE(again.restore(damaged)) << "byte " << at;
    EXPECT_EQ(again.view(false).samples, 7U);
  }
}

TEST_F(EngineTest, AnotherModelBeginsAnewAndCountsOn) {
  write("run.csv", engine_header + rows(0, 100));
  SiteSettings kept = site({{"r", ReplaySettings{path("run.csv"), 0}}});
  kept.store = path("kept.sqlite");
  {
    Engine first(kept, "test");
    first.start();
    ASSERT_TRUE(has(first, 0, 100));
  }
  kept.valves[0].model.sha256 = "another";
  const Engine second(kept, "test");
  EXPECT_EQ(second.view(0).samples, 100U);
  ASSERT_FALSE(second.events().empty());
  EXPECT_THAT(second.events().back().text, HasSubstr("begin anew"));
}

// A file that may not grow stands for the full disk.
TEST_F(EngineTest, AFullDiskStopsKeepingNotWatching) {
  SiteSettings kept = site({{"t", TcpSettings{{"127.0.0.1", 0}}}});
  kept.store = path("kept.sqlite");
  Engine engine(kept, "test");
  engine.start();
  const Sender sender(engine.source(0).port);
  sender.send(engine_header + rows(0, 100));
  ASSERT_TRUE(has(engine, 0, 100));
  const auto before = ::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit no_more{4096, limit.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &no_more);
  sender.send(rows(100, 200));
  const bool told = comes_true([&] { return !engine.store_view().trouble.empty(); });
  sender.send(rows(200, 300));
  const bool watched = has(engine, 0, 300);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, before);
  EXPECT_TRUE(told);
  EXPECT_TRUE(watched);
  EXPECT_TRUE(comes_true([&] { return engine.store_view().trouble.empty(); }));
  engine.stop();
  std::int64_t samples = 0;
  read_history(kept.store, "t", 0, std::int64_t{1} << 60,
               [&](const HistoryRow& row) { samples += row.summary.samples; });
  EXPECT_EQ(samples, 300);
}

TEST_F(EngineTest, WhatIsTooOldIsDeletedWhileItRuns) {
  SiteSettings kept = site({{"t", TcpSettings{{"127.0.0.1", 0}}}});
  kept.store = path("kept.sqlite");
  kept.retention.days = 1;
  {
    Store store(kept.store);
    std::vector<Event> none;
    store.commit(1000, {{.state = {.valve = "t", .layout = "old"}, .since_last = {.samples = 7}, .indicators = {}}},
                 none);
  }
  const auto samples = [&] {
    std::int64_t out = 0;
    read_history(kept.store, "t", 0, std::int64_t{1} << 60, [&](const HistoryRow& row) { out += row.summary.samples; });
    return out;
  };
  ASSERT_EQ(samples(), 7);
  Engine engine(kept, "test");
  engine.start();
  const Sender sender(engine.source(0).port);
  sender.send(engine_header + rows(0, 100));
  EXPECT_TRUE(comes_true([&] { return samples() == 100; }));  // those of 1970 are gone
}

TEST_F(EngineTest, ARigValveWorks) {
  const RigSettings rig{.valve = rig::valve_preset("size_6"), .seed = 3, .speed = 20};
  Engine engine(site({{"v", rig}}), "test");
  engine.start();
  ASSERT_TRUE(has(engine, 0, 3000));
  EXPECT_TRUE(std::isfinite(engine.view(0).answer.flow_m3_per_s));
  EXPECT_FALSE(engine.view(0).indicators.empty());
}

TEST_F(EngineTest, APlotKeepsEveryPeak) {
  PlotTrace trace;
  sensor::Estimate<double> answer{};
  for (int k = 0; k < 100000; ++k) {
    answer.flow_m3_per_s = k == 99950 ? 9 : 1;
    trace.add(0.001 * k, 1e-3, 1, answer);
  }
  std::vector<PlotPoint> points;
  EXPECT_EQ(trace.copy_from(0, points), trace.size() - plot_points);
  float largest = 0;
  for (const PlotPoint& point : points) largest = std::max(largest, point.flow_max_m3_per_s);
  EXPECT_EQ(largest, 9);
  EXPECT_EQ(trace.size(), 5000U);
}

}  // namespace
}  // namespace spoolflow::live
