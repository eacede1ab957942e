/// `spoolflow live` under load: valves of the rig sent as datagrams from a process of their own, everything on (ingest,
/// observer, monitor, store, page with an open plot).
/// live_load SPOOLFLOW MODEL.json [VALVES=200] [SECONDS=20] [SAMPLES_PER_SECOND=1000]
#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <netinet/in.h>
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

#include "spoolflow/live/sources/datagram.hpp"
#include "spoolflow/live/sources/intake.hpp"
#include "spoolflow/live/sources/socket.hpp"
#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace {

using namespace spoolflow;
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

int connection_to(std::uint16_t port) {
  const int out = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(out, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) throw std::runtime_error("no page");
  return out;
}

void receive(int socket, char* out, std::size_t count) {
  while (count > 0) {
    const ssize_t got = ::recv(socket, out, count, 0);
    if (got <= 0) throw std::runtime_error("the page ended");
    out += got;
    count -= static_cast<std::size_t>(got);
  }
}

std::string header_of(int socket) {
  std::string header;
  for (char c = 0; !header.ends_with("\r\n\r\n"); header += c) receive(socket, &c, 1);
  return header;
}

nlohmann::json asked(std::uint16_t port, const std::string& target) {
  const int socket = connection_to(port);
  const std::string request = "GET " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  if (::send(socket, request.data(), request.size(), 0) < 0) throw std::runtime_error("no page");
  header_of(socket);
  std::string body;
  std::array<char, 65536> bytes;
  for (ssize_t got = 1; got > 0;) {
    got = ::recv(socket, bytes.data(), bytes.size(), 0);
    if (got > 0) body.append(bytes.data(), static_cast<std::size_t>(got));
  }
  ::close(socket);
  return nlohmann::json::parse(body);
}

/// For each message of a valve's plot the least and the largest time that its new samples waited since they had come.
struct Waits {
  std::vector<double> ms;
};

void follow_plot(std::uint16_t port, const std::string& valve, Waits& waits, const std::stop_token& stop) {
  const int socket = connection_to(port);
  const std::string request = "GET /api/v1/valves/" + valve +
                              "/stream HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                              "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  if (::send(socket, request.data(), request.size(), 0) < 0) throw std::runtime_error("no page");
  header_of(socket);
  std::int64_t before_ns = 0;
  std::vector<char> body;
  while (!stop.stop_requested()) {
    std::array<unsigned char, 2> head{};
    receive(socket, reinterpret_cast<char*>(head.data()), 2);
    std::size_t length = head[1] & 0x7FU;
    const int more = length == 126 ? 2 : length == 127 ? 8 : 0;
    if (more > 0) length = 0;
    for (int k = 0; k < more; ++k) {
      unsigned char byte = 0;
      receive(socket, reinterpret_cast<char*>(&byte), 1);
      length = length << 8U | byte;
    }
    body.resize(length);
    receive(socket, body.data(), length);
    std::int64_t arrived_ns = 0;
    if ((head[0] & 0x0FU) != 2 || length < 32) continue;
    std::memcpy(&arrived_ns, body.data() + 16, 8);
    const std::int64_t now_ns = live::steady_ns();
    if (before_ns != 0 && arrived_ns > before_ns) {
      constexpr int parts = 8;  // samples that came in between are spread evenly
      for (int k = 1; k <= parts; ++k) {
        const double came_ns = static_cast<double>(before_ns) + static_cast<double>(arrived_ns - before_ns) * k / parts;
        waits.ms.push_back(1e-6 * (static_cast<double>(now_ns) - came_ns));
      }
    }
    before_ns = arrived_ns;
  }
  ::close(socket);
}

/// Processor seconds and resident megabytes of a process.
struct Usage {
  double cpu_s, resident_MB;
};
Usage usage_of(pid_t process) {
  std::ifstream stat(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(stat, text);
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::vector<std::string> all;
  for (std::string field; fields >> field;) all.push_back(field);
  const double ticks = static_cast<double>(::sysconf(_SC_CLK_TCK));
  return {(std::stod(all.at(11)) + std::stod(all.at(12))) / ticks,
          1e-6 * std::stod(all.at(21)) * static_cast<double>(::sysconf(_SC_PAGESIZE))};
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

struct Sent {
  std::uint64_t samples = 0;
  double cpu_s = 0;
};

Sent send_all(const Child& child, int valves, double seconds, double rate_Hz) {
  const auto samples = course(rate_Hz);
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(child.udp);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const auto period_ns = static_cast<std::uint32_t>(1e9 / rate_Hz);
  const std::int64_t block_ns = std::int64_t{samples_a_block} * period_ns;
  const std::int64_t begin_ns = live::steady_ns() + 500'000'000;
  Sent sent;
  const std::clock_t cpu = std::clock();
  const auto blocks = static_cast<std::int64_t>(1e9 * seconds / static_cast<double>(block_ns));
  for (std::int64_t block = 0; block < blocks; ++block) {
    for (int valve = 0; valve < valves; ++valve) {
      // Valves send one after the other, spread over the time of a block.
      const std::int64_t due_ns = begin_ns + block * block_ns + block_ns * valve / valves;
      const std::int64_t ahead_ns = due_ns - live::steady_ns();
      if (ahead_ns > 200'000) std::this_thread::sleep_for(std::chrono::nanoseconds(ahead_ns));
      const auto sequence = static_cast<std::uint64_t>(block * samples_a_block);
      const std::size_t at = (sequence + 977U * samples_a_block * static_cast<std::size_t>(valve)) % samples.size();
      const auto bytes = live::write_datagram({.valve = fmt::format("v{}", valve),
                                               .session = 1,
                                               .sequence = sequence,
                                               .time_ns = block * block_ns,
                                               .period_ns = period_ns,
                                               .channels = 0x000F},
                                              std::span(samples).subspan(at, samples_a_block));
      if (::sendto(socket, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to) > 0) {
        sent.samples += samples_a_block;
      }
    }
  }
  sent.cpu_s = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  ::close(socket);
  return sent;
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
      "  spoolflow live took {:.2f} cores ({:.2f} us a sample), {:.0f} MB resident; the sender {:.2f} cores\n",
      valves, seconds, sent.samples, worked, dropped, lost, share(0.5), share(0.99), share(1.0), used.cpu_s / seconds,
      1e6 * used.cpu_s / static_cast<double>(std::max<std::uint64_t>(1, worked)), used.resident_MB,
      sent.cpu_s / seconds);
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
    Waits waits;
    std::jthread page([&](const std::stop_token& stop) {
      try {
        follow_plot(child.page, fmt::format("v{}", valves / 2), waits, stop);
      } catch (const std::exception&) {  // the child was ended
      }
    });
    const Usage before = usage_of(child.process);
    const Sent sent = send_all(child, valves, seconds, rate_Hz);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const Usage after = usage_of(child.process);
    page.request_stop();
    page.join();
    report(child, valves, seconds, sent, {after.cpu_s - before.cpu_s, after.resident_MB}, waits.ms);
    ::kill(child.process, SIGTERM);
    ::waitpid(child.process, nullptr, 0);
    fmt::print("  the store holds {:.2f} MB\n", 1e-6 * static_cast<double>(fs::file_size(folder / "s.sqlite")));
    fs::remove_all(folder);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "live_load: {}\n", error.what());
    return 1;
  }
}
