#include "spoolflow/plausibility/signals/sample_grid.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace spoolflow::plausibility {
namespace {

using recording::Channel;

constexpr std::array watched{Channel::position, Channel::current,   Channel::current_a, Channel::current_b,
                             Channel::voltage,  Channel::voltage_a, Channel::voltage_b};
constexpr std::array currents{Channel::current, Channel::current_a, Channel::current_b};

constexpr double fewest_intervals = 200;
constexpr double most_usual_share = 0.4, usual_share = 0.75;  ///< of intervals: the commonest, and with its like
constexpr double power_samples = 512;
constexpr double bend_share = 0.4;          ///< of the RMS of second differences; white noise exceeds it in two thirds
constexpr double straight_share = 0.02;     ///< RMS of second differences between bends over that of bends
constexpr double fine_share = 5;            ///< mean change over the smallest
constexpr double slowest_sound_s = 2.5e-3;  ///< between samples of the slower recorder
constexpr double coarse_share = 0.007;      ///< of the largest current; 1 % leaves 88 % of a ramp in its band
constexpr double idle_share = 0.1;          ///< of the largest current of both coils
constexpr double rounding_A = 1e-7;

const ChannelGrid& of(const std::array<ChannelGrid, recording::channel_count>& channels, Channel channel) {
  return channels[static_cast<std::size_t>(channel)];
}

}  // namespace

std::size_t Intervals::usual() const {
  double all = 0;
  for (const std::uint32_t count : count_) all += count;
  const auto most = std::ranges::max_element(count_);
  const auto usual = static_cast<std::size_t>(most - count_.begin());
  if (all < fewest_intervals || usual < 2 || *most < most_usual_share * all) return 1;
  double like = usual + 1 < count_.size() ? count_[usual + 1] : 0;
  if (usual > 2) like += count_[usual - 1];
  for (std::size_t k = usual; k < count_.size(); k += usual) like += count_[k];
  return like > usual_share * all ? usual : 1;
}

void ChannelGrid::take(double value) {
  if (std::isnan(value)) {
    in_row = 0;
    return;
  }
  largest = std::max(largest, std::abs(value));
  changes.step();
  bent.step();
  const double change = value - last, bend = change - (last - before);
  if (in_row > 0 && change != 0) {
    changes.event();
    change_sum += std::abs(change);
    ++changed;
    if (std::abs(change) > rounding_A * largest && (least_change == 0 || std::abs(change) < least_change))
      least_change = std::abs(change);
  }
  if (in_row > 1) {
    const bool bends_here = bend * bend > bend_share * bend_share * bend_power;
    if (bends_here) bent.event();
    (bends_here ? power_of_bends : power_between) += bend * bend;
    (bends_here ? bends : between) += 1;
    bend_power += (bend * bend - bend_power) / power_samples;
  }
  before = in_row > 0 ? last : value;
  last = value;
  ++in_row;
}

std::size_t ChannelGrid::held() const {
  return changed > 0 && change_sum / changed > fine_share * least_change ? changes.usual() : 1;
}

std::size_t ChannelGrid::straight() const {
  if (!(bends > 0) || !(between > 0)) return 1;
  const bool straight = power_between / between < straight_share * straight_share * power_of_bends / bends;
  return straight ? bent.usual() : 1;
}

void SampleGrid::take(const std::array<std::vector<double>, recording::channel_count>& columns) {
  for (const double time_s : columns[static_cast<std::size_t>(Channel::time)]) {
    if (std::isnan(time_s)) continue;
    if (samples_++ == 0) first_s_ = time_s;
    last_s_ = time_s;
  }
  for (const Channel channel : watched) {
    const auto k = static_cast<std::size_t>(channel);
    for (const double value : columns[k]) channels_[k].take(value);
  }
}

std::string SampleGrid::resampled() const {
  const double step_s = (last_s_ - first_s_) / std::max(samples_ - 1, 1.0);
  for (const bool is_held : {true, false}) {
    std::size_t samples = 1;
    std::string names;
    int count = 0;
    for (const Channel channel : watched) {
      const std::size_t usual = is_held ? of(channels_, channel).held() : of(channels_, channel).straight();
      if (usual < 2 || (samples > 1 && usual != samples)) continue;
      samples = usual;
      names += fmt::format("{}{}", count++ == 0 ? "" : ", ", recording::name(channel));
    }
    const double slower_s = static_cast<double>(samples) * step_s;
    if (count < (is_held ? 1 : 2) || !(slower_s > slowest_sound_s)) continue;
    return fmt::format(
        "{}: {} {} samples, as of a recorder of some {:.0f} Hz resampled to {:.4g} Hz: what the valve did in between "
        "is lost, and the band does not know of it; record at 1 kHz, or export at the recorder's own rate",
        names, is_held ? "each value is held for" : "every value lies on a straight line over", samples, 1 / slower_s,
        1 / step_s);
  }
  return {};
}

std::string SampleGrid::coarse_current() const {
  constexpr double fewest_samples = 100;
  if (samples_ < fewest_samples) return {};
  double largest_A = 0;
  for (const Channel channel : currents) largest_A = std::max(largest_A, of(channels_, channel).largest);
  for (const Channel channel : currents) {
    const ChannelGrid& grid = of(channels_, channel);
    if (grid.largest < idle_share * largest_A || !(grid.least_change > coarse_share * grid.largest)) continue;
    return fmt::format(
        "{} comes in steps of {:.2g} mA, {:.1f} % of its largest value, and the magnetic force in steps with it: the "
        "band is too narrow; record it in a smaller range, with more digits or bits",
        recording::name(channel), 1e3 * grid.least_change, 100 * grid.least_change / grid.largest);
  }
  return {};
}

}  // namespace spoolflow::plausibility
