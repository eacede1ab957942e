#include "spoolflow/calibration/type/map_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "spoolflow/calibration/numerics/covariance.hpp"
#include "spoolflow/numerics/equations/symmetric_equations.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

constexpr auto unknowns = static_cast<Eigen::Index>(unit_unknowns);
constexpr std::array<double, unit_unknowns - variations - 1> beside_meter_gain{
    ageing_uncertainty, unloaded_friction_uncertainty_N, friction_tilt_uncertainty_N, conductance_tilt_uncertainty};

UnitUnknowns unknowns_from(const Eigen::VectorXd& x) {
  UnitUnknowns out;
  out.deviations = x.head(deviating);
  out.meter_gain = x(deviating);
  out.ageing = x(deviating + 1);
  out.unloaded_friction_N = x(deviating + 2);
  out.friction_tilt_N = x(deviating + 3);
  out.conductance_tilt = x(deviating + 4);
  return out;
}

/// Huber's loss of one row, twice, and its weight in a quadratic one.
double loss(double row) {
  const double size = std::abs(row);
  return size < huber_deviations ? size * size : huber_deviations * (2 * size - huber_deviations);
}
double weight(double row) {
  const double size = std::abs(row);
  return size < huber_deviations ? 1 : huber_deviations / size;
}

/// Prior mean and precision of all unknowns.
struct Prior {
  Eigen::VectorXd mean, deviation;
  Eigen::MatrixXd precision;

  Prior(const KnownDeviations& known, double meter_gain_deviation)
      : mean(Eigen::VectorXd::Zero(unknowns)),
        deviation(unknowns),
        precision(Eigen::MatrixXd::Zero(unknowns, unknowns)) {
    mean.head(deviating) = known.mean;
    deviation.head(deviating) = known.covariance.diagonal().cwiseSqrt();
    deviation(deviating) = meter_gain_deviation;
    for (Eigen::Index k = deviating + 1; k < unknowns; ++k)
      deviation(k) = beside_meter_gain[static_cast<std::size_t>(k - deviating - 1)];
    precision.topLeftCorner(deviating, deviating) = inverse_of_covariance(known.covariance);
    for (Eigen::Index k = deviating; k < unknowns; ++k) precision(k, k) = 1 / (deviation(k) * deviation(k));
  }
  [[nodiscard]] double loss_of(const Eigen::VectorXd& x) const { return (x - mean).dot(precision * (x - mean)); }
};

double loss_at(const Eigen::VectorXd& rows, const Prior& prior, const Eigen::VectorXd& x) {
  double sum = prior.loss_of(x);
  for (const double row : rows) sum += loss(row);
  return sum;
}

Eigen::MatrixXd slopes(const UnitEvidence& evidence, const Eigen::VectorXd& x, const Eigen::VectorXd& rows,
                       const Eigen::VectorXd& deviation) {
  constexpr double step = 0.1;
  Eigen::MatrixXd out(rows.size(), unknowns);
  for (Eigen::Index k = 0; k < unknowns; ++k) {
    Eigen::VectorXd turned = x;
    turned(k) += step * deviation(k);
    out.col(k) = (evidence.rows(unknowns_from(turned)) - rows) / (step * deviation(k));
  }
  return out;
}

}  // namespace

KnownDeviations spread_of(const Deviations& tolerances) {
  return {Eigen::VectorXd::Zero(deviating), Eigen::MatrixXd(tolerances.cwiseAbs2().asDiagonal())};
}

UnitFit most_likely_unit(const UnitEvidence& evidence, const KnownDeviations& known) {
  const Prior prior(known, evidence.meter_gain_deviation());
  Eigen::VectorXd x = prior.mean;
  Eigen::VectorXd rows = evidence.rows(unknowns_from(x));
  double here = loss_at(rows, prior, x);
  Eigen::MatrixXd precision = prior.precision;
  constexpr int most_rounds = 12, most_halvings = 5;
  constexpr double settled = 0.01;
  for (int round = 0; round < most_rounds; ++round) {
    const Eigen::MatrixXd slope = slopes(evidence, x, rows, prior.deviation);
    const Eigen::VectorXd weights = rows.unaryExpr([](double row) { return weight(row); });
    precision = slope.transpose() * weights.asDiagonal() * slope + prior.precision;
    const Eigen::VectorXd uphill =
        slope.transpose() * (weights.array() * rows.array()).matrix() + prior.precision * (x - prior.mean);
    Eigen::VectorXd step = numerics::solve_symmetric(precision, -uphill);
    bool better = false;
    double next = here;
    for (int halving = 0; halving < most_halvings && !better; ++halving, step *= better ? 1 : 0.5) {
      const Eigen::VectorXd tried = evidence.rows(unknowns_from(x + step));
      next = loss_at(tried, prior, x + step);
      better = next < here;
      if (better) {
        x += step;
        rows = tried;
      }
    }
    const bool over = !better || here - next < settled;
    if (better) here = next;
    if (over) break;
  }
  const Eigen::MatrixXd covariance = inverse_of_covariance(precision);
  UnitFit out{{x.head(deviating), covariance.topLeftCorner(deviating, deviating)}, x(deviating), rows, 0};
  std::vector<double> sizes;
  for (Eigen::Index k = 0; k < rows.size(); ++k) {
    if (evidence.kinds()[static_cast<std::size_t>(k)] < EvidenceOf::closed_reading) sizes.push_back(std::abs(rows(k)));
  }
  constexpr double median_of_normal = 0.6745;
  if (!sizes.empty()) out.misfit = numerics::median(std::move(sizes)) / median_of_normal;
  return out;
}

}  // namespace spoolflow::calibration
