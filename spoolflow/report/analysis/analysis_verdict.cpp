#include "spoolflow/report/analysis/analysis_verdict.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

using analysis::GroupShare;

const GroupShare* largest(const std::vector<GroupShare>& shares, bool part_of_model) {
  const auto found =
      std::ranges::find_if(shares, [&](const GroupShare& group) { return group.part_of_model == part_of_model; });
  return found == shares.end() ? nullptr : &*found;
}

std::string range_of_expanded(const model::Model& model, const analysis::Analysis& analysis,
                              estimation::Estimator estimator) {
  double lowest = INFINITY;
  double highest = 0;
  for (const analysis::PointResult& point : analysis.points) {
    if (point.estimator != estimator || !point.reachable) continue;
    const double half = 0.5 * (point.stated.upper - point.stated.lower);
    lowest = std::min(lowest, half);
    highest = std::max(highest, half);
  }
  const double percent = 100 / model.valve.rated_flow_m3_per_s;
  return fmt::format("{} to {} % of full scale", fixed(lowest * percent, 1), fixed(highest * percent, 1));
}

std::string agreement(const analysis::Analysis& analysis, estimation::Estimator estimator) {
  std::size_t points = 0;
  std::size_t validated = 0;
  double lowest = INFINITY;
  double highest = 0;
  for (const analysis::PointResult& point : analysis.points) {
    if (point.estimator != estimator || !point.reachable) continue;
    ++points;
    validated += point.check.comparison.validated ? 1 : 0;
    lowest = std::min(lowest, point.check.comparison.deviation_ratio);
    highest = std::max(highest, point.check.comparison.deviation_ratio);
  }
  return fmt::format(
      "{}: Monte Carlo's standard deviation is {} to {} times the budget's. The 95 % interval stated is the budget's "
      "at "
      "{} of {} points, where the trials validate it (JCGM 101, clause 8), and the trials' own at the others.",
      estimation::name(estimator), fixed(lowest, 2), fixed(highest, 2), validated, points);
}

/// The factor of one kind with the largest total index.
std::string leading_factor(const analysis::SobolIndices& found, analysis::FactorKind kind) {
  std::size_t leading = found.factors.size();
  for (std::size_t f = 0; f < found.factors.size(); ++f) {
    if (analysis::valve_factors()[f].kind != kind) continue;
    if (leading == found.factors.size() || found.factors[f].total.value > found.factors[leading].total.value)
      leading = f;
  }
  const analysis::Index& total = found.factors[leading].total;
  return fmt::format("{} (total index {}, 95 % confidence {} to {})", analysis::valve_factors()[leading].name,
                     fixed(total.value, 2), fixed(total.lower, 2), fixed(total.upper, 2));
}

std::string across_the_series(const analysis::Study& study) {
  for (std::size_t o = 0; o < analysis::study_outputs; ++o) {
    const analysis::StudyOutput& output = analysis::study_output_list()[o];
    if (output.estimator != estimation::Estimator::observer || !output.p95) continue;
    const analysis::SobolIndices& found = study.indices[o];
    return fmt::format(
        "From one valve of a series to the next (virtual rig, {} runs) the observer's 95th percentile of the error "
        "changes most with the {}; of the instruments, with the {}.",
        study.runs, leading_factor(found, analysis::FactorKind::sub_model),
        leading_factor(found, analysis::FactorKind::instrument));
  }
  return {};
}

}  // namespace

AnalysisVerdict analysis_verdict(const model::Model& model, const analysis::Analysis& analysis) {
  const estimation::Estimator estimator = analysis::leading_estimator(analysis);
  const std::vector<GroupShare> shares = analysis::mean_shares(analysis.points, estimator);
  AnalysisVerdict out;
  if (shares.empty()) {
    out.sentence = "No point of the scenario lies inside the calibrated maps: there is no budget.";
    return out;
  }
  const GroupShare* const sub_model = largest(shares, true);
  const GroupShare* const instrument = largest(shares, false);
  const bool instrument_leads = instrument->share > sub_model->share;
  const GroupShare& first = instrument_leads ? *instrument : *sub_model;
  const GroupShare& second = instrument_leads ? *sub_model : *instrument;
  out.sentence = fmt::format(
      "Improve the {} next: it makes {} % of the variance of the {}'s flow rate, the mean over the working points. Of "
      "{} the {} counts most ({} %).",
      first.group, fixed(100 * first.share, 0), sensor_name(estimator),
      instrument_leads ? "the sub-models" : "instruments and oil", second.group, fixed(100 * second.share, 0));
  if (analysis.study) out.remarks.push_back(across_the_series(*analysis.study));
  out.remarks.push_back(fmt::format("Half the stated 95 % interval of the {} at the working points: {}.",
                                    sensor_name(estimator), range_of_expanded(model, analysis, estimator)));
  for (const estimation::Estimator each : {estimation::Estimator::condensed, estimation::Estimator::observer}) {
    const bool there = std::ranges::any_of(
        analysis.points, [&](const auto& point) { return point.estimator == each && point.reachable; });
    if (there) out.remarks.push_back(agreement(analysis, each));
  }
  return out;
}

}  // namespace spoolflow::report
