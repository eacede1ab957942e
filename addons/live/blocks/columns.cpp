#include "addons/live/blocks/columns.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "addons/live/blocks/steps.hpp"

namespace spoolflow::fleet {
namespace {

/// Codes of a column: no value, a value that is missing now, and behind these the difference to the value before.
constexpr std::uint64_t no_value = 0, no_value_now = 1, first_difference = 2;
/// A longer period is none of samples.
constexpr std::int64_t longest_period = std::int64_t{1} << 31U;

void put(std::vector<std::uint8_t>& out, std::uint64_t number) {
  for (; number >= 0x80; number >>= 7U) out.push_back(static_cast<std::uint8_t>(number | 0x80U));
  out.push_back(static_cast<std::uint8_t>(number));
}

std::optional<std::uint64_t> take(std::span<const std::uint8_t>& bytes) {
  std::uint64_t number = 0;
  for (std::size_t k = 0; k < longest_number && k < bytes.size(); ++k) {
    number |= std::uint64_t{bytes[k] & 0x7FU} << 7 * k;
    if ((bytes[k] & 0x80U) != 0) continue;
    bytes = bytes.subspan(k + 1);
    return number;
  }
  return std::nullopt;
}

/// Differences near zero of either sign become small numbers: 0, -1, 1, -2 are 0, 1, 2, 3.
std::uint64_t folded(std::int64_t difference) {
  return (static_cast<std::uint64_t>(difference) << 1U) ^ (difference < 0 ? ~std::uint64_t{0} : 0);
}
std::int64_t unfolded(std::uint64_t number) {
  return static_cast<std::int64_t>((number >> 1U) ^ ((number & 1U) != 0 ? ~std::uint64_t{0} : 0));
}

std::int64_t steps(double value, double step) {
  return static_cast<std::int64_t>(value / step);
}

double nothing_of(std::uint64_t code) {
  return code == no_value_now ? std::numeric_limits<double>::infinity() : estimation::not_measured;
}

}  // namespace

ColumnLayout layout_of(std::span<const estimation::TimedSample> samples) {
  ColumnLayout out{.samples = samples.size()};
  std::int64_t last = 0, timed = 0;
  for (const estimation::TimedSample& sample : samples) {
    for (std::size_t bit = 0; bit < block_channels.size(); ++bit) {
      if (!std::isnan(member(sample, block_channels[bit]))) out.channels |= static_cast<std::uint16_t>(1U << bit);
    }
    if (std::isnan(sample.time_s)) continue;
    last = steps(sample.time_s, time_step_s);
    if (timed++ == 0) out.first_time = last;
  }
  if (timed > 1) out.period = (last - out.first_time) / (timed - 1);
  if (std::abs(out.period) > longest_period) out.period = 0;
  return out;
}

std::vector<std::uint8_t> write_columns(const ColumnLayout& layout, std::span<const estimation::TimedSample> samples) {
  std::vector<std::uint8_t> out;
  out.reserve(samples.size() * 6);
  std::int64_t expected = layout.first_time;
  for (const estimation::TimedSample& sample : samples) {
    if (std::isnan(sample.time_s)) {
      put(out, no_value);
      continue;
    }
    const std::int64_t time = steps(sample.time_s, time_step_s);
    put(out, folded(time - expected) + first_difference);
    expected = time + layout.period;
  }
  for (std::size_t bit = 0; bit < block_channels.size(); ++bit) {
    if ((layout.channels >> bit & 1U) == 0) continue;
    std::int64_t before = 0;
    for (const estimation::TimedSample& sample : samples) {
      const double value = member(sample, block_channels[bit]);
      if (std::isnan(value)) {
        put(out, no_value);
      } else if (std::isinf(value)) {
        put(out, no_value_now);
      } else {
        const std::int64_t now = steps(value, block_channels[bit].step);
        put(out, folded(now - before) + first_difference);
        before = now;
      }
    }
  }
  return out;
}

bool read_columns(const ColumnLayout& layout, std::span<const std::uint8_t> bytes,
                  std::vector<estimation::TimedSample>& samples) {
  constexpr double none = estimation::not_measured;
  samples.assign(layout.samples, {none, none, none, none, none, none, none, {none, none, none, none}});
  /// The next number of a column on from `before`, which stays where there is none; false where it lies beyond `last`.
  const auto next = [&bytes](std::int64_t& before, std::int64_t last, std::uint64_t& code) {
    const auto number = take(bytes);
    if (!number) return false;
    code = *number;
    if (code < first_difference) return true;
    // Unsigned: what runs over is beyond the last in any case.
    const auto difference = static_cast<std::uint64_t>(unfolded(code - first_difference));
    const auto value = static_cast<std::int64_t>(static_cast<std::uint64_t>(before) + difference);
    if (value < -last || value > last) return false;
    before = value;
    return true;
  };
  std::uint64_t code = 0;
  std::int64_t time = layout.first_time;
  for (estimation::TimedSample& sample : samples) {
    if (!next(time, last_time, code) || code == no_value_now) return false;
    if (code == no_value) continue;
    sample.time_s = static_cast<double>(time) * time_step_s;
    time += layout.period;
  }
  for (std::size_t bit = 0; bit < block_channels.size(); ++bit) {
    if ((layout.channels >> bit & 1U) == 0) continue;
    const BlockChannel& channel = block_channels[bit];
    std::int64_t value = 0;
    for (estimation::TimedSample& sample : samples) {
      if (!next(value, last_value, code)) return false;
      if (code == no_value_now && channel.member != &estimation::TimedSample::current_a_A) return false;
      member(sample, channel) = code < first_difference ? nothing_of(code) : static_cast<double>(value) * channel.step;
    }
  }
  return bytes.empty();
}

}  // namespace spoolflow::fleet
