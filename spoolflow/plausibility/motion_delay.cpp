#include "spoolflow/plausibility/motion_delay.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <string_view>

#include <Eigen/Core>
#include <fmt/format.h>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/signals/induced_delay.hpp"
#include "spoolflow/plausibility/steady_lines.hpp"

namespace spoolflow::plausibility {

namespace {

constexpr std::size_t blocks_at_once = 5;
constexpr double block_s = blocks_at_once * MotionTrace::block_s;
constexpr std::size_t piece_blocks = 1000, most_shift_blocks = 500, change_blocks = 3;
/// Of the power that the position has where it moves most: shifts at which it hardly moves say nothing.
constexpr double least_power_share = 0.05;
constexpr double as_well_share = 0.7;  // of the best correlation

/// Changes of a signal over 30 ms; 0 where one of both ends is missing.
std::vector<double> changes(const std::vector<double>& means) {
  std::vector<double> out;
  for (std::size_t k = change_blocks; k < means.size(); ++k) {
    const double change = means[k] - means[k - change_blocks];
    out.push_back(std::isnan(change) ? 0 : change);
  }
  return out;
}

using Signal = Eigen::Map<const Eigen::VectorXd>;
Signal signal(std::span<const double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// Where the changes of position [m] in `reach`, which begins `most_shift_blocks` before the piece, follow those of the
/// current [A] best, in seconds; nothing where they do not, or as well within a wide range of shifts.
std::optional<double> clear_shift_s(std::span<const double> current, std::span<const double> reach) {
  std::vector<double> power, correlation, squares{0};  // the last: sums of those before
  for (const double each_m : reach) squares.push_back(squares.back() + each_m * each_m);
  for (std::size_t k = 0; k <= 2 * most_shift_blocks; ++k) {
    power.push_back(squares[k + current.size()] - squares[k]);
    correlation.push_back(signal(current).dot(signal(reach.subspan(k, current.size()))));
  }
  const double current_power = signal(current).squaredNorm(), least_power = least_power_share * std::ranges::max(power);
  if (!(current_power > 0) || !(least_power > 0)) return std::nullopt;
  for (std::size_t k = 0; k < power.size(); ++k)
    correlation[k] = power[k] < least_power ? 0 : correlation[k] / std::sqrt(current_power * power[k]);
  const auto best = std::ranges::max_element(correlation);
  const auto as_well = std::ranges::count_if(correlation, [&](double each) { return each > as_well_share * *best; });
  const auto falls = [&](double each) { return each <= as_well_share * *best; };
  const auto width = std::find_if(best, correlation.end(), falls) -
                     std::find_if(std::make_reverse_iterator(best), correlation.rend(), falls).base();
  if (*best < least_motion_correlation || static_cast<double>(as_well) * block_s > widest_motion_peak_s ||
      static_cast<double>(width) * block_s < narrowest_motion_peak_s)
    return std::nullopt;
  return static_cast<double>(best - correlation.begin() - static_cast<std::ptrdiff_t>(most_shift_blocks)) * block_s;
}

}  // namespace

std::optional<double> motion_delay_s(const MotionTrace& run) {
  const std::vector<double> current = changes(run.current_A(blocks_at_once));
  std::vector<double> reach = changes(run.position_m(blocks_at_once));
  reach.insert(reach.begin(), most_shift_blocks, 0.0);
  reach.insert(reach.end(), most_shift_blocks, 0.0);
  std::vector<double> late_s;
  for (std::size_t begin = 0; begin + piece_blocks <= current.size(); begin += piece_blocks) {
    const auto shift_s = clear_shift_s(std::span(current).subspan(begin, piece_blocks),
                                       std::span(reach).subspan(begin, piece_blocks + 2 * most_shift_blocks));
    if (shift_s) late_s.push_back(*shift_s);
  }
  const double middle_s = numerics::median(late_s);
  const auto agree =
      std::ranges::count_if(late_s, [&](double each_s) { return std::abs(each_s - middle_s) < same_delay_s; });
  const bool sure = agree >= 3 && static_cast<double>(agree) >= agreeing_share * static_cast<double>(late_s.size());
  if (!sure || (middle_s > earliest_motion_s && middle_s < latest_motion_s)) return std::nullopt;
  return middle_s;
}

namespace {

std::string late_against(double late_s, std::string_view why, int decimals) {
  const std::string_view moved = late_s > 0 ? "position" : "current", by = late_s > 0 ? "current" : "position";
  return fmt::format(
      "{} comes {:.{}f} s late against {}, {}: two clocks or recorders, or a filter in one channel; shift its times by "
      "{:+.{}f} s, or record both with one clock",
      moved, std::abs(late_s), decimals, by, why, -std::abs(late_s), decimals);
}

}  // namespace

std::string shown_delay(double late_s) {
  return late_against(late_s, fmt::format("and a spool follows its solenoid within {:.2g} s", latest_motion_s), 2);
}

std::string induced_delay(const KnownCoil& coil, const RunMeans& run, double stroke_m) {
  constexpr std::size_t pieces = 3;  // twelve seconds
  if (!free_of_dither(run.steady_lines(), pieces)) return {};
  const auto late_s = induced_delay_s(run.motion(), coil, stroke_m);
  return late_s ? late_against(*late_s, "by the voltage that the spool's motion induces in the coil", 3) : "";
}

}  // namespace spoolflow::plausibility
