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

/// What a source has delivered; an intake counts since the program started.
struct IntakeCounters {
  std::uint64_t received = 0;     ///< samples that came in whole
  std::uint64_t dropped = 0;      ///< of them, those that found no room
  std::uint64_t lost = 0;         ///< samples that were sent and never came, by their sequence numbers
  std::uint64_t repeated = 0;     ///< samples that had come before, by sequence number
  std::uint64_t unreadable = 0;   ///< datagrams or lines that are no samples
  std::uint64_t connections = 0;  ///< times that a sender began: connections, sessions, openings

  IntakeCounters operator+(const IntakeCounters& other) const {
    return {received + other.received, dropped + other.dropped,       lost + other.lost,
            repeated + other.repeated, unreadable + other.unreadable, connections + other.connections};
  }
};

/// Consecutive samples of one valve.
struct SampleBlock {
  std::vector<estimation::TimedSample> samples{};
  SourcePosition after{};         ///< behind its last sample
  std::int64_t arrived_ns = 0;    ///< when it came in, by the steady clock
  std::uint64_t lost_before = 0;  ///< samples that were sent before it and never came, by their sequence numbers
  IntakeCounters counted{};       ///< by its intake, up to its last sample
};

}  // namespace spoolflow::live
