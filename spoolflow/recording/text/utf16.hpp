#pragma once
/// Text as spreadsheets and Windows programs save it, in UTF-16 or in eight bits, into UTF-8 (Unicode 15, chapter 3.9).
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace spoolflow::recording {

/// Decodes in pieces of any length; what is no text becomes U+FFFD.
class Utf16 {
 public:
  /// By the byte order mark; nothing where there is none.
  [[nodiscard]] static std::optional<Utf16> of(std::string_view beginning);

  /// The next bytes, with or without their byte order mark, as UTF-8: at most three bytes for two.
  [[nodiscard]] std::string decoded(std::string_view bytes);

 private:
  explicit Utf16(bool high_first) : high_first_(high_first) {}

  bool high_first_;
  std::optional<unsigned char> half_{};     ///< the first byte of a unit whose second has not come
  std::optional<std::uint16_t> leading_{};  ///< the first half of a pair
};

/// Text of a file in eight bits as UTF-8: as it is where it is UTF-8 already, else read as Windows-1252, in which
/// German and French Windows save; bytes that mean nothing there become U+FFFD.
[[nodiscard]] std::string utf8_of(std::string_view text);

}  // namespace spoolflow::recording
