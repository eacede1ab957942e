#include "addons/live/sources/socket.hpp"

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <netinet/in.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

namespace spoolflow::live {
namespace {

struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t length = 0;
};

bool is_6(const std::string& host) {
  return host.find(':') != std::string::npos;
}

SocketAddress system_address(const Address& address) {
  SocketAddress out;
  if (is_6(address.host)) {
    sockaddr_in6 in{};
    in.sin6_family = AF_INET6;
    in.sin6_port = htons(address.port);
    ::inet_pton(AF_INET6, address.host.c_str(), &in.sin6_addr);
    std::memcpy(&out.storage, &in, sizeof in);
    out.length = sizeof in;
  } else {
    sockaddr_in in{};
    in.sin_family = AF_INET;
    in.sin_port = htons(address.port);
    ::inet_pton(AF_INET, address.host.c_str(), &in.sin_addr);
    std::memcpy(&out.storage, &in, sizeof in);
    out.length = sizeof in;
  }
  return out;
}

std::uint16_t port_of(int socket) {
  sockaddr_storage storage{};
  socklen_t length = sizeof storage;
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&storage), &length);
  in_port_t port = 0;
  if (storage.ss_family == AF_INET6) {
    sockaddr_in6 in{};
    std::memcpy(&in, &storage, sizeof in);
    port = in.sin6_port;
  } else {
    sockaddr_in in{};
    std::memcpy(&in, &storage, sizeof in);
    port = in.sin_port;
  }
  return ntohs(port);
}

}  // namespace

bool Address::is_loopback() const {
  return host.starts_with("127.") || host == "::1";
}

std::string Address::text() const {
  return is_6(host) ? fmt::format("[{}]:{}", host, port) : fmt::format("{}:{}", host, port);
}

Address read_address(const std::string& text, const std::string& place) {
  const std::size_t colon = text.rfind(':');
  Address out;
  out.host = text.substr(0, colon);
  if (out.host.starts_with('[') && out.host.ends_with(']')) {
    out.host = out.host.substr(1, out.host.size() - 2);
  } else if (is_6(out.host)) {
    out.host.clear();  // of which colon is the port's?
  }
  if (out.host == "localhost") out.host = "127.0.0.1";
  in6_addr ignored{};
  const bool numeric = ::inet_pton(is_6(out.host) ? AF_INET6 : AF_INET, out.host.c_str(), &ignored) == 1;
  const char* const begin = text.data() + (colon == std::string::npos ? text.size() : colon + 1);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, out.port);
  if (!numeric || begin == end || error != std::errc() || stop != end) {
    throw SiteError(fmt::format(
        "{}: '{}' is no address with a port; write it as 127.0.0.1:8080 or [::1]:8080, with port 0 to let the system "
        "choose one",
        place, text));
  }
  return out;
}

std::string read_host(const std::string& text, const std::string& place) {
  const int family = is_6(text) ? AF_INET6 : AF_INET;
  in6_addr host{};
  std::array<char, INET6_ADDRSTRLEN> written{};
  if (::inet_pton(family, text.c_str(), &host) == 1 &&
      ::inet_ntop(family, &host, written.data(), written.size()) != nullptr) {
    return written.data();
  }
  throw SiteError(fmt::format(
      "{}: '{}' is no machine's address; write each one's by its numbers, such as \"192.168.0.7\" or \"fd00::7\" "
      "(no names, no networks)",
      place, text));
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

BoundSocket bind_socket(const Address& address, Transport transport) {
  const int family = is_6(address.host) ? AF_INET6 : AF_INET;
  const bool tcp = transport == Transport::tcp;
  Descriptor socket(::socket(family, (tcp ? SOCK_STREAM : SOCK_DGRAM) | SOCK_CLOEXEC, 0));
  const int on = 1;
  if (tcp) ::setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const int room = 64 << 20;  // as much of it as the system grants
  if (!tcp && ::setsockopt(socket.number(), SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room) != 0) {
    ::setsockopt(socket.number(), SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
  }
  const SocketAddress where = system_address(address);
  if (socket.number() < 0 ||
      ::bind(socket.number(), reinterpret_cast<const sockaddr*>(&where.storage), where.length) != 0 ||
      (tcp && ::listen(socket.number(), SOMAXCONN) != 0)) {
    const int error = errno;
    throw SiteError(fmt::format("cannot listen at {}: {}; {}", address.text(), std::generic_category().message(error),
                                error == EADDRINUSE ? "end the program that listens there or choose another port"
                                : error == EACCES   ? "choose a port above 1023"
                                                    : "choose an address of this machine, such as 127.0.0.1"));
  }
  const std::uint16_t port = port_of(socket.number());
  return {std::move(socket), port};
}

}  // namespace spoolflow::live
