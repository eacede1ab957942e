#pragma once
/// A spool that goes one way, be it evenly or by sticking and slipping: over a tenth of a millimetre its forces balance
/// in the mean, friction being that of sliding.
#include <cmath>
#include <cstddef>

namespace spoolflow::calibration {

/// Friction that has grown at rest wears off while the spool slides so far.
inline constexpr double wearing_m = 60e-6;
/// A passage goes on by so much ...
inline constexpr double progress_m = 10e-6;
/// ... within that time: a spool that sticks longer rests.
inline constexpr double longest_stick_s = 0.3;

class Passage {
 public:
  /// Takes the next position. False where the spool has turned or rests: what came after `went_on()` is no passage.
  bool goes_on(std::size_t sample, double time_s, double position_m) {
    const double ahead_m = position_m - last_m_;
    const bool moved = std::abs(ahead_m) >= progress_m;
    if (moved && way_ * ahead_m > 0) {
      went_on_ = sample;
      last_s_ = time_s;
      last_m_ = position_m;
      return true;
    }
    if (!moved && time_s < last_s_ + longest_stick_s) return true;
    begin(time_s, position_m, !moved ? 0 : ahead_m > 0 ? 1 : -1);
    return false;
  }
  /// Starts again from there; `way` is 1 opening, -1 closing, 0 neither.
  void begin(double time_s, double position_m, double way) {
    way_ = way;
    last_s_ = time_s;
    last_m_ = from_m_ = position_m;
  }
  /// Whether friction is that of sliding by now.
  [[nodiscard]] bool worn() const { return way_ * (last_m_ - from_m_) > wearing_m; }
  [[nodiscard]] double way() const { return way_; }  ///< 1 opening, -1 closing, 0 neither
  [[nodiscard]] std::size_t went_on() const { return went_on_; }

 private:
  double way_ = 0, from_m_ = 0, last_m_ = 0, last_s_ = -INFINITY;
  std::size_t went_on_ = 0;
};

}  // namespace spoolflow::calibration
