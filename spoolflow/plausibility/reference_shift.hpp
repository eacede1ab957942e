#pragma once
/// A reference flow whose times are not those of the other channels.
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spoolflow::plausibility {

struct ReferenceShift {
  double late_s;          ///< < 0: it comes early
  double residual_share;  ///< RMS of what it leaves unexplained, over what the best usual meter leaves
};

/// The shift between -10 and 10 s, and at most a quarter of the recording, at which the reference follows the flow of
/// edge and pressure difference best: best scale, least squares. Nothing where it is that of a usual meter, which shows
/// a flow 0 to 0.75 s late (0.2 s early: blocks, and filters of the other channels), or leaves no less than half of
/// what the best usual one leaves, or where the shifted reference does not follow either.
[[nodiscard]] std::optional<ReferenceShift> reference_shift(std::span<const double> time_s,
                                                            std::span<const double> expected,
                                                            std::span<const double> reference);

/// `values` as they are `later_s` later, at the same times; NaN where they begin later or end earlier.
[[nodiscard]] std::vector<double> values_later(std::span<const double> time_s, std::span<const double> values,
                                               double later_s);

/// "flow_reference comes 2.00 s late …"
[[nodiscard]] std::string shown(const ReferenceShift& shift);

}  // namespace spoolflow::plausibility
