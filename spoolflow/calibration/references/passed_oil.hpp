#pragma once
/// How much oil passed the valve from when to when, by what the machine knows.
#include <cstddef>
#include <vector>

#include "spoolflow/recording/recording.hpp"
#include "spoolflow/recording/references.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::calibration {

struct PassedOil {
  std::size_t reference;  ///< which of them says so
  double begin_s, end_s;
  double volume_m3;       ///< by the reference's stated figures, > 0
  double uncertainty_m3;  ///< of this interval alone, one standard deviation
};

/// The intervals of one reference in one recording, in their order; none where it is of another recording, and of
/// `closed`. `valve` sees where a stroke stalls. Intervals of a meter in which less than a hundredth of
/// `rated_flow_m3_per_s` passed are left out. Throws RecordingError: a channel is missing, marks lie outside the
/// recording, or no interval was found.
[[nodiscard]] std::vector<PassedOil> passed_oil(const recording::Reference& reference, std::size_t number,
                                                const recording::Recording& recording,
                                                const sensor::ObserverParameters<double>& valve,
                                                double rated_flow_m3_per_s);

}  // namespace spoolflow::calibration
