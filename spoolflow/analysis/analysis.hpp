#pragma once
/// All results of one analysis, and what they advise.
#include <optional>
#include <string>

#include "spoolflow/analysis/point_analysis.hpp"
#include "spoolflow/analysis/run_analysis.hpp"
#include "spoolflow/analysis/study.hpp"

namespace spoolflow::analysis {

/// A group of quantities with its mean share of the variance over the points of the leading estimator.
struct GroupShare {
  std::string group;
  bool part_of_model;  ///< else an instrument or the oil
  double share;
};

struct Analysis {
  Scenario scenario;
  std::vector<PointResult> points;
  std::vector<OperatingMap> maps;
  std::optional<RunAnalysis> run;
  std::optional<Study> study;
};

/// The estimator that the advice is about: the observer where the model has one.
[[nodiscard]] estimation::Estimator leading_estimator(const Analysis& analysis);

/// The largest first.
[[nodiscard]] std::vector<GroupShare> mean_shares(const std::vector<PointResult>& points,
                                                  estimation::Estimator estimator);

}  // namespace spoolflow::analysis
