#pragma once
/// What is known of the reference meter of a run.
#include <optional>

#include "spoolflow/numerics/meter_lag.hpp"

namespace spoolflow::validation {

/// Where a run's reference meter is known from.
enum class MeterSource {
  given,       ///< by the options
  this_run,    ///< as it shows beside the leading estimator, or edges and pressure difference
  other_runs,  ///< the median of what they show: the run itself shows none
  none,        ///< no run shows it; it counts as 0
};
struct KnownMeter {
  numerics::MeterLag meter = {};
  std::optional<numerics::MeterLag> uncertainty = {};  ///< half widths of 95 %; of `this_run`
  MeterSource source = MeterSource::none;
};

}  // namespace spoolflow::validation
