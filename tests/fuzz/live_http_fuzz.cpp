/// Requests and WebSocket messages to the page of `spoolflow live`, over loopback. The first byte says how the rest is
/// sent: as it is, as the target of a request, or as messages behind an opened WebSocket.
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>

#include "addons/live/http/server.hpp"
#include "addons/live/page/answer.hpp"
#include "tests/fuzz/live_valve.hpp"

namespace {

using namespace spoolflow;

/// The site that everybody asks.
struct Server {
  live::Engine engine;
  live::PageServer page;
  static live::SiteSettings site() {
    live::SiteSettings out;
    out.valves.push_back({"a", fuzz::live_model(), live::UdpSettings{}});
    out.udp = live::Address{"127.0.0.1", 0};
    return out;
  }
  Server() : engine(site(), "fuzz"), page(site_page(engine), {.listen = {"127.0.0.1", 0}}) { engine.start(); }
};

/// Sends it, ends its side and waits until the server has ended, too; returns how much came.
std::size_t answered(std::uint16_t port, const std::string& bytes) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  // Closed at once, so that thousands of connections leave no ports behind.
  const linger at_once{1, 0};
  ::setsockopt(socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  fuzz::require(::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0);
  (void)::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  ::shutdown(socket, SHUT_WR);
  std::size_t all = 0;
  std::array<char, 65536> room;
  for (;;) {
    const ssize_t got = ::recv(socket, room.data(), room.size(), 0);
    if (got < 0 && errno == EINTR) continue;  // the fuzzer's alarm
    if (got <= 0) break;
    all += static_cast<std::size_t>(got);
  }
  ::close(socket);
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Server server;
  if (size == 0) return 0;
  const std::string rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::uint16_t port = server.page.port();
  switch (data[0]) {
    case 'r':
      (void)answered(port, rest);
      break;
    case 't':
      (void)answered(port, "GET " + rest + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
      break;
    case 'w':
      (void)answered(port,
                     "GET /api/v1/valves/a/stream HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: "
                     "websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n" +
                         rest);
      break;
    default:
      return 0;
  }
  // Whatever was sent, the next visitor is served.
  fuzz::require(answered(port, "GET /api/v1/site HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n") > 200);
  return 0;
}
