#include "spoolflow/validation/judged_limits.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::validation {
namespace {

const GroupFigures& group_of(const Metrics& metrics, When when) {
  static constexpr std::array groups{std::pair{When::moving, &Metrics::moving}, std::pair{When::rest, &Metrics::rest},
                                     std::pair{When::reversal, &Metrics::reversal},
                                     std::pair{When::p_to_b, &Metrics::p_to_b},
                                     std::pair{When::p_to_a, &Metrics::p_to_a}};
  for (const auto& [samples, group] : groups) {
    if (samples == when) return metrics.*group;
  }
  return metrics.all;
}

/// A figure of the errors: SI, or a share. Absent without samples.
std::optional<double> figure_of(const Metrics& metrics, const Limit& limit) {
  const GroupFigures& group = group_of(metrics, limit.when);
  const bool of_reading = limit.figure == Figure::p95_of_reading;
  if ((of_reading ? metrics.share_of_reading.samples : group.error.samples) == 0) return std::nullopt;
  switch (limit.figure) {
    case Figure::p95:
      return group.error.p95;
    case Figure::rms:
      return group.error.rms;
    case Figure::largest:
      return group.error.largest;
    case Figure::bias:
      return std::abs(group.error.bias);
    case Figure::band_mean_width:
      return group.band_mean_width_m3_per_s;
    case Figure::band_coverage:
      return group.band_coverage;
    case Figure::p95_of_reading:
      return metrics.share_of_reading.p95;
    case Figure::fault_share:
    case Figure::wrong_sign:
      break;
  }
  return std::nullopt;
}

/// Absent but for a whole valve with reference flow.
std::optional<double> wrong_share(const std::optional<SignFigures>& sign) {
  if (!sign || sign->samples == 0) return std::nullopt;
  return static_cast<double>(sign->wrong) / static_cast<double>(sign->samples);
}

double in_unit(double value, LimitUnit unit, double full_scale_m3_per_s) {
  switch (unit) {
    case LimitUnit::percent_FS:
      return 100 * value / full_scale_m3_per_s;
    case LimitUnit::litre_per_minute:
      return units::L_per_min_from_m3_per_s(value);
    case LimitUnit::percent:
      break;
  }
  return 100 * value;
}

const EstimatorResult& result_of(const RunResult& run, estimation::Estimator estimator) {
  for (const EstimatorResult& result : run.results) {
    if (result.estimator == estimator) return result;
  }
  return run.results.back();
}

class Judge {
 public:
  Judge(const Validation& validation, double full_scale_m3_per_s)
      : validation_(validation), full_scale_m3_per_s_(full_scale_m3_per_s) {}

  [[nodiscard]] JudgedLimit together(const Limit& limit) const {
    const estimation::Estimator estimator = limit.estimator.value_or(validation_.pooled.back().estimator);
    if (!validation_.held_out) return known(limit, "all runs", estimator);
    if (limit.figure == Figure::fault_share) return judged(limit, "all runs", estimator, fault_share(estimator));
    for (const PooledResult& pooled : validation_.pooled) {
      if (pooled.estimator != estimator || !pooled.metrics) continue;
      return judged(limit, "all runs", estimator,
                    limit.figure == Figure::wrong_sign ? wrong_share(pooled.sign) : figure_of(*pooled.metrics, limit));
    }
    return judged(limit, "all runs", estimator, std::nullopt);
  }
  [[nodiscard]] JudgedLimit alone(const Limit& limit, const RunResult& run) const {
    const estimation::Estimator estimator = limit.estimator.value_or(validation_.pooled.back().estimator);
    if (run.calibrated_with) return known(limit, run.name, estimator);
    const EstimatorResult& result = result_of(run, estimator);
    if (limit.figure == Figure::fault_share) {
      return judged(limit, run.name, estimator,
                    run.samples == 0 ? std::nullopt : std::optional<double>(result.fault_share));
    }
    if (limit.figure == Figure::wrong_sign) return judged(limit, run.name, estimator, wrong_share(result.sign));
    return judged(limit, run.name, estimator, result.metrics ? figure_of(*result.metrics, limit) : std::nullopt);
  }

 private:
  [[nodiscard]] std::optional<double> fault_share(estimation::Estimator estimator) const {
    double runs = 0;
    double share = 0;
    for (const RunResult& run : validation_.runs) {
      if (run.calibrated_with || run.samples == 0) continue;
      share += result_of(run, estimator).fault_share;
      ++runs;
    }
    if (runs == 0) return std::nullopt;
    return share / runs;
  }
  [[nodiscard]] JudgedLimit judged(const Limit& limit, const std::string& run, estimation::Estimator estimator,
                                   std::optional<double> value) const {
    if (value) value = in_unit(*value, limit.unit, full_scale_m3_per_s_);
    const bool met =
        value && (!limit.at_least || *value >= *limit.at_least) && (!limit.at_most || *value <= *limit.at_most);
    return {limit, run, estimator, value, met};
  }
  /// What the calibration read meets a limit by itself.
  [[nodiscard]] static JudgedLimit known(const Limit& limit, const std::string& run, estimation::Estimator estimator) {
    return {limit, run, estimator, std::nullopt, false, true};
  }

  const Validation& validation_;
  double full_scale_m3_per_s_;
};

}  // namespace

Requirements default_requirements() {
  Requirements out;
  out.limits.push_back({.place = {}, .figure = Figure::p95, .at_most = 5.0});
  out.limits.push_back({.place = {}, .figure = Figure::band_coverage, .unit = LimitUnit::percent, .at_least = 93.0});
  return out;
}

std::vector<JudgedLimit> judge(const Requirements& requirements, const Validation& validation,
                               double full_scale_m3_per_s) {
  const Judge judge_of(validation, full_scale_m3_per_s);
  std::vector<JudgedLimit> out;
  for (const Limit& limit : requirements.limits) {
    if (limit.run == "all") out.push_back(judge_of.together(limit));
    for (const RunResult& run : validation.runs) {
      const bool each = limit.run == "each" && !(run.calibrated_with && validation.held_out);
      if (each || limit.run == run.name) out.push_back(judge_of.alone(limit, run));
    }
  }
  return out;
}

}  // namespace spoolflow::validation
