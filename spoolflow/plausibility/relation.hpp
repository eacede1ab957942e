#pragma once
/// What forces, flow and coil must satisfy, whatever the valve: each as a deviation beside what sound recordings reach.
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

struct Deviation {
  std::string of;      ///< "balance of forces in operation"
  std::string shown;   ///< its value with unit, as in a message
  double over_limit;   ///< 0: none; above 1: beyond what any sound recording here has, with a margin
  std::string file{};  ///< that it is of, where it is of one alone
  double ratio = 1;    ///< of a reference to what it should be
  double blocks = 0;   ///< how many it was judged on, where a recording error may change that
};
/// Names of relations that are asked for.
inline constexpr const char* largest_opening = "largest opening";
inline constexpr const char* reference_ratio = "reference flow over that of edge and pressure difference";

/// How far `value` is from what is usual, in units of the largest factor that is: the logarithm of both; 20 where it
/// has the wrong sign.
[[nodiscard]] double factor_over(double value, double usual, double factor);
/// A value in SI as its channel's usual unit has it: "1.431 A".
[[nodiscard]] std::string shown_value(recording::Channel channel, double value);
/// The recording's file without its folder.
[[nodiscard]] std::string file_of(const recording::Recording& recording);
/// Positions lie within the stroke, bench strokes go over half of it at least.
void add_travel(std::vector<Deviation>& to, const recording::Recording& means, double stroke_m, bool strokes,
                double most_outside = outside_share);

/// Of the same relation of the same file; 0 where it is not among them.
[[nodiscard]] double over_limit_of(const std::vector<Deviation>& deviations, const Deviation& as);

/// From the lowest finite value to the highest; 0 where there are none.
[[nodiscard]] double range_of(const std::vector<double>& values);
/// The value of a channel whose samples are all the same; nothing of one that moves or has no samples.
[[nodiscard]] std::optional<double> standing_value(const std::vector<double>& values);

/// One relation as it stands, and with a recording error undone.
struct Change {
  const Deviation* before;
  const Deviation* after;
};

/// What is worst as it stands and no longer with the error undone; neither may be empty.
[[nodiscard]] Change deciding_change(const std::vector<Deviation>& before, const std::vector<Deviation>& after);
/// "balance of forces in operation goes from 41 N RMS to 0.3 N RMS"
[[nodiscard]] std::string text(const Change& change);

/// Whether as much is judged as before, and on no less than half of the blocks: an error must not hide what it is to
/// explain.
[[nodiscard]] bool judges_as_much(const std::vector<Deviation>& after, const std::vector<Deviation>& before);

/// Of all together, 0: nothing.
[[nodiscard]] double badness(const std::vector<Deviation>& deviations);

}  // namespace spoolflow::plausibility
