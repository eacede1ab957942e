#pragma once
/// Up to which frequency the estimate follows the flow, as far as the run excites it.
#include <optional>
#include <span>
#include <vector>

namespace spoolflow::validation {

/// The estimate over the flow in a band of frequencies.
struct FrequencyPoint {
  double frequency_Hz;
  double gain;       ///< 1: as large as the flow
  double phase_rad;  ///< negative: the estimate comes later
  double coherence;  ///< share of the estimate's power that the flow explains
};

struct FrequencyResponse {
  std::vector<FrequencyPoint> points;  ///< in rising order, up to where the run excites the valve enough
  std::optional<double> corner_Hz;     ///< where the gain falls 3 dB below that at low frequencies; absent: not reached
};

struct FrequencyInput {
  std::span<const double> time_s;
  std::span<const float> reference, estimate;
  double reference_lag_s;  ///< of the meter, taken out of the response; 0 where the estimate was lagged likewise
};

/// Welch's averaged cross spectrum (Hann windows of up to 8 s, half overlapping) in ten bands a decade. Nothing where
/// less than six bands from the lowest on have a coherence of 0.8.
[[nodiscard]] std::optional<FrequencyResponse> frequency_response(const FrequencyInput& input);

}  // namespace spoolflow::validation
