#pragma once
#include <string>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// No oil pressed on the spool: median of the measured pressure difference [Pa], and of the flow [share of the rated].
inline constexpr double unpressurised_Pa = 1e5;
inline constexpr double unpressurised_flow_share = 0.01;
/// The spool went to and fro by at least this share of the stroke.
inline constexpr double least_stroke_share = 0.5;

/// Why a recording cannot be of `unpressurised_strokes`, with file, channel and value: a pressure difference or a flow
/// stands in it, or the spool does not travel half the stroke both ways. Empty: it can.
[[nodiscard]] std::string not_unpressurised(const recording::Recording& recording, double rated_flow_m3_per_s,
                                            double stroke_m);

}  // namespace spoolflow::calibration
