#include "spoolflow/recording/files/utf16.hpp"

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

}  // namespace spoolflow::recording
