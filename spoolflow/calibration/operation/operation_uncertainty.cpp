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

}  // namespace

model::Fit known_of_operation(sensor::ObserverParameters<double> parameters,
                              const std::vector<const recording::Recording*>& recordings, double full_scale_m3_per_s,
                              double pull) {
  const std::vector<Dial> dials = operation_dials(parameters);
  std::vector<std::size_t> free;
  for (std::size_t k = 0; k < dials.size(); ++k)
    if (*dials[k].value > 1.001 * dials[k].lowest && *dials[k].value < 0.999 * dials[k].highest) free.push_back(k);
  const std::vector<OperationOutcome> here = replay_stretches(parameters, recordings, stretch_s);
  const double rms_m3_per_s = std::max(1e-9 * full_scale_m3_per_s, together(here).error.rms());
  const Eigen::VectorXd middle = scores(here, rms_m3_per_s, full_scale_m3_per_s);
  const auto turned = [&](std::size_t a, double log_a, std::size_t b, double log_b) {
    const double before_a = *dials[a].value, before_b = *dials[b].value;
    *dials[a].value *= std::exp(log_a);
    *dials[b].value *= std::exp(log_b);
    Eigen::VectorXd out =
        scores(replay_stretches(parameters, recordings, stretch_s), rms_m3_per_s, full_scale_m3_per_s);
    *dials[a].value = before_a;
    *dials[b].value = before_b;
    return out;
  };

  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd slopes(middle.size(), count);  // of each stretch
  Eigen::MatrixXd curvature(count, count);
  Eigen::VectorXd above(count);
  for (Eigen::Index r = 0; r < count; ++r) {
    const std::size_t k = free[static_cast<std::size_t>(r)];
    const Eigen::VectorXd up = turned(k, log_step, k, 0), down = turned(k, -log_step, k, 0);
    slopes.col(r) = (up - down) / (2 * log_step);
    above(r) = up.sum();
    curvature(r, r) = (up.sum() + down.sum() - 2 * middle.sum()) / (log_step * log_step) + 2 * pull;
  }
  for (Eigen::Index r = 0; r < count; ++r) {
    for (Eigen::Index c = 0; c < r; ++c) {
      const double both =
          turned(free[static_cast<std::size_t>(r)], log_step, free[static_cast<std::size_t>(c)], log_step).sum();
      curvature(r, c) = curvature(c, r) = (both - above(r) - above(c) + middle.sum()) / (log_step * log_step);
    }
  }
  slopes.rowwise() -= slopes.colwise().mean();
  const double stretches = static_cast<double>(slopes.rows());
  const Eigen::MatrixXd scatter = stretches / std::max(1.0, stretches - 1) * slopes.transpose().lazyProduct(slopes);
  const Eigen::MatrixXd inverse = inverse_of(curvature, 2 * pull);
  const Eigen::MatrixXd on_log_scale = inverse.lazyProduct(scatter).eval().lazyProduct(inverse);

  const auto all = static_cast<Eigen::Index>(dials.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(all, all);
  for (Eigen::Index r = 0; r < count; ++r) {
    for (Eigen::Index c = 0; c < count; ++c) {
      const std::size_t a = free[static_cast<std::size_t>(r)], b = free[static_cast<std::size_t>(c)];
      covariance(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) =
          *dials[a].value * *dials[b].value * on_log_scale(r, c);
    }
  }
  std::vector<std::string> names;
  std::vector<double> values;
  for (const Dial& dial : dials) {
    names.emplace_back(dial.name);
    values.push_back(*dial.value);
  }
  return known_from("friction and position sensor in operation", names, values, covariance);
}

}  // namespace spoolflow::calibration
