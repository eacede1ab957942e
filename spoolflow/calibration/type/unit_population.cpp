#include "spoolflow/calibration/type/unit_population.hpp"

#include "spoolflow/calibration/numerics/covariance.hpp"

namespace spoolflow::calibration {

Population population_of(const std::vector<UnitLikelihood>& likelihoods, const Eigen::MatrixXd& prior,
                         double middle_as_units) {
  constexpr int rounds = 60;
  const auto count = static_cast<double>(likelihoods.size());
  Population out{{Eigen::VectorXd::Zero(deviating), prior}, {}, {}};
  for (int round = 0; round < rounds; ++round) {
    const Eigen::MatrixXd between = inverse_of_covariance(out.of.covariance);
    Eigen::MatrixXd scatter = tolerances_as_units * prior, of_middle = middle_as_units * between;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(deviating);
    out.units.clear();
    for (const UnitLikelihood& unit : likelihoods) {
      const Eigen::MatrixXd covariance = inverse_of_covariance(unit.precision + between);
      out.units.emplace_back(covariance * (unit.weighted + between * out.of.mean));
      mean += out.units.back() / (count + middle_as_units);
      scatter += covariance;
      of_middle += between - between * covariance * between;
    }
    Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(deviating, deviating);
    for (const Eigen::VectorXd& unit : out.units) apart += (unit - mean) * (unit - mean).transpose();
    out.open = middle_as_units > 0 ? inverse_of_covariance(of_middle) : apart / (count * (count - 1));
    out.of.mean = mean;
    out.of.covariance = (scatter + apart * count / (count - 1)) / (tolerances_as_units + count);
  }
  return out;
}

}  // namespace spoolflow::calibration
