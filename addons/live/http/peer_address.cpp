#include "addons/live/http/peer_address.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <netinet/in.h>

namespace spoolflow::live {
namespace {

std::string text_of(int family, const void* address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  ::inet_ntop(family, address, text.data(), text.size());
  return text.data();
}

/// Without blanks, brackets and port.
std::string_view bare(std::string_view entry) {
  while (entry.starts_with(' ') || entry.starts_with('\t')) entry.remove_prefix(1);
  while (entry.ends_with(' ') || entry.ends_with('\t')) entry.remove_suffix(1);
  if (entry.starts_with('[')) return entry.substr(1, entry.find(']') - 1);
  const std::size_t colon = entry.find(':');
  return colon == entry.rfind(':') ? entry.substr(0, colon) : entry;
}

}  // namespace

std::optional<std::string> host_of(std::string_view text) {
  const std::string whole(text);
  in_addr four{};
  if (::inet_pton(AF_INET, whole.c_str(), &four) == 1) return text_of(AF_INET, &four);
  in6_addr six{};
  if (::inet_pton(AF_INET6, whole.c_str(), &six) != 1) return std::nullopt;
  constexpr std::size_t mapped_at = 12;
  if (IN6_IS_ADDR_V4MAPPED(&six)) return text_of(AF_INET, &six.s6_addr[mapped_at]);
  return text_of(AF_INET6, &six);
}

std::string peer_of_host(const std::string& host) {
  in6_addr six{};
  if (::inet_pton(AF_INET6, host.c_str(), &six) != 1) return host;
  constexpr std::size_t network_bytes = 8;
  std::fill(std::begin(six.s6_addr) + network_bytes, std::end(six.s6_addr), std::uint8_t{0});
  return text_of(AF_INET6, &six);
}

std::string forwarded_peer(const std::string& host, std::string_view forwarded,
                           const std::vector<std::string>& proxies) {
  std::string nearest = host;
  while (!forwarded.empty() && std::find(proxies.begin(), proxies.end(), nearest) != proxies.end()) {
    const std::size_t comma = forwarded.rfind(',');
    const std::size_t begin = comma == std::string_view::npos ? 0 : comma + 1;
    const auto before = host_of(bare(forwarded.substr(begin)));
    if (!before) break;
    nearest = *before;
    forwarded = forwarded.substr(0, comma == std::string_view::npos ? 0 : comma);
  }
  return peer_of_host(nearest);
}

}  // namespace spoolflow::live
