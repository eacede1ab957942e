#pragma once
/// A site whose senders are real ones over loopback; every port is chosen by the system.
#include <arpa/inet.h>
#include <chrono>
#include <memory>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "addons/live/demo_model.hpp"
#include "addons/live/engine.hpp"
#include "addons/live/tests/temporary_folder.hpp"

namespace spoolflow::live {

/// Waits until it is so, at most half a minute; false where it never was.
template <class Condition>
bool comes_true(Condition&& condition) {
  for (int k = 0; k < 6000; ++k) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

inline sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_port = htons(port);
  out.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return out;
}

/// A TCP sender.
class Sender {
 public:
  /// `host`: from which address of the loopback network it sends, 127.0.0.`host`.
  explicit Sender(std::uint16_t port, int host = 1) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in from = loopback(0);
    from.sin_addr.s_addr = htonl(INADDR_LOOPBACK - 1 + static_cast<in_addr_t>(host));
    EXPECT_EQ(::bind(socket_.number(), reinterpret_cast<const sockaddr*>(&from), sizeof from), 0);
    const sockaddr_in to = loopback(port);
    EXPECT_EQ(::connect(socket_.number(), reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  }
  void send(const std::string& text) const {
    EXPECT_EQ(::send(socket_.number(), text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }

 private:
  Descriptor socket_;
};

inline constexpr const char* engine_header = "time_s,current_A,voltage_V,position_mm,oil_temperature_C\n";

inline std::string rows(int from, int to) {
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

}  // namespace spoolflow::live
