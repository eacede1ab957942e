#pragma once
/// Who sends.
#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cstddef>
#include <cstring>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <vector>

#include "addons/live/sources/socket.hpp"

namespace spoolflow::live {

/// The numeric address of the other side.
inline std::string peer_host(const sockaddr_storage& peer) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (peer.ss_family == AF_INET6) {
    sockaddr_in6 in{};
    std::memcpy(&in, &peer, sizeof in);
    ::inet_ntop(AF_INET6, &in.sin6_addr, text.data(), text.size());
  } else {
    sockaddr_in in{};
    std::memcpy(&in, &peer, sizeof in);
    ::inet_ntop(AF_INET, &in.sin_addr, text.data(), text.size());
  }
  return text.data();
}

/// The same with its port.
inline Address peer_address(const sockaddr_storage& peer) {
  in_port_t port = 0;  // at the same place of both kinds
  std::memcpy(&port, reinterpret_cast<const char*>(&peer) + offsetof(sockaddr_in, sin_port), sizeof port);
  return {peer_host(peer), ntohs(port)};
}

/// Whether it is in the list; an empty list holds everybody.
inline bool may_send(const std::vector<std::string>& allowed, const sockaddr_storage& peer) {
  return allowed.empty() || std::find(allowed.begin(), allowed.end(), peer_host(peer)) != allowed.end();
}

}  // namespace spoolflow::live
