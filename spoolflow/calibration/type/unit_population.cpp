#include "spoolflow/calibration/type/unit_population.hpp"

#include <Eigen/Cholesky>

namespace spoolflow::calibration {

Eigen::MatrixXd inverse(const Eigen::MatrixXd& positive_definite) {
  return positive_definite.llt().solve(Eigen::MatrixXd::Identity(positive_definite.rows(), positive_definite.cols()));
}

Population population_of(const std::vector<UnitLikelihood>& likelihoods, const Eigen::MatrixXd& prior) {
  constexpr int rounds = 60;
  const auto count = static_cast<double>(likelihoods.size());
  Population out{{Eigen::VectorXd::Zero(deviating), prior}, {}, {}};
  for (int round = 0; round < rounds; ++round) {
    const Eigen::MatrixXd between = inverse(out.of.covariance);
    Eigen::MatrixXd scatter = tolerances_as_units * prior;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(deviating);
    out.units.clear();
    for (const UnitLikelihood& unit : likelihoods) {
      const Eigen::MatrixXd covariance = inverse(unit.precision + between);
      out.units.emplace_back(covariance * (unit.weighted + between * out.of.mean));
      mean += out.units.back() / count;
      scatter += covariance;
    }
    out.open.setZero(deviating, deviating);
    for (const Eigen::VectorXd& unit : out.units)
      out.open += (unit - mean) * (unit - mean).transpose() / (count * (count - 1));
    out.of.mean = mean;
    out.of.covariance = (scatter + count * count * out.open) / (tolerances_as_units + count);
  }
  return out;
}

}  // namespace spoolflow::calibration
