#include "spoolflow/recording/text/utf16.hpp"

#include "spoolflow/recording/channels/utf8.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::uint32_t byte_order_mark = 0xFEFF, replacement = 0xFFFD;

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = first_character(text).bytes;
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

}  // namespace

std::optional<Utf16> Utf16::of(std::string_view beginning) {
  if (beginning.starts_with("\xFE\xFF")) return Utf16(true);
  if (beginning.starts_with("\xFF\xFE")) return Utf16(false);
  return std::nullopt;
}

std::string Utf16::decoded(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size());
  for (const char c : bytes) {
    const auto now = static_cast<unsigned char>(c);
    if (!half_) {
      half_ = now;
      continue;
    }
    const unsigned first = *half_;
    half_.reset();
    const auto unit = static_cast<std::uint16_t>(high_first_ ? (first << 8) | now : (unsigned{now} << 8) | first);
    const bool leads = unit >= 0xD800 && unit < 0xDC00, follows = unit >= 0xDC00 && unit < 0xE000;
    if (leading_ && follows) {
      append_utf8(out, 0x10000U + ((*leading_ - 0xD800U) << 10) + (unit - 0xDC00U));
      leading_.reset();
      continue;
    }
    if (leading_) append_utf8(out, replacement);
    leading_.reset();
    if (leads) {
      leading_ = unit;
    } else if (unit != byte_order_mark) {
      append_utf8(out, follows ? replacement : unit);
    }
  }
  return out;
}

std::string utf8_of(std::string_view text) {
  if (is_utf8(text)) return std::string(text);
  // From 0x80 to 0x9F; the others are those of Unicode.
  constexpr std::array<char16_t, 32> windows_1252{
      0x20AC, replacement, 0x201A,      0x0192, 0x201E,      0x2026,      0x2020, 0x2021,      0x02C6, 0x2030, 0x0160,
      0x2039, 0x0152,      replacement, 0x017D, replacement, replacement, 0x2018, 0x2019,      0x201C, 0x201D, 0x2022,
      0x2013, 0x2014,      0x02DC,      0x2122, 0x0161,      0x203A,      0x0153, replacement, 0x017E, 0x0178};
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    append_utf8(out, byte >= 0x80 && byte < 0xA0 ? windows_1252[byte - 0x80U] : byte);
  }
  return out;
}

}  // namespace spoolflow::recording
