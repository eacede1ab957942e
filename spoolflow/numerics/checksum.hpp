#pragma once
/// Sum over bytes that detects damage and mix-ups, not forgery: FNV-1a.
#include <cstddef>
#include <cstdint>

namespace spoolflow::numerics {

class Checksum {
 public:
  void add(const void* bytes, std::size_t size) {
    const auto* byte = static_cast<const unsigned char*>(bytes);
    for (std::size_t k = 0; k < size; ++k) value_ = (value_ ^ byte[k]) * 0x100000001b3ULL;
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

[[nodiscard]] inline std::uint64_t checksum(const void* bytes, std::size_t size) {
  Checksum sum;
  sum.add(bytes, size);
  return sum.value();
}

}  // namespace spoolflow::numerics
