#include "spoolflow/calibration/flow_bench/contradictions.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/flow_bench/tracked_run.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using recording::Recording;

/// The median of what `value` gives of the samples for which `counts`; NaN where hardly any do.
template <class Counts, class Value>
double median_where(const Recording& recording, const Counts& counts, const Value& value) {
  std::vector<double> out;
  for (std::size_t k = 0; k < recording.size(); ++k) {
    if (!counts(k)) continue;
    const double each = value(k);
    if (std::isfinite(each)) out.push_back(each);
  }
  constexpr std::size_t least_samples = 20;
  return out.size() < least_samples ? std::nan("") : numerics::median(std::move(out));
}

/// The same of samples whose pressure difference lies between two shares of the highest one that counts.
template <class Counts, class Value>
double median_at(const Recording& recording, const std::vector<double>& pressure_Pa, double from_share, double to_share,
                 const Counts& counts, const Value& value) {
  double highest_Pa = 0;
  for (std::size_t k = 0; k < recording.size(); ++k) {
    if (counts(k) && std::isfinite(pressure_Pa[k])) highest_Pa = std::max(highest_Pa, pressure_Pa[k]);
  }
  const auto between = [&](std::size_t k) {
    return counts(k) && pressure_Pa[k] > from_share * highest_Pa && pressure_Pa[k] < to_share * highest_Pa;
  };
  return median_where(recording, between, value);
}

/// "-2.40 to 0.01 mm"
std::string span_mm(std::span<const double> position_m) {
  double lowest_m = INFINITY, highest_m = -INFINITY;
  for (const double each_m : position_m) {
    lowest_m = std::fmin(lowest_m, each_m);
    highest_m = std::fmax(highest_m, each_m);
  }
  return fmt::format("{:.2f} to {:.2f} mm", 1e3 * lowest_m + 0.0, 1e3 * highest_m + 0.0);  // no -0
}

/// Current that holds the spool open, and the coil's resistance.
void judge_coil(std::vector<std::string>& to, const Recording& recording, const ValveFigures& valve) {
  const std::string file = recording.file.filename().string();
  const auto position_m = recording[Channel::position];
  const auto current_A = recording[Channel::current];
  const auto open = [&](std::size_t k) { return position_m[k] > 0.5 * valve.stroke_m; };
  const double holds_A = median_where(recording, open, [&](std::size_t k) { return current_A[k]; });
  if (std::isnan(holds_A)) {
    const bool opens = std::isfinite(median_where(recording, open, [&](std::size_t k) { return position_m[k]; }));
    to.push_back(opens
                     ? fmt::format("{}: channel current has no values where the valve is open; look at its column in "
                                   "the channel map, or record it again",
                                   file)
                     : fmt::format("{}: channel position hardly passes half the stroke of {:.2f} mm: it is {}; its "
                                   "sign, its unit or the campaign's stroke_mm is wrong, or the strokes are too short",
                                   file, 1e3 * valve.stroke_m, span_mm(position_m)));
    return;
  }
  if (holds_A < 0.01 || holds_A > 30) {
    to.push_back(
        fmt::format("{}: channel current is {:.4g} A where the valve is open, 0.01 to 30 A opens one; its sign or "
                    "unit is wrong, or position counts from the open end",
                    file, holds_A));
    return;
  }
  if (!recording.has(Channel::voltage)) return;
  const auto voltage_V = recording[Channel::voltage];
  const double resistance_Ohm = median_where(
      recording, [&](std::size_t k) { return current_A[k] > 0.5 * holds_A; },
      [&](std::size_t k) { return voltage_V[k] / current_A[k]; });
  if (resistance_Ohm > 0.2 && resistance_Ohm < 500) return;
  to.push_back(
      fmt::format("{}: channel voltage over current is {:.4g} Ohm, 0.2 to 500 Ohm is a coil; the sign or the unit "
                  "of one of both is wrong, or the voltage is not the coil's",
                  file, resistance_Ohm));
}

/// Flow and pressure difference of one recording under pressure.
void judge_flow(std::vector<std::string>& to, const Recording& recording, const ValveFigures& valve) {
  const std::string file = recording.file.filename().string();
  const auto position_m = recording[Channel::position];
  const auto flow_m3_per_s = recording[Channel::flow_reference];
  const std::vector<double> pressure_Pa = pressure_difference_Pa(recording);
  const auto open = [&](std::size_t k) { return position_m[k] > 0.8 * valve.stroke_m; };
  const double held_Pa = median_where(recording, open, [&](std::size_t k) { return pressure_Pa[k]; });
  const double flow = median_where(recording, open, [&](std::size_t k) { return flow_m3_per_s[k]; });
  if (std::isnan(held_Pa) || std::isnan(flow)) return;  // judge_coil says why
  if (held_Pa < 1e5 || held_Pa > 7e7) {
    to.push_back(
        fmt::format("{}: channel pressure_difference is {:.4g} bar where the valve is open, 1 to 700 bar is "
                    "credible; its sign or unit is wrong, its ports are swapped, or the pump was off",
                    file, 1e-5 * held_Pa));
    return;
  }
  const double share = flow / valve.rated_flow_m3_per_s;
  if (share < 0.02 || share > 20) {
    to.push_back(
        fmt::format("{}: channel flow_reference is {:.4g} L/min where the valve is open, {:.3g} to {:.3g} L/min go "
                    "with its rated flow; its sign or unit is wrong, or the meter is in another line",
                    file, 6e4 * flow, 6e4 * 0.02 * valve.rated_flow_m3_per_s, 6e4 * 20 * valve.rated_flow_m3_per_s));
    return;
  }
  // Over a sharp edge the flow goes with the root of the pressure difference, whatever that is.
  const auto conductance = [&](double from_share, double to_share) {
    return median_at(recording, pressure_Pa, from_share, to_share, open,
                     [&](std::size_t k) { return flow_m3_per_s[k] / std::sqrt(pressure_Pa[k]) / position_m[k]; });
  };
  constexpr double most_apart = 1.35;
  const double ratio = conductance(0.8, 2) / conductance(0.01, 0.7);
  if (std::isnan(ratio) || (ratio < most_apart && ratio > 1 / most_apart)) return;
  to.push_back(fmt::format(
      "{}: at high pressure differences the flow over their root is {:.2f} times that at low ones, {:.2f} to {:.2f} is "
      "an "
      "edge's; pressure_difference is not across the edges that the flow passes, or flow and pressure are swapped",
      file, ratio, 1 / most_apart, most_apart));
}

/// A meter that shows the same with the spool closed at low and at high pressure differences: what leaks goes with
/// their root at the least.
void judge_meter_zero(std::vector<std::string>& to, const Recording& recording, const ValveFigures& valve) {
  constexpr double closed_share = 0.02, least_zero_share = 0.01, most_apart = 1.5;
  const auto position_m = recording[Channel::position];
  const auto flow_m3_per_s = recording[Channel::flow_reference];
  const std::vector<double> pressure_Pa = pressure_difference_Pa(recording);
  const auto rests = [&](std::size_t k) { return std::abs(position_m[k]) < closed_share * valve.stroke_m; };
  const auto closed = [&](double from_share, double to_share) {
    return median_at(recording, pressure_Pa, from_share, to_share, rests,
                     [&](std::size_t k) { return flow_m3_per_s[k]; });
  };
  const double low = closed(0.01, 0.3), high = closed(0.7, 2), ratio = high / low;
  if (!(std::abs(low) > least_zero_share * valve.rated_flow_m3_per_s) ||
      !(ratio < most_apart && ratio > 1 / most_apart))
    return;
  to.push_back(fmt::format(
      "{}: channel flow_reference is {:.3g} L/min while the spool is closed, at low pressure differences as "
      "at high ones, where oil that leaks goes with their root: the zero of the meter is off; give "
      "flow_reference that offset in the channel map, or set the meter to zero and record it again",
      recording.file.filename().string(), 6e4 * low));
}

}  // namespace

std::vector<std::string> contradictions_of(const FlowBenchRecordings& recordings, const ValveFigures& valve) {
  std::vector<std::string> out;
  for (const Recording* each : recordings.unpressurised) judge_coil(out, *each, valve);
  for (const Recording* each : recordings.all_metering()) {
    judge_coil(out, *each, valve);
    judge_flow(out, *each, valve);
    judge_meter_zero(out, *each, valve);
  }
  return out;
}

}  // namespace spoolflow::calibration
