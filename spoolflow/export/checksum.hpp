#pragma once
/// Sum over bytes that detects damage and mix-ups, not forgery: FNV-1a.
#include <cstddef>
#include <cstdint>

namespace spoolflow::exports {

class Checksum {
 public:
  constexpr void add(const char* bytes, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) value_ = (value_ ^ static_cast<unsigned char>(bytes[k])) * 0x100000001b3ULL;
  }
  [[nodiscard]] constexpr std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

constexpr std::uint64_t checksum(const char* bytes, std::size_t size) {
  Checksum sum;
  sum.add(bytes, size);
  return sum.value();
}

}  // namespace spoolflow::exports
