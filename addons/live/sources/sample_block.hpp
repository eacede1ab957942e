#pragma once
/// Samples on their way from a source to their valve.
#include <cstdint>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::live {

/// How far a source has come; what is kept so that it goes on there after the program was ended.
struct SourcePosition {
  std::uint64_t session = 0;  ///< of a sender, chosen by it at its start; 0 where sources have none
  std::uint64_t next = 0;     ///< sequence number of the sample that comes next
};

/// Consecutive samples of one valve.
struct SampleBlock {
  std::vector<estimation::TimedSample> samples{};
  SourcePosition after{};         ///< behind its last sample
  std::int64_t arrived_ns = 0;    ///< when it came in, by the steady clock
  std::uint64_t lost_before = 0;  ///< samples that were sent before it and never came, told by sequence numbers
};

}  // namespace spoolflow::live
