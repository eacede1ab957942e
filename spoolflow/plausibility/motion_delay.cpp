#include "spoolflow/plausibility/motion_delay.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/plausibility/limits.hpp"

namespace spoolflow::plausibility {

using recording::Channel;

namespace {

constexpr double block_s = 0.01;
constexpr std::size_t most_followed_blocks = 30'000, piece_blocks = 1000, most_shift_blocks = 500, change_blocks = 3;
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
  std::vector<double> power, correlation;
  for (std::size_t k = 0; k <= 2 * most_shift_blocks; ++k) {
    const Signal position = signal(reach.subspan(k, current.size()));
    power.push_back(position.squaredNorm());
    correlation.push_back(signal(current).dot(position));
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

void MotionDelay::add(double time_s, double position_m, double current_A) {
  if (!std::isfinite(time_s) || !std::isfinite(position_m + current_A)) return;
  if (!std::exchange(begun_, true)) begin_s_ = time_s;
  const double place = (time_s - begin_s_) / block_s;
  if (!(place >= 0) || place >= static_cast<double>(most_followed_blocks)) return;
  const auto block = static_cast<std::size_t>(place);
  if (block + 1 < position_m_.size()) return;  // times that run backwards
  if (block >= position_m_.size()) {
    for (std::vector<double>* sums : {&position_m_, &current_A_}) {
      if (!sums->empty()) sums->back() /= samples_;
      sums->resize(block + 1, std::nan(""));
      sums->back() = 0;
    }
    samples_ = 0;
  }
  position_m_.back() += position_m;
  current_A_.back() += current_A;
  ++samples_;
}

void MotionDelay::take(const std::array<std::vector<double>, recording::channel_count>& columns) {
  const auto column = [&](Channel channel) -> const std::vector<double>& {
    return columns[static_cast<std::size_t>(channel)];
  };
  const std::vector<double>&time_s = column(Channel::time), &position_m = column(Channel::position);
  const std::vector<double>& other_A = column(Channel::current_a);
  const bool both = !column(Channel::current_b).empty() && !other_A.empty();
  const std::vector<double>& current_A = column(both ? Channel::current_b : Channel::current);
  if (position_m.size() != time_s.size() || current_A.size() != time_s.size()) return;
  for (std::size_t k = 0; k < time_s.size(); ++k) add(time_s[k], position_m[k], current_A[k] - (both ? other_A[k] : 0));
}

std::optional<double> MotionDelay::late_s() const {
  if (position_m_.empty()) return std::nullopt;
  const std::vector<double> current = changes(current_A_);
  std::vector<double> reach = changes(position_m_);
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

std::string shown_delay(double late_s) {
  const std::string_view moved = late_s > 0 ? "position" : "current", by = late_s > 0 ? "current" : "position";
  return fmt::format(
      "{} comes {:.2f} s late against {}, and a spool follows its solenoid within {:.2g} s: two clocks or recorders, "
      "or a filter in one channel; shift its times by {:+.2f} s, or record both with one clock",
      moved, std::abs(late_s), by, latest_motion_s, -std::abs(late_s));
}

}  // namespace spoolflow::plausibility
