#include "spoolflow/analysis/ishigami.hpp"

#include <cmath>
#include <numbers>

namespace spoolflow::analysis {
namespace {

constexpr double ishigami_a = 7;
constexpr double ishigami_b = 0.1;
constexpr double pi = std::numbers::pi;

bool holds(const Index& index, double known) {
  return index.lower <= known && known <= index.upper;
}

}  // namespace

double ishigami(const std::vector<double>& uniform) {
  const auto x = [&](std::size_t k) { return pi * (2 * uniform[k] - 1); };
  return std::sin(x(0)) + ishigami_a * std::pow(std::sin(x(1)), 2) + ishigami_b * std::pow(x(2), 4) * std::sin(x(0));
}

SelfCheck check_ishigami(std::uint32_t base_samples, std::uint64_t seed) {
  const SaltelliDesign design({1, 1, 1}, base_samples, seed);
  std::vector<double> outputs;
  for (std::size_t k = 0; k < design.points(); ++k) outputs.push_back(ishigami(design.point(k)));

  const double alone_1 = 0.5 * std::pow(1 + ishigami_b * std::pow(pi, 4) / 5, 2);
  const double alone_2 = ishigami_a * ishigami_a / 8;
  const double both_13 = ishigami_b * ishigami_b * std::pow(pi, 8) * (1.0 / 18 - 1.0 / 50);
  const double variance = alone_1 + alone_2 + both_13;
  SelfCheck out{base_samples,
                seed,
                sobol_indices(design, outputs, seed),
                {alone_1 / variance, alone_2 / variance, 0},
                {(alone_1 + both_13) / variance, alone_2 / variance, both_13 / variance},
                true};
  for (std::size_t f = 0; f < 3; ++f) {
    out.passed = out.passed && holds(out.found.factors[f].first_order, out.first_order[f]) &&
                 holds(out.found.factors[f].total, out.total[f]);
  }
  return out;
}

}  // namespace spoolflow::analysis
