#include "spoolflow/plausibility/position_resolution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/signals/fourth_difference.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {
namespace {

constexpr std::size_t stretch_samples = 4096;
constexpr double slowest_step_s = 0.005;
constexpr std::size_t fewest_samples = 500;
constexpr std::size_t most_stretches = 10'000;  // enough for the longest run
constexpr double no_change_m = 1e-10;           // rounding of numbers

/// White noise leaves differences of fourth order alike by chance only from the fifth sample on; dither and a position
/// loop that hunts leave them alike one period later.
constexpr std::size_t first_lag = 5, last_lag = 200, samples_for_period = 1024;
constexpr double alike_by_chance = 0.3;  // of noise nowhere more than 0.2
constexpr double striking_ratio = 1.5;   // noise of one stretch over the least of those before

/// Whether signs of one piece come again after some lag: mean of their products.
bool comes_again(std::span<const double> differences_m) {
  const std::size_t count = differences_m.size();
  std::array<std::int8_t, samples_for_period> sign{};
  for (std::size_t k = 0; k < count; ++k) sign[k] = differences_m[k] < 0 ? -1 : 1;
  for (std::size_t lag = first_lag; lag <= last_lag && lag + samples_for_period / 4 < count; ++lag) {
    int alike = 0;
    for (std::size_t k = lag; k < count; ++k) alike += sign[k] * sign[k - lag];
    if (alike > alike_by_chance * static_cast<double>(count - lag)) return true;
  }
  return false;
}

/// Whether any piece of a stretch does: a run may rest first, and dither move the spool for part of the time.
bool is_periodic(std::span<const double> differences_m) {
  for (; differences_m.size() > samples_for_period; differences_m = differences_m.subspan(samples_for_period))
    if (comes_again(differences_m.first(samples_for_period))) return true;
  return comes_again(differences_m);
}

}  // namespace

void PositionResolution::take(std::span<const double> time_s, std::span<const double> position_m) {
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    const double value = position_m[k];
    if (std::isnan(value + time_s[k])) continue;
    if (samples_++ == 0) first_s_ = time_s[k];
    last_s_ = time_s[k];
    if (!stretch_.empty()) {
      const double change_m = std::abs(value - stretch_.back());
      if (change_m > no_change_m && (least_change_m_ == 0 || change_m < least_change_m_)) least_change_m_ = change_m;
    }
    stretch_.push_back(value);
    if (stretch_.size() == stretch_samples) judge_stretch();
  }
}

/// Of fourth_. It lies near that of the stretch before, mostly: only what is as large is put in order.
double PositionResolution::lower_quartile() {
  const std::size_t rank = fourth_.size() / 4;
  const double least_m = 0.8 * quartile_m_, most_m = 1.25 * quartile_m_;
  near_.resize(fourth_.size());
  std::size_t below = 0, near = 0;
  for (const double difference_m : fourth_) {  // without a branch: noise falls as it likes
    near_[near] = difference_m;
    below += static_cast<std::size_t>(difference_m < least_m);
    near += static_cast<std::size_t>(difference_m >= least_m) & static_cast<std::size_t>(difference_m <= most_m);
  }
  const bool found = below <= rank && rank < below + near;
  const auto begin = found ? near_.begin() : fourth_.begin();
  const auto end = found ? near_.begin() + static_cast<std::ptrdiff_t>(near) : fourth_.end();
  const auto quarter = begin + static_cast<std::ptrdiff_t>(found ? rank - below : rank);
  std::nth_element(begin, quarter, end);
  return *quarter;
}

/// By the lower quartile of the differences' sizes: slips of the spool fill the upper ones where samples are slow. A
/// stretch in which dither moves the spool is no measure of noise; asked only where there is more of it than before.
void PositionResolution::judge_stretch() {
  if (stretch_.size() >= fewest_samples && noise_m_.size() < most_stretches) {
    differences_.clear();
    fourth_.clear();
    for (std::size_t k = 4; k < stretch_.size(); ++k) {
      differences_.push_back(fourth_difference(&stretch_[k - 4]));
      fourth_.push_back(std::abs(differences_.back()));
    }
    quartile_m_ = lower_quartile();
    const double noise_m = white_noise(quartile_m_);
    if (!(noise_m > striking_ratio * least_noise_m_) || !is_periodic(differences_)) {
      noise_m_.push_back(noise_m);
      least_noise_m_ = noise_m_.size() == 1 ? noise_m : std::min(least_noise_m_, noise_m);
    }
  }
  stretch_.erase(stretch_.begin(), stretch_.end() - 1);
}

double PositionResolution::noise_m() const {
  if (last_s_ - first_s_ > slowest_step_s * static_cast<double>(samples_)) return std::nan("");
  PositionResolution whole = *this;
  if (!whole.stretch_.empty()) whole.judge_stretch();
  return whole.noise_m_.empty() ? std::nan("") : numerics::median(whole.noise_m_);
}

double PositionResolution::step_m() const {
  return least_change_m_;
}

std::string coarse_position(const PositionResolution& resolution, double noise_m) {
  if (!(noise_m > 0)) return {};
  const auto coarse = [&](std::string_view as, double value_m, std::string_view costs) {
    return fmt::format(
        "position comes {} {:.2g} um, and the model's valve was calibrated with noise of {:.2g} um: {}; record it as "
        "finely as the bench tests were, or calibrate from bench tests recorded like this",
        as, units::mm_from_m(value_m) * 1e3, units::mm_from_m(noise_m) * 1e3, costs);
  };
  if (resolution.step_m() > position_step_noises * noise_m) {
    return coarse("in steps of", resolution.step_m(),
                  "the sensor takes steps for motion of the spool, and its band is too narrow");
  }
  if (resolution.noise_m() > position_noise_factor * noise_m) {
    return coarse("with noise of", resolution.noise_m(),
                  "the sensor does not see a slow spool move, and its band widens to several percent");
  }
  return {};
}

}  // namespace spoolflow::plausibility
