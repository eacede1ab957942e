#pragma once
/// Refuses values that no valve's recording holds: almost always a unit that is not what was said.
#include <array>
#include <string>

#include "spoolflow/recording/channel.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

/// Follows the extremes of each channel over a recording.
class Plausibility {
 public:
  explicit Plausibility(std::string file) : file_(std::move(file)) {}

  /// Takes in a block. Throws RecordingError where a value is beyond its quantity's limits.
  void take(const SampleBlock& block);
  /// Throws where a channel moved, but never by as much as its quantity does: bar read as Pa, A read as mA. Called
  /// after the first full block and at the end.
  void check_sizes() const;

 private:
  struct Extremes {
    double lowest;
    double highest;
    bool seen = false;
  };
  std::string file_;
  std::array<Extremes, channel_count> extremes_{};
};

}  // namespace spoolflow::recording
