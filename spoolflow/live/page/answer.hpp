#pragma once
/// Which answer a request gets, apart from how it travels.
#include <optional>
#include <string>
#include <string_view>

#include "spoolflow/live/engine.hpp"

namespace spoolflow::live {

struct PageAnswer {
  unsigned status;        ///< of HTTP
  std::string_view type;  ///< media type
  std::string body;
};

/// `target` as the request has it. No path reaches the file system: each is one of a few known ones.
[[nodiscard]] PageAnswer answer_to(const Engine& engine, std::string_view method, std::string_view target);

/// The valve whose plot is asked for by a WebSocket at /api/v1/valves/ID/stream.
[[nodiscard]] std::optional<std::size_t> streamed_valve(const Engine& engine, std::string_view target);

/// Whether the name by which a browser called the server is one of this machine alone: a page of another site that
/// pretends to be here by its name's address is refused.
[[nodiscard]] bool is_own_host(std::string_view host);
/// Whether a WebSocket was opened by a page of this server, or by no page at all.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host);

}  // namespace spoolflow::live
