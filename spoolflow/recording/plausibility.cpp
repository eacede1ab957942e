#include "spoolflow/recording/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {
namespace {

using units::Dimension;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Sampling: a valve moves within 10 to 100 ms, so nobody records it once in half a second; DAQ systems for benches end
// at 100 kS/s.
constexpr double longest_step_s = 0.5;
constexpr double shortest_step_s = 8e-6;

constexpr double much_larger = 99.0;  // mA to A, mm to m, Pa to bar; not bar to MPa, which no value distinguishes

bool in_range(double value, double lowest, double highest) {
  return value >= lowest && value <= highest;
}

bool is_port(Channel channel) {
  return channel == Channel::pressure_p || channel == Channel::pressure_a || channel == Channel::pressure_b ||
         channel == Channel::pressure_t;
}

}  // namespace

Plausibility::Limits Plausibility::limits_of(Channel channel, std::optional<double> stroke_m) {
  constexpr double none = 0.0;
  switch (dimension(channel)) {
    case Dimension::current:  // proportional solenoids: 0.3 to 4 A; switching ones up to some 10 A
      return {-50.0, 50.0, 0.01, "solenoids take 0.1 to 10 A", false};
    case Dimension::voltage:  // 12 and 24 V; 230 V where rectified mains drives the coil
      return {-500.0, 500.0, 0.1, "solenoids have 5 to 230 V", false};
    case Dimension::length:  // strokes: 0.5 to 20 mm
      if (stroke_m) return {-3.0 * *stroke_m, 3.0 * *stroke_m, *stroke_m / 200.0, "the stroke is known", false};
      return {-0.1, 0.1, 2e-5, "spools move by 0.5 to 20 mm", false};
    case Dimension::force:  // solenoids: 50 to 300 N; flow forces of the largest valves: below 2 kN
      return {-5e3, 5e3, 0.5, "forces on a spool are 1 to 2000 N", false};
    case Dimension::pressure:  // the return line may stay below 0.1 bar, a supply never does while it is on
      return {-2e6, 1e8, channel == Channel::pressure_downstream ? 1e3 : 1e4, "oil pressures are 0.1 to 1000 bar",
              true};
    case Dimension::temperature:  // oils thicken below -40 degC and burn above 200 degC
      return {213.15, 473.15, none, "oil is between -60 and 200 degC", false};
    case Dimension::volume_flow:  // size 32 valves: 1000 L/min
      return {-0.05, 0.05, 3e-7, "spool valves pass 0.1 to 3000 L/min", false};
    case Dimension::ratio:
      if (channel == Channel::position_set) return {-1.5, 1.5, none, "a command is a share of the stroke", false};
      break;
    default:
      break;
  }
  return {-infinity, infinity, none, "", false};
}

Plausibility::Plausibility(std::string file, const std::vector<BoundColumn>& columns, std::optional<double> stroke_m)
    : file_(std::move(file)), stroke_m_(stroke_m) {
  for (const BoundColumn& column : columns) {
    const bool larger_unit =
        column.unit.dimension == dimension(column.channel) &&  // not a share of the stroke
        std::any_of(units::all_units().begin(), units::all_units().end(), [&column](const units::Unit& unit) {
          return unit.dimension == column.unit.dimension && unit.factor >= much_larger * column.unit.factor;
        });
    watched_.push_back({&column, limits_of(column.channel, stroke_m), larger_unit, 0, infinity, -infinity, 0.0, 0.0,
                        std::numeric_limits<double>::quiet_NaN()});
  }
}

/// " in bar it would be 60 bar, ..." for every unit that would make `value` (in SI, as read now) plausible.
std::string Plausibility::better_units(const Watched& watched, double value, double least_factor) const {
  const units::Unit& now = watched.column->unit;
  if (now.dimension != dimension(watched.column->channel)) return {};  // a share of the stroke
  const bool is_time = now.dimension == Dimension::time;
  const double written = now.from_SI(value);
  std::string out;
  for (const units::Unit& unit : units::all_units()) {
    if (unit.dimension != now.dimension || unit.name == now.name || unit.factor < least_factor * now.factor) continue;
    const double then = unit.to_SI(written);
    const bool fits = is_time ? in_range(then, shortest_step_s, longest_step_s)
                              : in_range(then, watched.limits.lowest, watched.limits.highest) &&
                                    std::abs(then) >= watched.limits.smallest;
    if (fits) out += fmt::format("{}{}", out.empty() ? "" : " or ", unit.name);
  }
  const double share_m = written / 100 * stroke_m_.value_or(0);  // of a position in percent
  if (now.dimension == Dimension::length &&
      in_range(std::abs(share_m), watched.limits.smallest, 1.2 * stroke_m_.value_or(0)))
    out += fmt::format("{}percent of the stroke", out.empty() ? "" : " or ");
  return out;
}

/// What the channel has reached; 0 where nothing was measured yet.
double Plausibility::largest(const Watched& watched) {
  if (!(watched.lowest <= watched.highest)) return 0.0;
  return std::max(std::abs(watched.lowest), std::abs(watched.highest));
}

void Plausibility::take(std::size_t column, std::span<const double> values,
                        const std::function<std::string(std::size_t)>& place) {
  Watched& watched = watched_[column];
  const bool first_block = watched.samples == 0;
  watched.samples += values.size();
  if (watched.column->channel == Channel::time) {
    if (first_block) check_sampling(watched, values);
    return;
  }
  const double lowest = watched.limits.lowest;
  const double highest = watched.limits.highest;
  std::size_t beyond = 0;
  for (const double value : values) beyond += value < lowest || value > highest ? 1 : 0;
  if (100 * beyond > values.size() && (beyond > 1 || values.size() < 20)) {
    const auto first = std::ranges::find_if(values, [=](double value) { return value < lowest || value > highest; });
    const units::Unit& unit = watched.column->unit;
    // What a unit that is too small makes of its first value beyond fits many others, its largest one few.
    const double worst =
        *std::ranges::max_element(values, {}, [](double value) { return std::isnan(value) ? 0 : std::abs(value); });
    const std::string better = better_units(watched, worst, 0.0);
    throw RecordingError(fmt::format(
        "{}, column '{}': channel {} is {:.6g} {}, beyond {:.4g} to {:.4g} {} ({}); {}",
        place(static_cast<std::size_t>(first - values.begin())), watched.column->name, name(watched.column->channel),
        unit.from_SI(*first), unit.name, unit.from_SI(lowest), unit.from_SI(highest), unit.name, watched.limits.reason,
        better.empty() ? "check unit, scale and offset" : fmt::format("is its unit {} instead?", better)));
  }
  if (!watched.may_be_too_small || watched.limits.smallest == 0.0) return;
  if (largest(watched) >= watched.limits.smallest) return;  // finish() asks for no more
  for (const double value : values) {
    if (std::isnan(value)) continue;
    watched.lowest = std::min(watched.lowest, value);
    watched.highest = std::max(watched.highest, value);
    watched.sum += value;
    if (!std::isnan(watched.last)) watched.steps += std::abs(value - watched.last);
    watched.last = value;
  }
}

void Plausibility::finish() const {
  const auto reaches = [](const Watched& watched) { return largest(watched) >= watched.limits.smallest; };
  // The ports of a valve have one unit, and the return line or an idle port may stay below what a supply reaches.
  const bool a_port_reaches = std::ranges::any_of(
      watched_, [&](const Watched& watched) { return is_port(watched.column->channel) && reaches(watched); });
  for (const Watched& watched : watched_) {
    if (!watched.may_be_too_small || !(watched.lowest <= watched.highest)) continue;
    if (reaches(watched) || (a_port_reaches && is_port(watched.column->channel))) continue;
    const double reached = largest(watched);
    // White noise of any length has a range of 7 to 10 mean steps and a mean that is far smaller than one step; a
    // signal moves by many steps of its noise, or stands clear of zero.
    const double mean_step = watched.steps / static_cast<double>(watched.samples);
    const double mean = std::abs(watched.sum) / static_cast<double>(watched.samples);
    const bool moves = watched.highest - watched.lowest > 20.0 * mean_step;
    const bool one_sign = watched.lowest > 0.0 || watched.highest < 0.0;
    const bool stands_clear = watched.limits.level_is_signal && (one_sign || mean > 5.0 * mean_step);
    if (!moves && !stands_clear) continue;
    const std::string better = better_units(watched, reached, much_larger);
    if (better.empty()) continue;
    const units::Unit& unit = watched.column->unit;
    throw RecordingError(
        fmt::format("{}, column '{}': channel {} carries a signal but never exceeds {:.4g} {} ({}); is "
                    "its unit {} instead?",
                    file_, watched.column->name, name(watched.column->channel), std::abs(unit.from_SI(reached)),
                    unit.name, watched.limits.reason, better));
  }
}

/// By the median distance of the first block's time stamps.
void Plausibility::check_sampling(const Watched& time, std::span<const double> time_s) const {
  std::vector<double> steps_s;
  std::size_t backwards = 0;
  for (std::size_t k = 1; k < time_s.size(); ++k) {
    if (time_s[k] > time_s[k - 1]) steps_s.push_back(time_s[k] - time_s[k - 1]);
    if (time_s[k] < time_s[k - 1]) ++backwards;
  }
  if (steps_s.empty() && backwards > 1) {
    throw RecordingError(fmt::format(
        "{}, column '{}': the time runs backwards from sample to sample, from {:g} s on, and a sensor knows "
        "the past alone; give the samples in the order of time",
        file_, time.column->name, time_s.front()));
  }
  const bool rounded = 2 * steps_s.size() < time_s.size();  // such times step by their last digit, not by the sample
  if (steps_s.size() < 2 || rounded) return;
  const double apart_s = numerics::median(std::move(steps_s));
  if (in_range(apart_s, shortest_step_s, longest_step_s)) return;
  const std::string better = better_units(time, apart_s, 0.0);
  throw RecordingError(fmt::format(
      "{}, column '{}': the samples are {:.4g} s apart, which is not the rate of a valve's recording ({:g} to {:g} s); "
      "{}",
      file_, time.column->name, apart_s, shortest_step_s, longest_step_s,
      better.empty() ? "check the unit of time"
                     : fmt::format("is the unit of time {} instead of {}?", better, time.column->unit.name)));
}

}  // namespace spoolflow::recording
