#include "spoolflow/report/figures/ticks.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {

Ticks round_ticks(double lowest, double highest, int wanted) {
  Ticks out;
  if (!(highest > lowest)) return out;
  const double rough = (highest - lowest) / std::max(1, wanted);
  const double magnitude = std::pow(10.0, std::floor(std::log10(rough)));
  const auto first = [&](double step) { return std::ceil(lowest / step - 1e-9); };
  const auto last = [&](double step) { return std::floor(highest / step + 1e-9); };
  double step = magnitude;
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    if (factor > 1 && last(factor * magnitude) - first(factor * magnitude) < 1) break;  // a single mark shows no scale
    step = factor * magnitude;
    if (step >= rough * (1 - 1e-9)) break;
  }
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  for (double k = first(step); k <= last(step); k += 1) {
    out.at.push_back(k * step);
    out.text.push_back(fixed(k * step, decimals));
  }
  return out;
}

}  // namespace spoolflow::report
