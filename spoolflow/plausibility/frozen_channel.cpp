#include "spoolflow/plausibility/frozen_channel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/relation.hpp"
#include "spoolflow/recording/channels/channel_unit.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

/// A channel, and one that shows whether what moves it goes on.
struct Driven {
  Channel channel, by;
  bool regulated = false;  ///< as a pressure and a coil's current, which rests at zero
};
constexpr std::array driven_channels{Driven{Channel::position, Channel::current},
                                     Driven{Channel::position, Channel::current_b},
                                     Driven{Channel::position, Channel::force},
                                     Driven{Channel::position, Channel::axial_force},
                                     Driven{Channel::current, Channel::position},
                                     Driven{Channel::voltage, Channel::current},
                                     Driven{Channel::force, Channel::position},
                                     Driven{Channel::axial_force, Channel::position},
                                     Driven{Channel::flow, Channel::position},
                                     Driven{Channel::current_a, Channel::position, true},
                                     Driven{Channel::current_b, Channel::position, true},
                                     Driven{Channel::pressure_upstream, Channel::position, true},
                                     Driven{Channel::pressure_downstream, Channel::position, true},
                                     Driven{Channel::pressure_difference, Channel::position, true}};

bool same_value(double one, double other) {
  constexpr double rounding = 1e-12;  // of sums over a block
  return std::abs(one - other) <= rounding * std::max(std::abs(one), std::abs(other));
}

/// The longest stretch of one value.
struct Stretch {
  std::size_t begin = 0, size = 0;

  [[nodiscard]] std::span<const double> of(const std::vector<double>& values) const {
    return std::span(values).subspan(begin, size);
  }
};
Stretch longest_stretch(const std::vector<double>& values) {
  Stretch longest;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!same_value(values[k], values[begin])) begin = k;
    if (k + 1 - begin > longest.size) longest = {begin, k + 1 - begin};
  }
  return longest;
}

/// A channel outside its stretch of one value.
struct Rest {
  double lowest = INFINITY, highest = -INFINITY;
  double count = 0, repeated = 0;  ///< values, and those like the one before

  [[nodiscard]] bool fine() const {
    constexpr double fewest = 20, most_repeated = 0.05;
    return count >= fewest && repeated <= most_repeated * count;
  }
  [[nodiscard]] bool has_within(double value) const {
    const double margin = edge_of_range * (highest - lowest);
    return value > lowest + margin && value < highest - margin;
  }
  [[nodiscard]] bool is_near_zero(double value) const {
    return std::abs(value) < edge_of_range * std::max(std::abs(lowest), std::abs(highest));
  }

 private:
  static constexpr double edge_of_range = 0.02;
};
Rest rest_of(const std::vector<double>& values, const Stretch& still) {
  Rest out;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if ((k >= still.begin && k < still.begin + still.size) || std::isnan(values[k])) continue;
    out.lowest = std::min(out.lowest, values[k]);
    out.highest = std::max(out.highest, values[k]);
    ++out.count;
    out.repeated += k > 0 && same_value(values[k], values[k - 1]);
  }
  return out;
}

double share_moved(const std::vector<double>& by, const Stretch& still) {
  const double whole = range_of(by);
  const std::span<const double> part = still.of(by);
  return whole > 0 ? range_of({part.begin(), part.end()}) / whole : 0;
}

bool is_frozen(bool regulated, const Rest& rest, double value, double moved) {
  if (!rest.fine()) return false;
  if (regulated) return !rest.is_near_zero(value) && moved > 0;
  return moved > (rest.has_within(value) ? 0 : frozen_beside_share);
}

/// What moves a channel; a flow moves as opening times the root of the pressure difference.
std::vector<double> drive_of(const Recording& means, const Driven& driven) {
  std::vector<double> out = means.column(driven.by);
  if (driven.channel != Channel::flow || !means.has(Channel::pressure_difference)) return out;
  const std::vector<double>& pressure_Pa = means.column(Channel::pressure_difference);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] *= std::sqrt(std::abs(pressure_Pa[k]));
  return out;
}

std::string oil_temperature_stands(const Recording& means, double shortest_s) {
  const std::vector<double>&values = means.column(Channel::oil_temperature), &time_s = means.column(Channel::time);
  if (values.empty() || !(range_of(time_s) >= shortest_s) || longest_stretch(values).size != values.size()) return {};
  return fmt::format(
      "oil_temperature is {:.4g} degC to the last digit for all {:.0f} s: the thermometer or its line is frozen, or it "
      "is "
      "typed in, which is sound only where the oil keeps that temperature; look at its wire and its column, and leave "
      "the channel out where the oil is not measured",
      units::degC_from_K(values.front()), range_of(time_s));
}

}  // namespace

std::string frozen_channel(const Recording& means) {
  const std::vector<double>& time_s = means.column(Channel::time);
  const Channel flow = means.has(Channel::axial_force) ? Channel::flow : Channel::flow_reference;
  for (const Driven& driven : driven_channels) {
    const std::vector<double>& values = means.column(driven.channel);
    if (values.empty() || !means.has(driven.by)) continue;
    const Stretch still = longest_stretch(values);
    const auto size = static_cast<double>(still.size), all = static_cast<double>(values.size());
    if (size < least_blocks || size < frozen_share * all || still.size == values.size()) continue;
    const double value = values[still.begin];
    // A pump that is off passes no flow at any opening.
    const bool regulated =
        driven.regulated || (driven.channel == Channel::flow && !means.has(Channel::pressure_difference));
    const double moved = share_moved(drive_of(means, driven), still);
    if (!is_frozen(regulated, rest_of(values, still), value, moved)) continue;
    return fmt::format(
        "{} is frozen at {} from {:.2f} to {:.2f} s while {} goes on: its wire, its amplifier or the recorder stopped; "
        "look at them and record it again, or cut that part",
        recording::name(driven.channel == Channel::flow ? flow : driven.channel), shown_value(driven.channel, value),
        time_s[still.begin], time_s[still.begin + still.size - 1], recording::name(driven.by));
  }
  return {};
}

std::string frozen_oil_temperature(const Recording& means) {
  return oil_temperature_stands(means, shortest_frozen_oil_s);
}

std::string frozen_oil_temperature_alone(const Recording& means) {
  if (!means.has(Channel::oil_temperature)) return {};
  const double halves = 2 * units::degC_from_K(means.column(Channel::oil_temperature).front());
  constexpr double rounding = 1e-6;
  const bool round = std::abs(halves - std::round(halves)) < rounding;
  return oil_temperature_stands(means, round ? shortest_round_oil_s : shortest_frozen_oil_s);
}

double oil_temperature_changes_per_s(const Recording& means) {
  const std::vector<double>& values = means.column(Channel::oil_temperature);
  double changes = 0;
  for (std::size_t k = 1; k < values.size(); ++k)
    changes += std::isfinite(values[k] + values[k - 1]) && !same_value(values[k], values[k - 1]);
  const double duration_s = range_of(means.column(Channel::time));
  return duration_s > 0 ? changes / duration_s : 0;
}

std::string standing_channel(const Recording& run, double stroke_m) {
  constexpr double changing_A = 0.1, changing_V = 3, moving_share = 0.2;
  std::vector<Channel> alive{Channel::position, Channel::current};
  for (const auto& [current, voltage] :
       {std::pair{Channel::current, Channel::voltage}, std::pair{Channel::current_a, Channel::voltage_a},
        std::pair{Channel::current_b, Channel::voltage_b}}) {
    if (range_of(run.column(current)) > changing_A) alive.push_back(voltage);
    if (range_of(run.column(voltage)) > changing_V) alive.push_back(current);
  }
  if (range_of(run.column(Channel::position)) > moving_share * stroke_m) alive.push_back(Channel::flow);
  for (const Channel channel : alive) {
    if (const std::optional<double> value = standing_value(run.column(channel))) {
      const Channel shown = channel == Channel::flow ? Channel::flow_reference : channel;
      const units::Unit unit = recording::usual_unit(shown);
      const std::string at = *value == 0 ? "0" : fmt::format("{:.3g} {}", unit.from_SI(*value), unit.name);
      return fmt::format("{} stands still at {} all along: look at its wire and its column in the channel map",
                         recording::name(shown), at);
    }
  }
  return {};
}

}  // namespace spoolflow::plausibility
