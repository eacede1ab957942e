#pragma once
#include <string>
#include <vector>

namespace spoolflow::report {

/// Where an axis is marked, and with what.
struct Ticks {
  std::vector<double> at;
  std::vector<std::string> text;  ///< as many decimals as the step needs
};

/// Round numbers (1, 2 or 5 times a power of ten apart) that divide [lowest, highest] into about `wanted` steps;
/// two of them at least.
[[nodiscard]] Ticks round_ticks(double lowest, double highest, int wanted);

}  // namespace spoolflow::report
