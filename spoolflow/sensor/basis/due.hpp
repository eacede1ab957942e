#pragma once

namespace spoolflow::sensor {

/// Whether a stage runs with this sample, and how many blocks of positions ago it last ran; the schedule stands in
/// schedule.hpp.
template <class T>
struct Due {
  bool now{};
  T block_s{};
  T blocks{1};

  [[nodiscard]] constexpr T since_s() const { return blocks * block_s; }
};

}  // namespace spoolflow::sensor
