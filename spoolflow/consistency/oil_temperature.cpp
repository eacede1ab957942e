#include "spoolflow/consistency/oil_temperature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/consistency/limits.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::consistency {
namespace {

using recording::Channel;

/// A number of one unit read as if it were of another.
struct Misread {
  std::string_view looks;
  double K_per_K;  ///< true kelvins for one of those read
  double from_K;   ///< what is read where it is 0 K

  [[nodiscard]] double true_K(double read_K) const { return K_per_K * (read_K - from_K); }
};

constexpr double absolute_zero_degF = -459.67;
constexpr std::array misreadings{Misread{"in degF, not degC", 5.0 / 9, units::K_from_degC(absolute_zero_degF)},
                                 Misread{"in K, not degC", 1, units::kelvin_at_0_degC},
                                 Misread{"in degC where K was said", 1, -units::kelvin_at_0_degC}};

double median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return NAN;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

std::string temperature_in_another_unit(const recording::Recording& run, const model::Range& calibrated_K) {
  if (!run.has(Channel::oil_temperature) || !(calibrated_K.upper > 0)) return {};
  const double read_K = median(run.column(Channel::oil_temperature));
  const bool hot = read_K > std::max(calibrated_K.upper + usual_distance_K, hottest_usual_oil_K);
  if (!hot && !(read_K < coldest_oil_K)) return {};
  for (const Misread& misread : misreadings) {
    const double K = misread.true_K(read_K);
    if (!(K > calibrated_K.lower - usual_distance_K && K < calibrated_K.upper + usual_distance_K)) continue;
    const auto degC = [](double temperature_K) { return units::degC_from_K(temperature_K); };
    return fmt::format(
        "oil_temperature looks {}: so read it is {:.0f} degC and not {:.0f}; the model's valve was "
        "calibrated at {:.0f} to {:.0f} degC",
        misread.looks, degC(K), degC(read_K), degC(calibrated_K.lower), degC(calibrated_K.upper));
  }
  return {};
}

}  // namespace spoolflow::consistency
