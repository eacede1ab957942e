#include "spoolflow/recording/text/utf16.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::uint32_t byte_order_mark = 0xFEFF, replacement = 0xFFFD;

void append(std::string& out, std::uint32_t point) {
  const auto byte = [&](std::uint32_t value) { out += static_cast<char>(value); };
  const auto following = [&](int shift) { byte(0x80U | ((point >> shift) & 0x3FU)); };
  if (point < 0x80) {
    byte(point);
  } else if (point < 0x800) {
    byte(0xC0U | (point >> 6));
    following(0);
  } else if (point < 0x10000) {
    byte(0xE0U | (point >> 12));
    following(6);
    following(0);
  } else {
    byte(0xF0U | (point >> 18));
    following(12);
    following(6);
    following(0);
  }
}

/// How many bytes follow the first of a character; nothing where it begins none.
std::optional<std::size_t> following(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  if (first >= 0xF0 && first < 0xF5) return 3;
  return std::nullopt;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto count = following(static_cast<unsigned char>(text[at]));
    if (!count) return false;
    for (std::size_t k = 0; k < *count; ++k) {
      if (++at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xC0U) != 0x80U) return false;
    }
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
      append(out, 0x10000U + ((*leading_ - 0xD800U) << 10) + (unit - 0xDC00U));
      leading_.reset();
      continue;
    }
    if (leading_) append(out, replacement);
    leading_.reset();
    if (leads) {
      leading_ = unit;
    } else if (unit != byte_order_mark) {
      append(out, follows ? replacement : unit);
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
    append(out, byte >= 0x80 && byte < 0xA0 ? windows_1252[byte - 0x80U] : byte);
  }
  return out;
}

}  // namespace spoolflow::recording
