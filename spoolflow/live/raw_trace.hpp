#pragma once
/// The newest raw samples of a valve, so that those around an alarm can be kept as a recording.
#include <cstdint>
#include <string>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::live {

class RawTrace {
 public:
  /// `whole`: coils of both sides and port pressures are kept, too. `length_s` of samples are kept, but never more than
  /// a million; 0: none.
  RawTrace(bool whole, double length_s) : width_(whole ? 10 : 4), length_s_(length_s) {}

  /// A sample without a time is left out, and a time that runs back begins anew: the recording's time never does.
  void add(const estimation::TimedSample& sample);

  /// Those with from_s <= time <= to_s as CSV with the header of a recording; columns that nobody measured are left
  /// out. Empty where there are none.
  [[nodiscard]] std::string csv(double from_s, double to_s) const;

 private:
  void make_room();

  std::size_t width_;
  double length_s_;
  std::vector<double> time_s_;  ///< a ring, as the numbers beside it
  std::vector<float> numbers_;  ///< in the order of datagram_channels
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace spoolflow::live
