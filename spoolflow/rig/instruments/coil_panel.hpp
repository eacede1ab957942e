#pragma once
/// Shunt and voltage divider of one coil; both readings are means over a sample period.
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "spoolflow/rig/instruments/instruments.hpp"

namespace spoolflow::rig {

class CoilPanel {
 public:
  /// `coil` tells the noise of several apart; empty for the only one.
  CoilPanel(const Instruments& instruments, std::uint64_t seed, std::string_view coil)
      : shunt_(errors(instruments.shunt), seed, std::string("shunt").append(coil), 0),
        divider_(errors(instruments.voltage), seed, std::string("voltage").append(coil), 0) {}

  /// One period of the electronics went by with this mean voltage and this current at its end.
  void follow(double current_A, double voltage_V) {
    current_sum_A_ += current_A;
    voltage_sum_V_ += voltage_V;
  }
  /// Ends the sample period of that many conversions; the readings are of it until the next.
  void end_period(double conversions) {
    shunt_.follow(current_sum_A_ / conversions, 0);
    divider_.follow(voltage_sum_V_ / conversions, 0);
    current_sum_A_ = voltage_sum_V_ = 0;
    noise_share_ = 1 / std::sqrt(conversions);
  }
  [[nodiscard]] double current_A() { return shunt_.reading(noise_share_); }
  [[nodiscard]] double voltage_V() { return divider_.reading(noise_share_); }

 private:
  Transducer shunt_, divider_;
  double current_sum_A_ = 0, voltage_sum_V_ = 0, noise_share_ = 1;
};

}  // namespace spoolflow::rig
