#pragma once
/// What a fuzz target takes off the front of its input: choices, and numbers of which many are extreme.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace spoolflow::fuzz {

class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  [[nodiscard]] bool empty() const { return left_ == 0; }
  /// Zero once the input is at its end.
  std::uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  std::size_t below(std::size_t count) { return (byte() + 256U * byte()) % count; }
  /// Near `usual`, or anything at all.
  double number(double usual, double spread) {
    const std::uint8_t kind = byte(), share = byte();
    switch (kind % 16) {
      case 0:
        return std::numeric_limits<double>::quiet_NaN();
      case 1:
        return share % 2 == 0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
      case 2: {
        std::uint8_t bytes[sizeof(double)];
        for (std::uint8_t& each : bytes) each = byte();
        double any = 0;
        std::memcpy(&any, bytes, sizeof any);
        return any;
      }
      case 3:
        return 0;
      case 4:
        return -usual;
      case 5:
        return usual * (share % 2 == 0 ? 1e6 : 1e12);
      default:
        return usual + spread * (share - 128.0) / 128;
    }
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace spoolflow::fuzz
