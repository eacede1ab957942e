#pragma once
/// Shunt and voltage divider of one coil; both readings are means over a sample period, but for what a machine does to
/// the current's.
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "spoolflow/rig/instruments/instruments.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

/// The ripple that a switched output stage leaves on the coil's current, read by a converter that takes single
/// conversions instead of means over whole switching periods: the ripple aliases to any frequency.
///
///     i_read = i (1 + s/2 tri(f t))        (tri: -1 to 1; s the share peak to peak)
///
/// The force does not follow: iron and eddy currents keep the flux. Switching: 100 Hz to 25 kHz; peak to peak it is
/// U d (1 - d)/(L f), 2 to 15 % of the current below 2 kHz.
struct PwmRipple {
  double share = 0.0;
  double frequency_Hz = 2000.0;

  bool operator==(const PwmRipple&) const = default;
  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(
        Parameter{"share", "1", 0, 0.5, "of the current, peak to peak; above 0 the current is one conversion, no mean"},
        self.share);
    visit(Parameter{"frequency_Hz", "Hz", 50, 30000,
                    "of the switching. No clock is another's multiple: 2003 Hz beats at 3 Hz with a recorder of 1 kHz"},
          self.frequency_Hz);
  }
};

/// Single samples of current that are off: a disturbed conversion, a bit lost on the bus. Each sample by chance, alone,
/// up or down.
struct CurrentSpikes {
  double share = 0.0;
  double height_A = 1.0;

  bool operator==(const CurrentSpikes&) const = default;
  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"share", "1", 0, 0.1, "of the samples"}, self.share);
    visit(Parameter{"height_A", "A", 0, 20, "either way, on top of the current"}, self.height_A);
  }
};

class CoilPanel {
 public:
  /// `coil` gives each of several its own noise; empty for the only one.
  CoilPanel(const Instruments& instruments, std::uint64_t seed, std::string_view coil, const PwmRipple& pwm = {},
            const CurrentSpikes& spikes = {})
      : pwm_(pwm),
        spikes_(spikes),
        chance_(seed, std::string("current spikes").append(coil)),
        shunt_(instruments.shunt.errors, seed, std::string("shunt").append(coil), 0),
        divider_(instruments.voltage.errors, seed, std::string("voltage").append(coil), 0) {}

  /// One period of the electronics went by with this mean voltage and this current at its end.
  void follow(double current_A, double voltage_V) {
    current_sum_A_ += current_A;
    last_current_A_ = current_A;
    voltage_sum_V_ += voltage_V;
  }
  /// Ends at `time_s`, which the ripple alone needs, the sample period of that many conversions; the readings are of it
  /// until the next.
  void end_period(double conversions, double time_s = 0) {
    shunt_.follow(period_current_A(conversions, time_s), 0);
    divider_.follow(voltage_sum_V_ / conversions, 0);
    current_sum_A_ = voltage_sum_V_ = 0;
    noise_share_ = 1 / std::sqrt(conversions);
    spike_A_ = spikes_.share > 0 && chance_.uniform() < spikes_.share
                   ? (chance_.uniform() < 0.5 ? -spikes_.height_A : spikes_.height_A)
                   : 0.0;
  }
  [[nodiscard]] double current_A() { return shunt_.reading(pwm_.share > 0 ? 1.0 : noise_share_) + spike_A_; }
  [[nodiscard]] double voltage_V() { return divider_.reading(noise_share_); }

 private:
  /// Mean, or the last conversion with the ripple of the switching.
  [[nodiscard]] double period_current_A(double conversions, double time_s) const {
    if (pwm_.share == 0) return current_sum_A_ / conversions;
    const double phase = pwm_.frequency_Hz * time_s - std::floor(pwm_.frequency_Hz * time_s);
    const double triangle = 4 * std::abs(phase - 0.5) - 1;
    return last_current_A_ * (1 + 0.5 * pwm_.share * triangle);
  }

  PwmRipple pwm_;
  CurrentSpikes spikes_;
  Noise chance_;
  Transducer shunt_, divider_;
  double current_sum_A_ = 0, voltage_sum_V_ = 0, noise_share_ = 1, last_current_A_ = 0, spike_A_ = 0;
};

}  // namespace spoolflow::rig
