#pragma once
/// How the reference meter's scale and zero stand to the estimate: reported, not applied.
#include <optional>
#include <span>

namespace spoolflow::validation {

/// reference = scale * estimate + offset, each with its standard uncertainty.
struct ReferenceScale {
  double scale, scale_uncertainty;
  double offset_m3_per_s, offset_uncertainty_m3_per_s;
};

/// The line of least distance (both may err alike), over samples where both are numbers. Uncertainties are the
/// jackknife's over twenty stretches of time, because errors that follow each other are not independent. Nothing where
/// fewer than 200 samples have both or the flow varies by less than 5 % of full scale (RMS).
[[nodiscard]] std::optional<ReferenceScale> reference_scale(std::span<const float> estimate_m3_per_s,
                                                            std::span<const float> reference_m3_per_s,
                                                            double full_scale_m3_per_s);

}  // namespace spoolflow::validation
