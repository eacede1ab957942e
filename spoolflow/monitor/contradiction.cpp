#include "spoolflow/monitor/contradiction.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace spoolflow::monitor {
namespace {

/// A magnitude in SI, and half of its 95 % interval.
struct Known {
  double value, half;
};
Known known(const DirectionFindings& side, Magnitude magnitude) {
  const std::size_t k = index(magnitude);
  return {usual_fault[k] * side.value[k], 2 * usual_fault[k] * side.deviation[k]};
}

/// What the forces look like, and from what.
std::string looks_like(const DirectionFindings& side, Fault fault) {
  const Known preload = known(side, Magnitude::preload_loss), rate = known(side, Magnitude::rate_loss),
              turns = known(side, Magnitude::shorted_turns), zero = known(side, Magnitude::position_zero);
  switch (fault) {
    case Fault::spring:
      return fmt::format(
          "the springs' preload looks {:.2f} +- {:.2f} and their rate {:.2f} +- {:.2f} times the calibrated one: a "
          "current that reads too low, a spring that lost force, or another unit",
          1 - preload.value, preload.half, 1 - rate.value, rate.half);
    case Fault::coil:
      return fmt::format(
          "the coil pulls as with {:.1f} +- {:.1f} % fewer turns: a current that reads too high, shorted turns, or "
          "another unit",
          100 * turns.value, 100 * turns.half);
    case Fault::position_sensor:
      return fmt::format("the position reads {:.0f} +- {:.0f} um more than calibrated: its sensor was moved or changed",
                         1e6 * zero.value, 1e6 * zero.half);
    default:
      return "no single fault explains them: another unit or type, or several channels that read wrong";
  }
}

}  // namespace

std::string contradiction(Monitor& watch) {
  watch.finish();
  const std::vector<Cause> causes = watch.causes();
  const auto likeliest =
      std::ranges::find_if(causes, [](const Cause& cause) { return cause.fault != Fault::friction; });
  if (likeliest == causes.end() || likeliest->odds < contradiction_odds) return {};
  const auto fault = static_cast<std::size_t>(likeliest->fault);
  for (const DirectionFindings& side : watch.findings().side) {
    if (side.raised && (fault >= isolated_faults || side.likeliest[fault]))
      return fmt::format("{} (odds {:.0f} to 1)", looks_like(side, likeliest->fault), likeliest->odds);
  }
  return {};
}

void add_contradiction(Monitor& watch, const std::string& file, std::vector<std::string>& doubts) {
  const std::string found = contradiction(watch), name = std::filesystem::path(file).filename().string();
  if (!found.empty()) {
    doubts.push_back(
        fmt::format("{}: the forces contradict the model, so that flow and band are wrong: {}; mend the channel, or "
                    "calibrate this unit (`spoolflow monitor` shows more)",
                    name, found));
  } else if (const double share = watch.beyond_pressure_share(); share > most_beyond_share) {
    doubts.push_back(fmt::format(
        "{}: for {:.0f} % of the time the forces ask for a higher pressure difference than is calibrated: where the "
        "machine has it, declare [environment] highest_pressure_bar, and the band holds it; else current reads too "
        "high, position is off, or it is another unit, and flow and band are wrong",
        name, 100 * share));
  }
}

}  // namespace spoolflow::monitor
