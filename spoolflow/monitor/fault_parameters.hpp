#pragma once
/// The magnitudes by which a valve may differ from its model, each in units of a fault of usual size, and how far those
/// of a healthy valve lie from zero.
#include <array>
#include <cstddef>
#include <span>

namespace spoolflow::monitor {

/// The magnitudes that act on a force. Each is 0 where the valve is as its model.
enum class Magnitude : std::size_t { friction, edge_rounding, preload_loss, rate_loss, shorted_turns, position_zero };
inline constexpr std::size_t magnitudes = 6;
using Magnitudes = std::array<double, magnitudes>;
using MagnitudeMatrix = std::array<double, magnitudes * magnitudes>;  ///< row after row

/// One unit of each: friction + 40 %, edges rounded by 40 um, springs' preload - 10 % and rate - 6 %, 4 % of the turns
/// shorted, position reads 25 um too much. It is also the standard deviation of a fault's size before anything is seen.
inline constexpr Magnitudes usual_fault{0.4, 40e-6, 0.1, 0.06, 0.04, 25e-6};

/// One standard deviation of a healthy valve against its own model, in those units: what calibration, instruments and
/// the signatures' own errors leave. Found on rig valves beside their own models (docs/monitoring.md).
inline constexpr Magnitudes healthy_spread{0.2, 0.12, 0.15, 0.2, 0.15, 0.2};

[[nodiscard]] constexpr std::size_t index(Magnitude magnitude) {
  return static_cast<std::size_t>(magnitude);
}

/// What windows of force events identify of the magnitudes, pressure differences already taken out: the information
/// J^T S^-1 J and the weighted residuals J^T S^-1 y.
struct Evidence {
  MagnitudeMatrix information{};
  Magnitudes pull{};
};

}  // namespace spoolflow::monitor
