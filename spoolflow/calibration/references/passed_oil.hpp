#pragma once
/// How much oil passed the valve from when to when, by what the machine knows.
#include <cstddef>
#include <vector>

#include "spoolflow/recording/recording.hpp"
#include "spoolflow/recording/references.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::calibration {

/// Below what of the usual pressure difference, which is what most samples stay below, the piston stands [Pa]; 0 where
/// there is no finite sample.
[[nodiscard]] double fallen_Pa(std::vector<double> pressure_difference_Pa);

/// Strokes of a cylinder whose ends nothing sees but the valve's own forces: where the piston stands, no oil flows, the
/// pressure difference is gone, and with it the flow force. From when the valve opens to when the sensor sees the
/// pressure difference fall, some hundredths of a second after the piston has come to stand. A stroke counts where the
/// one before it ended so, too, and the valve has closed since: the piston has gone back. One that the valve broke off,
/// and the one after it, are left out, and so is the recording's first.
[[nodiscard]] std::vector<recording::TimeMark> stalled_strokes(const sensor::ObserverParameters<double>& valve,
                                                               double rated_flow_m3_per_s,
                                                               const recording::Recording& recording);

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
