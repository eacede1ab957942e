#pragma once
/// What is told to those who may read.
#include <optional>
#include <string>
#include <string_view>

#include "spoolflow/live/engine.hpp"
#include "spoolflow/live/page/request.hpp"

namespace spoolflow::live {

/// `target` as the request has it. No path reaches the file system: each is one of a few known ones.
[[nodiscard]] PageAnswer answer_to(const Engine& engine, std::string_view method, std::string_view target);

/// The valve whose plot is asked for by a WebSocket at /api/v1/valves/ID/stream.
[[nodiscard]] std::optional<std::size_t> streamed_valve(const Engine& engine, std::string_view target);

/// Whether it is one of the files that the page is made of, which tell nothing of the site.
[[nodiscard]] bool is_page_file(std::string_view path);

}  // namespace spoolflow::live
