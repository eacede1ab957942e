#pragma once
/// Whether the time of a recording is that in which its coil worked.
#include <string>

#include "spoolflow/plausibility/signals/known_coil.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// One sentence where the coil has less than 0.7 times, or more than 1.6 times, the voltage beside its resistance that
/// its flux induces in the recorded time: sound runs have 0.89 to 1.34 times. Faraday's law; omits hysteresis and eddy
/// currents, which dither shows, so that `means` are of a run without it. Empty: none, or less than 10 s of current
/// that changes, means over more than 0.26 s, a resistance that is off by a factor of 1.35 (a scale's error).
[[nodiscard]] std::string wrong_clock(const recording::Recording& means, const KnownCoil& coil);

}  // namespace spoolflow::plausibility
