#pragma once
/// Position and coil current whose times are not the same.
#include <optional>
#include <string>

#include "spoolflow/plausibility/run_means.hpp"
#include "spoolflow/plausibility/signals/known_coil.hpp"
#include "spoolflow/plausibility/signals/motion_trace.hpp"

namespace spoolflow::plausibility {

/// By how much the position follows the current later than a spool does [s]; < 0: it comes before the current.
/// In pieces of ten seconds, the shift within 5 s at which their changes over 30 ms correlate best; the median of the
/// pieces in which they do so by `least_motion_correlation`, as long as a spool moves and clearly at one shift, where
/// three and most of them agree: strokes that come again and again fit at many, as friction turns the current long
/// before the spool. Nothing where that is what a spool and its position sensor take, where the run moves too slowly,
/// or where its samples are more than 10 ms apart.
[[nodiscard]] std::optional<double> motion_delay_s(const MotionTrace& run);

/// "position comes 0.16 s late …"
[[nodiscard]] std::string shown_delay(double late_s);
/// "position comes 0.020 s late against current, …" of a run without dither; else empty. See induced_delay_s().
[[nodiscard]] std::string induced_delay(const KnownCoil& coil, const RunMeans& run, double stroke_m);

}  // namespace spoolflow::plausibility
