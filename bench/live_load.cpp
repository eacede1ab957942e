/// `spoolflow live` under load: valves of the rig sent as datagrams from a process of their own, everything on (ingest,
/// observer, monitor, store, page with an open plot). At the end it is killed and started again.
/// live_load SPOOLFLOW MODEL.json [VALVES=200] [SECONDS=20] [SAMPLES_PER_SECOND=1000]
/// Above two minutes it says where the page is, and there is a line a minute: what would grow or drift shows.
#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <netinet/in.h>
#include <netinet/udp.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "addons/live/sources/datagram.hpp"
#include "addons/live/sources/intake.hpp"
#include "addons/live/sources/socket.hpp"
#include "bench/live_page.hpp"
#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace {

using namespace spoolflow;
using bench::asked;
namespace fs = std::filesystem;

constexpr int samples_a_block = 20;

/// What the valves send, over and over, each from another place on.
std::vector<estimation::TimedSample> course(double rate_Hz) {
  const rig::ValveUnderTest valve = rig::as_built(rig::valve_preset("size_6"));
  rig::DutyCycleProtocol duty;
  duty.conditions.sample_rate_Hz = rate_Hz;
  duty.duration_s = 60;
  duty.lowest_percent = 0;
  std::vector<estimation::TimedSample> out;
  rig::SimulationOptions options;
  options.keeps_recording = false;
  options.each_sample = [&](const rig::MeasuredSample& in) {
    out.push_back({in.time_s, in.current_A, in.voltage_V, in.position_m, in.oil_temperature_K});
  };
  (void)rig::simulate(valve, rig::plan(rig::Protocol(duty), valve, 1), 1, options);
  out.resize(out.size() / samples_a_block * samples_a_block);
  return out;
}

/// What a process has used so far.
struct Usage {
  double cpu_s, resident_MB, written_MB;
};
Usage usage_of(pid_t process) {
  std::ifstream stat(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(stat, text);
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::vector<std::string> all;
  for (std::string field; fields >> field;) all.push_back(field);
  const double ticks = static_cast<double>(::sysconf(_SC_CLK_TCK));
  std::ifstream io(fmt::format("/proc/{}/io", process));
  double written = 0;
  for (std::string key; io >> key >> text;) {
    if (key == "write_bytes:") written = std::stod(text);  // to the disk; the folder must not lie in memory
  }
  return {(std::stod(all.at(11)) + std::stod(all.at(12))) / ticks,
          1e-6 * std::stod(all.at(21)) * static_cast<double>(::sysconf(_SC_PAGESIZE)), 1e-6 * written};
}

/// Mean number of programs that wanted a core in the last minute.
double load_average() {
  double out = 0;
  std::ifstream("/proc/loadavg") >> out;
  return out;
}

/// The program as a child, and the port of its page.
struct Child {
  pid_t process;
  std::uint16_t page, udp;
};
Child started(const char* spoolflow, const fs::path& folder) {
  std::array<int, 2> said{};
  if (::pipe(said.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t process = ::fork();
  if (process == 0) {
    ::dup2(said[1], STDERR_FILENO);
    ::execl(spoolflow, "spoolflow", "live", (folder / "site.toml").c_str(), "--store", (folder / "s.sqlite").c_str(),
            static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(said[1]);
  std::string text;
  std::array<char, 4096> bytes;
  while (text.find("end with Ctrl-C") == std::string::npos) {
    const ssize_t got = ::read(said[0], bytes.data(), bytes.size());
    if (got <= 0) throw std::runtime_error("spoolflow live did not begin: " + text);
    text.append(bytes.data(), static_cast<std::size_t>(got));
  }
  const auto port = [&](const std::string& before) {
    return static_cast<std::uint16_t>(std::stoi(text.substr(text.find(before) + before.size())));
  };
  return {process, port("http://127.0.0.1:"), port("UDP at 127.0.0.1:")};
}

/// Datagrams of one length that are due. They go out together, in one call of the system, which stands for as many
/// machines.
class DueDatagrams {
 public:
  DueDatagrams(int socket, const sockaddr_in& to) : socket_(socket), to_(to) {}

  void add(const std::vector<std::uint8_t>& datagram) {
    length_ = datagram.size();
    bytes_.insert(bytes_.end(), datagram.begin(), datagram.end());
    if (bytes_.size() == most_together * length_) send();
  }
  void send() {
    if (bytes_.empty()) return;
    iovec part{bytes_.data(), bytes_.size()};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(std::uint16_t))> control{};
    msghdr message{};
    message.msg_name = &to_;
    message.msg_namelen = sizeof to_;
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    cmsghdr* const segments = CMSG_FIRSTHDR(&message);
    *segments = {.cmsg_len = CMSG_LEN(sizeof(std::uint16_t)), .cmsg_level = SOL_UDP, .cmsg_type = UDP_SEGMENT};
    const auto length = static_cast<std::uint16_t>(length_);
    std::memcpy(CMSG_DATA(segments), &length, sizeof length);
    if (::sendmsg(socket_, &message, 0) > 0) sent_ += bytes_.size() / length_;
    bytes_.clear();
  }
  [[nodiscard]] std::uint64_t sent() const { return sent_; }

 private:
  static constexpr std::size_t most_together = 50;  // of the 64 KiB that go out together
  int socket_;
  sockaddr_in to_;
  std::size_t length_ = 0;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t sent_ = 0;
};

struct Sent {
  std::uint64_t samples = 0;
  double cpu_s = 0;
};

Sent send_all(const Child& child, int valves, double seconds, double rate_Hz, std::atomic<std::int64_t>& began_ns) {
  const auto samples = course(rate_Hz);
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(child.udp);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const auto period_ns = static_cast<std::uint32_t>(1e9 / rate_Hz);
  const std::int64_t block_ns = std::int64_t{samples_a_block} * period_ns;
  const std::int64_t begin_ns = live::steady_ns() + 500'000'000;
  began_ns = begin_ns;
  DueDatagrams datagrams(socket, to);
  const std::clock_t cpu = std::clock();
  const auto blocks = static_cast<std::int64_t>(1e9 * seconds / static_cast<double>(block_ns));
  for (std::int64_t block = 0; block < blocks; ++block) {
    for (int valve = 0; valve < valves; ++valve) {
      // Valves send one after the other, spread over the time of a block.
      const std::int64_t due_ns = begin_ns + block * block_ns + block_ns * valve / valves;
      const std::int64_t ahead_ns = due_ns - live::steady_ns();
      if (ahead_ns > 200'000) {
        datagrams.send();
        std::this_thread::sleep_for(std::chrono::nanoseconds(ahead_ns));
      }
      const auto sequence = static_cast<std::uint64_t>(block * samples_a_block);
      const std::size_t at = (sequence + 977U * samples_a_block * static_cast<std::size_t>(valve)) % samples.size();
      datagrams.add(live::write_datagram({.valve = fmt::format("v{}", valve),
                                          .session = 1,
                                          .sequence = sequence,
                                          .time_ns = block * block_ns,
                                          .period_ns = period_ns,
                                          .channels = 0x000F},
                                         std::span(samples).subspan(at, samples_a_block)));
    }
  }
  datagrams.send();
  ::close(socket);
  return {datagrams.sent() * samples_a_block, static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
}

/// A line a minute: memory, writes, and how far the newest answers are behind the clock of the sender, which is that of
/// this process.
void print_each_minute(const Child& child, const fs::path& store, const std::atomic<std::int64_t>& began_ns,
                       const std::stop_token& stop) {
  double written_MB = usage_of(child.process).written_MB;
  for (int second = 1; !stop.stop_requested(); ++second) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    if (second % 60 != 0 || stop.stop_requested()) continue;
    const auto all = asked(child.page, "/api/v1/valves")["valves"];
    const double clock_s = 1e-9 * static_cast<double>(live::steady_ns() - began_ns);
    std::vector<double> behind_ms;
    std::uint64_t missed = 0;
    for (const auto& valve : all) {
      behind_ms.push_back(1e3 * (clock_s - valve["time_s"].get<double>()));
      missed += valve["source"]["dropped"].get<std::uint64_t>() + valve["source"]["lost"].get<std::uint64_t>();
    }
    std::sort(behind_ms.begin(), behind_ms.end());
    const Usage now = usage_of(child.process);
    fmt::print(
        "  {:5.0f} s: {:.1f} MB resident, {:.2f} MB/s written, store {:.1f} MB, {} lost, answers behind the clock: "
        "median "
        "{:.0f} ms, largest {:.0f} ms; load average {:.1f}\n",
        clock_s, now.resident_MB, (now.written_MB - written_MB) / 60, 1e-6 * static_cast<double>(fs::file_size(store)),
        missed, behind_ms[behind_ms.size() / 2], behind_ms.back(), load_average());
    std::fflush(stdout);
    written_MB = now.written_MB;
  }
}

void report(const Child& child, int valves, double seconds, const Sent& sent, const Usage& used,
            std::vector<double> ms) {
  const auto all = asked(child.page, "/api/v1/valves")["valves"];
  std::uint64_t worked = 0, dropped = 0, lost = 0;
  for (const auto& valve : all) {
    worked += valve["samples"].get<std::uint64_t>();
    dropped += valve["source"]["dropped"].get<std::uint64_t>();
    lost += valve["source"]["lost"].get<std::uint64_t>();
  }
  std::sort(ms.begin(), ms.end());
  const auto share = [&](double part) {
    return ms.empty() ? 0.0 : ms[static_cast<std::size_t>(part * static_cast<double>(ms.size() - 1))];
  };
  fmt::print(
      "{} valves, {:.0f} s: {} samples sent, {} worked on, {} dropped, {} lost on the way\n"
      "  from a sample's arrival to its answer on the WebSocket: median {:.1f} ms, 99 % {:.1f} ms, largest {:.1f} ms\n"
      "  spoolflow live took {:.2f} cores ({:.2f} us a sample), {:.0f} MB resident; the sender {:.2f} cores\n"
      "  written to the disk: {:.3f} MB/s, {:.2f} kB a valve and second; load average {:.1f}\n",
      valves, seconds, sent.samples, worked, dropped, lost, share(0.5), share(0.99), share(1.0), used.cpu_s / seconds,
      1e6 * used.cpu_s / static_cast<double>(std::max<std::uint64_t>(1, worked)), used.resident_MB,
      sent.cpu_s / seconds, used.written_MB / seconds, 1e3 * used.written_MB / seconds / valves, load_average());
}

void end(const Child& child, int signal) {
  ::kill(child.process, signal);
  ::waitpid(child.process, nullptr, 0);
}

/// Killed at an instant of its own choosing; what a start takes then.
Child killed_and_back(const Child& child, const char* spoolflow, const fs::path& folder) {
  end(child, SIGKILL);
  const std::int64_t begin_ns = live::steady_ns();
  const Child out = started(spoolflow, folder);
  fmt::print("  after kill -9 it was back in {:.2f} s", 1e-9 * static_cast<double>(live::steady_ns() - begin_ns));
  std::uint64_t samples = 0;
  const auto all = asked(out.page, "/api/v1/valves")["valves"];
  for (const auto& valve : all) samples += valve["samples"].get<std::uint64_t>();
  fmt::print(" with {} samples\n", samples);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 3)
      throw std::runtime_error("usage: live_load SPOOLFLOW MODEL.json [VALVES] [SECONDS] [SAMPLES_PER_SECOND]");
    const int valves = argc > 3 ? std::atoi(argv[3]) : 200;
    const double seconds = argc > 4 ? std::atof(argv[4]) : 20;
    const double rate_Hz = argc > 5 ? std::atof(argv[5]) : 1000;
    std::string name = (fs::temp_directory_path() / "spoolflow-load-XXXXXX").string();
    const fs::path folder = ::mkdtemp(name.data());
    {
      std::ofstream site(folder / "site.toml");
      site << "[page]\nlisten = \"127.0.0.1:0\"\n[sources]\nudp = \"127.0.0.1:0\"\n";
      for (int k = 0; k < valves; ++k) {
        site << fmt::format("[[valve]]\nid = \"v{}\"\nmodel = \"{}\"\nsource = {{ kind = \"udp\" }}\n", k,
                            fs::absolute(argv[2]).string());
      }
    }
    const Child child = started(argv[1], folder);
    bench::Waits waits;
    std::atomic<std::int64_t> began_ns = live::steady_ns();
    std::jthread page([&](const std::stop_token& stop) {
      try {
        bench::follow_plot(child.page, fmt::format("v{}", valves / 2), waits, stop);
      } catch (const std::exception&) {  // the child was ended
      }
    });
    fmt::print("page at http://127.0.0.1:{}\n", child.page);
    std::fflush(stdout);
    std::jthread teller;
    if (seconds > 120) {
      teller = std::jthread(
          [&](const std::stop_token& stop) { print_each_minute(child, folder / "s.sqlite", began_ns, stop); });
    }
    const Usage before = usage_of(child.process);
    const Sent sent = send_all(child, valves, seconds, rate_Hz, began_ns);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const Usage after = usage_of(child.process);
    teller = {};
    page.request_stop();
    page.join();
    report(child, valves, seconds, sent,
           {after.cpu_s - before.cpu_s, after.resident_MB, after.written_MB - before.written_MB}, waits.ms);
    end(killed_and_back(child, argv[1], folder), SIGTERM);
    fmt::print("  the store holds {:.2f} MB\n", 1e-6 * static_cast<double>(fs::file_size(folder / "s.sqlite")));
    fs::remove_all(folder);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "live_load: {}\n", error.what());
    return 1;
  }
}
