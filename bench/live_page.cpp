#include "bench/live_page.hpp"

#include <arpa/inet.h>
#include <array>
#include <cstring>
#include <netinet/in.h>
#include <stdexcept>
#include <sys/socket.h>
#include <unistd.h>

#include "addons/live/sources/intake.hpp"

namespace spoolflow::bench {
namespace {

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

}  // namespace

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

}  // namespace spoolflow::bench
