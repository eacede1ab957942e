#pragma once
/// Whether the positions of a recording count from the same zero as those of its valve's other recordings.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/plausibility/valve_curves.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// Conductance over position in steps of a fiftieth of the stroke, fine enough to show where an edge opens.
class OpeningCurve {
 public:
  OpeningCurve() = default;
  /// Of block means; one without position, flow or pressure difference counts as if it were not there.
  OpeningCurve(const std::vector<const recording::Recording*>& recordings, double stroke_m);

  [[nodiscard]] bool empty() const { return position_m_.empty(); }
  /// Flow over the root of the pressure difference, and its slope over position; NaN outside of what was recorded.
  struct Point {
    double conductance, slope;
  };
  [[nodiscard]] Point at(double position_m) const;
  /// The position from which on more than a fiftieth of the largest conductance is open.
  [[nodiscard]] double opens_at_m() const;

 private:
  std::vector<double> position_m_, conductance_;
};

struct ZeroOffset {
  double offset_m;               ///< how much more the recording's position reads than that of the curve's recordings
  double residual_share;         ///< RMS that its flows leave with that offset, over what they leave without
  double left_share;             ///< RMS that they leave with it, over the RMS of the flows
  double meter_offset_m3_per_s;  ///< of a meter's zero that would do nearly the same
};

/// Of a recording's positions against a valve's opening curve, least squares: flow = r C(position - offset) sqrt(dp),
/// shown late by a lag that is fitted, too. Nothing where fewer than fifty blocks open under pressure, or where flow
/// does not say what is offset and what is scale or lag.
[[nodiscard]] std::optional<ZeroOffset> zero_offset(const OpeningCurve& curve, const recording::Recording& means);

/// The same, of an offset beyond the limit that explains the recording's flows.
[[nodiscard]] std::optional<ZeroOffset> misplaced_zero(const OpeningCurve& curve, const recording::Recording& means,
                                                       double stroke_m);
[[nodiscard]] double over_limit(const ZeroOffset& offset, double stroke_m);
/// "position reads 0.100 mm more than in …"
[[nodiscard]] std::string shown(const ZeroOffset& offset, std::string_view than_where);

/// The median position of a spool that stands still without current, where its spring is preloaded by more than its
/// friction, so that it returns to one place; nothing where it never stands so for 0.25 s. `means` of a run.
[[nodiscard]] std::optional<double> rest_position(const recording::Recording& means, const HydraulicCurves& hydraulics,
                                                  double largest_current_A);

}  // namespace spoolflow::plausibility
