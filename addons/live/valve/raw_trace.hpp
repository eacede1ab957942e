#pragma once
/// The newest raw samples of a valve, so that those around an alarm can be kept as a recording.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::live {

class RawTrace {
 public:
  /// `whole`: coils of both sides and port pressures are kept, too. `length_s` of samples are kept and few more, but
  /// never more than a million; 0: none. Their times are rounded to a tenth of a microsecond.
  RawTrace(bool whole, double length_s) : width_(whole ? 10 : 4), length_s_(length_s) {}

  /// A sample without a time is left out, and a time that runs back starts again: the recording's time never does.
  void add(const estimation::TimedSample& sample);

  /// Those with from_s <= time <= to_s as CSV with the header of a recording; columns that nobody measured are left
  /// out. Empty where there are none.
  [[nodiscard]] std::string csv(double from_s, double to_s) const;

 private:
  static constexpr double raw_time_step_s = 1e-7;
  /// Consecutive samples, at least one. Full ones are let go as a whole, and used again.
  struct Piece {
    double begin_s = 0;
    std::vector<std::uint32_t> since_begin;  ///< of each sample, in raw_time_step_s
    std::vector<float> numbers;              ///< of each sample as many as there are channels, as in datagram_channels
    [[nodiscard]] double last_s() const { return time_s(since_begin.size() - 1); }
    [[nodiscard]] double time_s(std::size_t k) const { return begin_s + raw_time_step_s * since_begin[k]; }
  };
  void begin_piece(double time_s);

  std::size_t width_;
  double length_s_;
  std::deque<Piece> pieces_;
  std::size_t count_ = 0;
};

}  // namespace spoolflow::live
