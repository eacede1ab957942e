#pragma once
/// Smooths a whole recording without shifting it in time.
#include <span>
#include <vector>

namespace spoolflow::calibration {

/// Butterworth low pass of fourth order, run forwards and backwards: no lag, half the amplitude at `bandwidth_Hz`. Both
/// ends go on point-symmetrically. Gustafsson, Determining the initial states in forward-backward filtering (1996).
/// Returned as it is where the sample rate leaves nothing above the bandwidth.
struct SampledSignal {
  std::span<const double> values;
  double time_step_s;
};
[[nodiscard]] std::vector<double> zero_phase_low_pass(const SampledSignal& signal, double bandwidth_Hz);

/// Central differences [1/s]; one-sided at the ends.
[[nodiscard]] std::vector<double> derivative(const SampledSignal& signal);

}  // namespace spoolflow::calibration
