#pragma once
/// Who sends.
#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cstring>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <vector>

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

/// Whether it is in the list; an empty list holds everybody.
inline bool may_send(const std::vector<std::string>& allowed, const sockaddr_storage& peer) {
  return allowed.empty() || std::find(allowed.begin(), allowed.end(), peer_host(peer)) != allowed.end();
}

}  // namespace spoolflow::live
