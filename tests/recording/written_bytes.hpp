#pragma once
/// Numbers and texts as bytes one after the other, in either byte order: measurement files made by hand.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace spoolflow::recording {

class WrittenBytes {
 public:
  explicit WrittenBytes(bool highest_first = false) : highest_first_(highest_first) {}

  template <class Number>
  WrittenBytes& put(Number value) {
    auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    if (highest_first_) std::reverse(bytes.begin(), bytes.end());
    content_.append(bytes.data(), bytes.size());
    return *this;
  }
  WrittenBytes& u8(std::uint8_t value) { return put(value); }
  WrittenBytes& u16(std::uint16_t value) { return put(value); }
  WrittenBytes& u32(std::uint32_t value) { return put(value); }
  WrittenBytes& u64(std::uint64_t value) { return put(value); }
  WrittenBytes& f64(double value) { return put(value); }
  /// As it stands, without its length.
  WrittenBytes& raw(std::string_view text) {
    content_ += text;
    return *this;
  }
  WrittenBytes& zeros(std::size_t count) {
    content_.append(count, '\0');
    return *this;
  }
  [[nodiscard]] const std::string& content() const { return content_; }
  [[nodiscard]] std::size_t size() const { return content_.size(); }

 private:
  bool highest_first_;
  std::string content_;
};

}  // namespace spoolflow::recording
