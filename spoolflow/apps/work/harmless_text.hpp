#pragma once
/// Text that cannot steer a terminal or forge a line, whatever names files and command lines hold.
#include <string>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

namespace spoolflow::apps {

/// The text on one line and without effect: control characters (of ASCII and of ISO 6429 above it), marks that turn the
/// direction of writing, and bytes that are no UTF-8 become \n, \t, \u001b, \xb0 and so on.
[[nodiscard]] std::string terminal_text(std::string_view text);
/// The same line by line.
[[nodiscard]] std::string terminal_lines(std::string_view text);
/// JSON as harmless: in ASCII, with \ufffd for bytes that are no UTF-8.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json);

namespace detail {

template <class Value>
auto harmless(const Value& value) {
  if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
    return terminal_text(value);
  } else {
    return value;
  }
}
template <class Value>
using Harmless = decltype(harmless(std::declval<const Value&>()));

}  // namespace detail

}  // namespace spoolflow::apps
