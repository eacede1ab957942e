#pragma once
/// Whose requests, connections and wrong passwords are counted together, behind proxies as well.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::live {

/// An address as sockets give it, an IPv4 one in IPv6's form as that; nothing where the text is none.
[[nodiscard]] std::optional<std::string> host_of(std::string_view text);

/// An IPv4 address itself; of an IPv6 one its network of 64 bits, all of which one machine may have. `host`: of
/// host_of().
[[nodiscard]] std::string peer_of_host(const std::string& host);

/// The peer of a request that came from `host`: where that is one of the proxies, the last address of `forwarded` (the
/// values of X-Forwarded-For, separated by commas) that is none of them, as nearer ones were written by proxies alone.
[[nodiscard]] std::string forwarded_peer(const std::string& host, std::string_view forwarded,
                                         const std::vector<std::string>& proxies);

}  // namespace spoolflow::live
