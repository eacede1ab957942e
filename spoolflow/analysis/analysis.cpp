#include "spoolflow/analysis/analysis.hpp"

#include <algorithm>

namespace spoolflow::analysis {

estimation::Estimator leading_estimator(const Analysis& analysis) {
  return analysis.points.empty() ? estimation::Estimator::condensed : analysis.points.back().estimator;
}

std::vector<GroupShare> mean_shares(const std::vector<PointResult>& points, estimation::Estimator estimator) {
  std::vector<GroupShare> out;
  double reachable = 0;
  for (const PointResult& point : points) {
    if (point.estimator != estimator || !point.reachable) continue;
    reachable += 1;
    for (const uncertainty::BudgetLine& line : point.budget.lines) {
      const uncertainty::QuantityAbout& about = uncertainty::about(line.input.quantity);
      auto found = std::find_if(out.begin(), out.end(), [&](const GroupShare& g) { return g.group == about.group; });
      if (found == out.end()) {
        out.push_back({std::string(about.group), about.part_of_model, 0});
        found = out.end() - 1;
      }
      found->share += line.share;
    }
  }
  for (GroupShare& group : out) group.share /= reachable;
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
  return out;
}

}  // namespace spoolflow::analysis
