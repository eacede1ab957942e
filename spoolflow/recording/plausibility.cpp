#include "spoolflow/recording/plausibility.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/recording/recording_error.hpp"

namespace spoolflow::recording {
namespace {

using units::Dimension;

/// Limits in SI. `smallest`: a channel whose largest magnitude stays below it, without being zero throughout, is scaled
/// wrongly; set a factor of ten or more below what sensors of a valve's bench resolve or reach.
struct Limits {
  double lowest;
  double highest;
  double smallest;
  const char* unit;
  const char* hint;
};

std::optional<Limits> limits_of(Channel channel) {
  switch (dimension(channel)) {
    case Dimension::time:
      return Limits{-1e10, 1e10, 0, "s", "is it in ms or us?"};
    case Dimension::current:
      return Limits{-100, 100, 2e-4, "A", "is the unit A or mA?"};  // solenoids: some 0.1 to 10 A
    case Dimension::voltage:
      return Limits{-1000, 1000, 0, "V", "is the unit V or mV?"};
    case Dimension::length:
      return Limits{-0.1, 0.1, 2e-6, "m", "is the unit m, mm or um?"};  // strokes: 0.5 to 20 mm
    case Dimension::ratio:
      return Limits{-10, 10, 0, "of the stroke", "is the unit percent or 1?"};
    case Dimension::force:
      return Limits{-1e5, 1e5, 0, "N", "is the unit N or kN?"};
    case Dimension::pressure:
      return Limits{-1e7, 2e8, 1000, "Pa", "is the unit Pa, kPa, MPa or bar?"};  // oil: 1 to 1000 bar
    case Dimension::temperature:
      return Limits{213, 473, 0, "K", "is the unit C or K?"};  // -60 to 200 C
    case Dimension::flow:
      return Limits{-0.1, 0.1, 0, "m3/s", "is the unit L/min, L/s or m3/s?"};
    case Dimension::none:
      break;
  }
  return std::nullopt;
}

}  // namespace

void Plausibility::take(const SampleBlock& block) {
  for (const Channel channel : all_channels()) {
    const auto& column = block.columns[static_cast<std::size_t>(channel)];
    const auto limits = limits_of(channel);
    if (column.empty() || !limits) continue;
    Extremes& extremes = extremes_[static_cast<std::size_t>(channel)];
    double lowest = extremes.seen ? extremes.lowest : INFINITY;
    double highest = extremes.seen ? extremes.highest : -INFINITY;
    for (const double value : column) {
      lowest = value < lowest ? value : lowest;
      highest = value > highest ? value : highest;
    }
    if (lowest > highest) continue;
    extremes = {lowest, highest, true};
    if (lowest < limits->lowest || highest > limits->highest) {
      throw RecordingError(fmt::format("{}: channel {} reaches {:.4g} {}, plausible are {:g} to {:g}; {}", file_,
                                       name(channel), lowest < limits->lowest ? lowest : highest, limits->unit,
                                       limits->lowest, limits->highest, limits->hint));
    }
  }
}

void Plausibility::check_sizes() const {
  for (const Channel channel : all_channels()) {
    const Extremes& extremes = extremes_[static_cast<std::size_t>(channel)];
    const auto limits = limits_of(channel);
    if (!extremes.seen || !limits || extremes.lowest == extremes.highest) continue;
    const double largest = std::fmax(std::abs(extremes.lowest), std::abs(extremes.highest));
    if (largest < limits->smallest) {
      throw RecordingError(
          fmt::format("{}: channel {} moves, but never beyond {:.4g} {}, which is implausibly small; {}", file_,
                      name(channel), largest, limits->unit, limits->hint));
    }
  }
}

}  // namespace spoolflow::recording
