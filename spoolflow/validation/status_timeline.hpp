#pragma once
/// When and how often the sensor said what of itself.
#include <span>
#include <string>
#include <vector>

#include "spoolflow/sensor/basis/status.hpp"

namespace spoolflow::validation {

/// A stretch of time of which `share` had the status.
struct StatusSpan {
  double from_s, to_s;
  double share;
};

/// One status over a run.
struct StatusRow {
  std::string name;
  std::string meaning;  ///< one sentence: what it says and what to do
  bool fault;
  double share;  ///< of the samples
  std::vector<StatusSpan> spans;
  unsigned place = 0;  ///< among the sensor's status names
};

/// A sentence for people.
[[nodiscard]] const char* meaning(sensor::Status bit);

/// Statuses that occurred, the most frequent first. Time is divided into at most `stretches`; neighbours of about equal
/// share become one span.
[[nodiscard]] std::vector<StatusRow> status_rows(std::span<const double> time_s, std::span<const sensor::Status> status,
                                                 std::size_t stretches);

}  // namespace spoolflow::validation
