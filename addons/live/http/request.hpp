#pragma once
/// A request and its answer, apart from how they travel.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spoolflow::live {

/// As it came; empty where it has none of that.
struct PageRequest {
  std::string method, target;
  std::string host{}, origin{}, cookie{}, authorization{}, content_type{};
  std::string body{};
  std::string peer{};      ///< the other side's address, as far as its trials are counted together
  bool upgrade = false;    ///< to a WebSocket
  bool encrypted = false;  ///< came by TLS
};

struct PageAnswer {
  unsigned status;        ///< of HTTP
  std::string_view type;  ///< media type; static storage
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers{};
};

namespace media {
inline constexpr std::string_view json = "application/json";
inline constexpr std::string_view plain = "text/plain; charset=utf-8";
inline constexpr std::string_view csv = "text/csv; charset=utf-8";
}  // namespace media

}  // namespace spoolflow::live
