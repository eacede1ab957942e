#include "spoolflow/monitor/cusum.hpp"

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
  std::vector<double> matrix(n * n);
  std::vector<double> length(n, 1.0);
  for (std::size_t from = 0; from < n; ++from) {
    const double at = static_cast<double>(from) * width;
    for (std::size_t to = 0; to < n; ++to) {
      const double centre = static_cast<double>(to) * width - at + allowance - mean;
      const double upper = normal_below(centre + 0.5 * width);
      const double lower = to == 0 ? 0.0 : normal_below(centre - 0.5 * width);
      matrix[from * n + to] = (from == to ? 1.0 : 0.0) - (upper - lower);
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
  constexpr int halvings = 40;  // each solves a chain
  const auto length = [allowance](double limit) { return average_run_length(allowance, limit); };
  return numerics::crossing({0.1, 30}, run_length, length, halvings);
}

}  // namespace spoolflow::monitor
