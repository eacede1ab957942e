#include "spoolflow/calibration/operation/operation_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/numerics/definite_matrix.hpp"
#include "spoolflow/calibration/numerics/fitted_parameters.hpp"
#include "spoolflow/calibration/operation/operation_score.hpp"

namespace spoolflow::calibration {
namespace {

constexpr double stretch_s = 2;  // friction in one is hardly that in the next
constexpr double log_step = 0.1;
const double pulled_to_deviation = std::log(2.0);  // of a valve's parameters from those assumed: a factor of two

/// The score as a sum over stretches: the RMS error stands for its linear part about `rms_m3_per_s`, so that the sum
/// has the score's slope.
Eigen::VectorXd scores(const std::vector<OperationOutcome>& stretches, double rms_m3_per_s,
                       double full_scale_m3_per_s) {
  const auto samples = static_cast<double>(together(stretches).error.samples);
  Eigen::VectorXd out(static_cast<Eigen::Index>(stretches.size()));
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    const OperationOutcome& each = stretches[static_cast<std::size_t>(k)];
    out(k) = (each.interval_score + weight_of_error * each.error.sum_of_squares / (2 * rms_m3_per_s)) /
             (samples * full_scale_m3_per_s);
  }
  return out;
}

/// Inverse of a curvature that differences may have made too flat somewhere: the pull is added until it is definite.
Eigen::MatrixXd inverse_of(Eigen::MatrixXd curvature, double pull) {
  const Eigen::Index unknowns = curvature.rows();
  if (!curvature.allFinite() || !(pull > 0)) return Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (double added = pull;; added *= 2) {
    if (std::optional<Eigen::MatrixXd> inverse = inverse_of_definite(curvature)) return *inverse;
    curvature.diagonal().array() += added;
  }
}

/// Curvature of a score over the parameters' logarithms about its minimum.
struct Curvature {
  Eigen::MatrixXd slopes;     ///< of each stretch
  Eigen::MatrixXd curvature;  ///< of their sum
};

/// By differences; `at(a, log_a, b, log_b)` are the scores of the stretches with the parameters a and b turned so far.
template <class Scores>
Curvature curvature_about(const Eigen::VectorXd& middle, const std::vector<Eigen::Index>& free, double pull,
                          const Scores& at) {
  const auto count = static_cast<Eigen::Index>(free.size());
  Curvature out{Eigen::MatrixXd(middle.size(), count), Eigen::MatrixXd(count, count)};
  Eigen::VectorXd above(count);
  for (Eigen::Index r = 0; r < count; ++r) {
    const Eigen::Index k = free[static_cast<std::size_t>(r)];
    const Eigen::VectorXd up = at(k, log_step, k, 0), down = at(k, -log_step, k, 0);
    out.slopes.col(r) = (up - down) / (2 * log_step);
    above(r) = up.sum();
    out.curvature(r, r) = (up.sum() + down.sum() - 2 * middle.sum()) / (log_step * log_step) + 2 * pull;
  }
  for (Eigen::Index r = 0; r < count; ++r) {
    for (Eigen::Index c = 0; c < r; ++c) {
      const double both =
          at(free[static_cast<std::size_t>(r)], log_step, free[static_cast<std::size_t>(c)], log_step).sum();
      out.curvature(r, c) = out.curvature(c, r) = (both - above(r) - above(c) + middle.sum()) / (log_step * log_step);
    }
  }
  return out;
}

/// Huber's sandwich: how much the slope differs between stretches, between inverse curvatures. Where the pull holds a
/// parameter, it is off by what the valve's differs from the one pulled to.
Eigen::MatrixXd covariance_from(Curvature score, double pull) {
  score.slopes.rowwise() -= score.slopes.colwise().mean();
  const double stretches = static_cast<double>(score.slopes.rows());
  const Eigen::MatrixXd scatter =
      stretches / std::max(1.0, stretches - 1) * score.slopes.transpose().lazyProduct(score.slopes);
  const Eigen::MatrixXd inverse = inverse_of(std::move(score.curvature), 2 * pull);
  const Eigen::MatrixXd information =
      scatter + std::pow(2 * pull * pulled_to_deviation, 2) * Eigen::MatrixXd::Identity(scatter.rows(), scatter.cols());
  return inverse.lazyProduct(information).eval().lazyProduct(inverse);
}

}  // namespace

model::Fit known_of_operation(const std::vector<OperationParameter>& fitted,
                              const sensor::ObserverParameters<double>& parameters,
                              const std::vector<OperatingRun>& runs, double full_scale_m3_per_s, double pull) {
  std::vector<std::string> names;
  std::vector<double> values;
  std::vector<Eigen::Index> free;
  for (const OperationParameter& parameter : fitted) {
    if (*parameter.value > 1.001 * parameter.lowest && *parameter.value < 0.999 * parameter.highest)
      free.push_back(static_cast<Eigen::Index>(names.size()));
    names.emplace_back(parameter.name);
    values.push_back(*parameter.value);
  }
  const std::vector<OperationOutcome> here = replay_stretches(parameters, runs, stretch_s);
  const double rms_m3_per_s = std::max(1e-9 * full_scale_m3_per_s, together(here).error.rms());
  const auto turned = [&](Eigen::Index a, double log_a, Eigen::Index b, double log_b) {
    double& value_a = *fitted[static_cast<std::size_t>(a)].value;
    double& value_b = *fitted[static_cast<std::size_t>(b)].value;
    const double before_a = value_a, before_b = value_b;
    value_a *= std::exp(log_a);
    value_b *= std::exp(log_b);
    Eigen::VectorXd out = scores(replay_stretches(parameters, runs, stretch_s), rms_m3_per_s, full_scale_m3_per_s);
    value_a = before_a;
    value_b = before_b;
    return out;
  };
  const Eigen::MatrixXd on_log_scale =
      covariance_from(curvature_about(scores(here, rms_m3_per_s, full_scale_m3_per_s), free, pull, turned), pull);
  const Eigen::Map<const Eigen::VectorXd> scale(values.data(), static_cast<Eigen::Index>(values.size()));
  const Eigen::MatrixXd covariance =
      scale.asDiagonal() * spread_over(scale.size(), free, on_log_scale) * scale.asDiagonal();
  return known_from(fit_of_operation, names, values, covariance);
}

}  // namespace spoolflow::calibration
