#include "spoolflow/uncertainty/budget.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spoolflow::uncertainty {
namespace {

double correlation_of(const std::vector<Correlation>& correlations, InputQuantity a, InputQuantity b) {
  if (a == b) return 1;
  for (const Correlation& c : correlations) {
    if ((c.one == a && c.other == b) || (c.one == b && c.other == a)) return c.coefficient;
  }
  return 0;
}

/// Which lines hang together through correlations: the number of a line's cluster.
std::vector<std::size_t> clusters_of(const std::vector<BudgetLine>& lines,
                                     const std::vector<Correlation>& correlations) {
  std::vector<std::size_t> cluster(lines.size());
  for (std::size_t k = 0; k < cluster.size(); ++k) cluster[k] = k;
  for (std::size_t a = 0; a < cluster.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const InputQuantity one = lines[a].input.quantity;
      const InputQuantity other = lines[b].input.quantity;
      if (correlation_of(correlations, one, other) == 0 || cluster[a] == cluster[b]) continue;
      std::replace(cluster.begin(), cluster.end(), cluster[a], cluster[b]);
    }
  }
  return cluster;
}

}  // namespace

double effective_degrees_of_freedom(const std::vector<BudgetLine>& lines,
                                    const std::vector<Correlation>& correlations) {
  const std::vector<std::size_t> cluster = clusters_of(lines, correlations);
  double sum = 0;
  for (std::size_t c = 0; c < cluster.size(); ++c) {
    double share = 0;
    double fewest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < cluster.size(); ++k) {
      if (cluster[k] != c) continue;
      share += lines[k].share;
      if (lines[k].contribution_m3_per_s != 0) fewest = std::min(fewest, lines[k].degrees_of_freedom);
    }
    if (std::isfinite(fewest)) sum += share * share / fewest;
  }
  return sum > 0 ? std::max(1.0, 1 / sum) : std::numeric_limits<double>::infinity();
}

Budget combine(std::vector<BudgetLine> lines, std::vector<Correlation> correlations) {
  Budget out{std::move(lines), std::move(correlations)};
  double variance = 0;
  for (BudgetLine& line : out.lines) {
    double together = 0;
    for (const BudgetLine& other : out.lines) {
      together +=
          correlation_of(out.correlations, line.input.quantity, other.input.quantity) * other.contribution_m3_per_s;
    }
    line.share = line.contribution_m3_per_s * together;
    variance += line.share;
  }
  variance = std::max(variance, 0.0);
  for (BudgetLine& line : out.lines) line.share = variance > 0 ? line.share / variance : 0;
  out.combined_m3_per_s = std::sqrt(variance);
  out.degrees_of_freedom = effective_degrees_of_freedom(out.lines, out.correlations);
  out.coverage_factor = coverage_factor_95(out.degrees_of_freedom);
  out.expanded_m3_per_s = out.coverage_factor * out.combined_m3_per_s;
  return out;
}

}  // namespace spoolflow::uncertainty
