#pragma once
/// What a request's target asks for, after its path.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace spoolflow::live {

/// The ID of /api/v1/valves/ID/`what`, and nothing for any other path.
[[nodiscard]] std::optional<std::string_view> valve_asked(std::string_view path, std::string_view what);

/// With %XX read as the byte that it stands for.
[[nodiscard]] std::string unescaped(std::string_view text);

/// The value of `key` in what follows the question mark, with %XX read; nothing where it is not there.
[[nodiscard]] std::optional<std::string> query_value(std::string_view target, std::string_view key);

/// Milliseconds since 1970-01-01 UTC of "2026-11-22T10:30:00Z", of its beginnings down to the day, or of seconds since
/// then; nothing where the text is neither.
[[nodiscard]] std::optional<std::int64_t> instant_ms(const std::string& text);

}  // namespace spoolflow::live
