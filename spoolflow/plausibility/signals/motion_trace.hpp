#pragma once
/// What spool and coil did, in means over 2 ms.
#include <array>
#include <cstddef>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"

namespace spoolflow::plausibility {

/// The first five minutes of one run, in bounded memory.
class MotionTrace {
 public:
  static constexpr double block_s = 0.002;

  /// The next samples of each channel [SI]; NaN: missing; empty: the recording has none. Reads time, position, current
  /// and voltage of the coil, of a whole valve those of coil b less those of coil a, which moves the spool the other
  /// way.
  void take(const std::array<std::vector<double>, recording::channel_count>& columns);

  /// Means over so many blocks; NaN where there is no sample, of the voltage where it was not recorded.
  [[nodiscard]] std::vector<double> position_m(std::size_t blocks = 1) const { return means(0, blocks); }
  [[nodiscard]] std::vector<double> current_A(std::size_t blocks = 1) const { return means(1, blocks); }
  [[nodiscard]] std::vector<double> voltage_V(std::size_t blocks = 1) const { return means(2, blocks); }

 private:
  using Values = std::array<double, 3>;
  struct Block {
    std::array<float, 3> sums{};
    float samples = 0;
  };
  void add(double time_s, const Values& values);
  [[nodiscard]] std::vector<double> means(std::size_t of, std::size_t blocks) const;

  std::vector<Block> blocks_;
  double begin_s_ = 0;
};

}  // namespace spoolflow::plausibility
