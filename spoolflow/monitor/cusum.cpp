#include "spoolflow/monitor/cusum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "spoolflow/numerics/crossing.hpp"

namespace spoolflow::monitor {
namespace {

double normal_below(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

}  // namespace

double average_run_length(double allowance, double limit, double mean, int states) {
  // State 0 is the empty sum, the others are equal cells up to the limit. Solves (1 - P) L = 1 by elimination.
  const auto n = static_cast<std::size_t>(states);
  const double width = 2 * limit / (2 * static_cast<double>(states) - 1);
  std::vector<double> below(2 * n);  // [n + d]: the next sum lies below the upper end of the cell d above this state
  for (std::size_t k = 0; k < 2 * n; ++k)
    below[k] = normal_below((static_cast<double>(k) - static_cast<double>(n) + 0.5) * width + allowance - mean);
  std::vector<double> matrix(n * n);
  std::vector<double> length(n, 1.0);
  for (std::size_t from = 0; from < n; ++from) {
    for (std::size_t to = 0; to < n; ++to) {
      const std::size_t upper = n + to - from;
      matrix[from * n + to] = (from == to ? 1.0 : 0.0) - (below[upper] - (to == 0 ? 0.0 : below[upper - 1]));
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t r = k + 1; r < n; ++r) {
      const double share = matrix[r * n + k] / matrix[k * n + k];
      if (share == 0) continue;
      for (std::size_t c = k; c < n; ++c) matrix[r * n + c] -= share * matrix[k * n + c];
      length[r] -= share * length[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t c = k + 1; c < n; ++c) length[k] -= matrix[k * n + c] * length[c];
    length[k] /= matrix[k * n + k];
  }
  return length[0];
}

double single_limit_for(double run_length) {
  return numerics::crossing({0, 12}, run_length, [](double limit) { return 1 / normal_below(-limit); });
}

double limit_for(double allowance, double run_length) {
  constexpr int steps = 6;
  constexpr double least_limit = 0.1;
  double limit = 1;  // where it is large, the run length goes with exp(2 allowance limit)
  for (int step = 0; step < steps; ++step) {
    const double ratio = run_length / average_run_length(allowance, limit);
    limit = std::max(least_limit, limit + std::log(ratio) / (2 * allowance));
  }
  return limit;
}

}  // namespace spoolflow::monitor
