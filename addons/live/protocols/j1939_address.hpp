#pragma once
/// The right to a J1939 source address (SAE J1939-81): claimed, sent when asked, given up to the device of the lesser
/// NAME.
#include <cstdint>
#include <optional>

#include "spoolflow/sensor/fieldbus/can_answer.hpp"

namespace spoolflow::fieldbus {

/// Of a gateway whose address is fixed by its settings: function 255 (not available), industry group 0, manufacturer
/// 2047 (none), identity the address itself, so that two gateways of one bus differ.
[[nodiscard]] constexpr std::uint64_t j1939_name(std::uint8_t source_address) {
  return std::uint64_t{255} << 40U | std::uint64_t{2047} << 21U | source_address;
}

class J1939Address {
 public:
  explicit J1939Address(std::uint8_t address) : address_(address) {}

  [[nodiscard]] sensor::CanFrame claim() const {
    constexpr std::uint8_t null_address = 254;
    return sensor::address_claimed_frame(j1939_name(address_), lost_ ? null_address : address_);
  }
  /// Whether another has it: nothing may be sent under it any more.
  [[nodiscard]] bool is_lost() const { return lost_; }

  /// What is to be answered to a frame of the bus.
  [[nodiscard]] std::optional<sensor::CanFrame> hear(const sensor::CanFrame& frame) {
    if (!frame.extended) return std::nullopt;
    const std::uint32_t group = frame.id >> 16U & 0xFFU, to = frame.id >> 8U & 0xFFU;
    const bool is_for_us = to == 255 || to == address_;
    constexpr std::uint32_t request = 0xEA, claimed = 0xEE;
    if (group == request && is_for_us && frame.size >= 3) {
      const bool is_asked = frame.data[0] == 0 && frame.data[1] == claimed && frame.data[2] == 0;
      return is_asked ? std::optional(claim()) : std::nullopt;
    }
    if (group != claimed || to != 255 || (frame.id & 0xFFU) != address_ || frame.size != 8 || lost_)
      return std::nullopt;
    std::uint64_t other = 0;
    for (unsigned k = 8; k > 0; --k) other = other << 8U | frame.data[k - 1];
    if (other == j1939_name(address_)) return std::nullopt;
    lost_ = other < j1939_name(address_);
    return claim();
  }

 private:
  std::uint8_t address_;
  bool lost_ = false;
};

}  // namespace spoolflow::fieldbus
