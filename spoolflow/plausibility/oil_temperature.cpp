#include "spoolflow/plausibility/oil_temperature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/units/conversion.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;

/// Numbers of one unit that are read in another.
struct Misread {
  std::string_view looks;
  std::string_view unit, read_in;  ///< of units::all_units()

  [[nodiscard]] double true_K(double read_K) const {
    return units::unit_named(unit)->to_SI(units::unit_named(read_in)->from_SI(read_K));
  }
};

constexpr std::array misreadings{Misread{"in degF, not degC", "degF", "C"}, Misread{"in K, not degC", "K", "C"},
                                 Misread{"in degC where K was said", "C", "K"}};

}  // namespace

std::string temperature_in_another_unit(const recording::Recording& run, const model::Range& expected_K,
                                        std::string_view whence) {
  if (!run.has(Channel::oil_temperature) || !(expected_K.upper > 0)) return {};
  const double read_K = numerics::median(run.column(Channel::oil_temperature));
  const bool hot = read_K > std::max(expected_K.upper + usual_distance_K, hottest_usual_oil_K);
  if (!hot && !(read_K < coldest_oil_K)) return {};
  for (const Misread& misread : misreadings) {
    const double K = misread.true_K(read_K);
    if (!(K > expected_K.lower - usual_distance_K && K < expected_K.upper + usual_distance_K)) continue;
    return fmt::format("oil_temperature looks {}: so read it is {:.0f} degC and not {:.0f}; {} {:.0f} to {:.0f} degC",
                       misread.looks, units::degC_from_K(K), units::degC_from_K(read_K), whence,
                       units::degC_from_K(expected_K.lower), units::degC_from_K(expected_K.upper));
  }
  return {};
}

std::string leaping_temperature(const recording::Recording& run) {
  if (!run.has(Channel::oil_temperature) || !run.has(Channel::time)) return {};
  const std::vector<double>&time_s = run.column(Channel::time), &read_K = run.column(Channel::oil_temperature);
  for (std::size_t k = 2; k + 1 < read_K.size(); ++k) {
    // One block may hold both sides of the leap.
    if (!(std::abs(read_K[k] - read_K[k - 2]) > oil_leap_K) || time_s[k] - time_s[k - 2] > lasting_leap_s) continue;
    std::vector<double> before, after;
    for (std::size_t j = k - 1; j-- > 0 && time_s[k] - time_s[j] < lasting_leap_s;) before.push_back(read_K[j]);
    for (std::size_t j = k; j < read_K.size() && time_s[j] - time_s[k] < lasting_leap_s; ++j)
      after.push_back(read_K[j]);
    const double from_K = numerics::median(before), to_K = numerics::median(after);
    if (!(std::abs(to_K - from_K) > oil_leap_K)) continue;
    return fmt::format(
        "oil_temperature leaps from {:.1f} to {:.1f} degC at {:.1f} s, and no oil does: its thermometer starts late, "
        "or "
        "a wire is loose; the sensor takes a leap for a fault and keeps to the first value that an oil may have for 20 "
        "s "
        "more; cut off the part with the wrong one, or leave the channel out",
        units::degC_from_K(from_K), units::degC_from_K(to_K), time_s[k]);
  }
  return {};
}

}  // namespace spoolflow::plausibility
