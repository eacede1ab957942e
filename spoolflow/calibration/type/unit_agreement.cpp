#include "spoolflow/calibration/type/unit_agreement.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/covariance.hpp"
#include "spoolflow/numerics/equations/symmetric_equations.hpp"

namespace spoolflow::calibration {

double disagreeing_chi_square_of(std::size_t rows_of_one, std::size_t rows_of_other) {
  const auto rows = static_cast<double>(std::max(rows_of_one, rows_of_other));
  return disagreeing_chi_square * std::max(1.0, rows / rows_of_a_minute);
}

Disagreement disagreement_of(const KnownDeviations& one, const KnownDeviations& other, const KnownDeviations& prior) {
  // What a recording has shown is what it took off the prior's covariance; its mean is so much of the unit's
  // deviations, and errors. A direction that neither shows counts for nothing.
  constexpr double shown_least = 1e-4;
  const Eigen::MatrixXd of_one = prior.covariance - one.covariance, of_other = prior.covariance - other.covariance;
  const Eigen::MatrixXd common = of_one * inverse_of_covariance(prior.covariance) * of_other;
  Eigen::MatrixXd covariance = of_one + of_other - common - common.transpose();
  covariance.diagonal() += shown_least * prior.covariance.diagonal();
  const Eigen::VectorXd apart = one.mean - other.mean;
  const Eigen::VectorXd deviations = apart.cwiseQuotient(covariance.diagonal().cwiseSqrt());
  Eigen::Index worst = 0;
  deviations.cwiseAbs().maxCoeff(&worst);
  return {apart.dot(numerics::solve_symmetric(covariance, apart)), static_cast<std::size_t>(worst), one.mean(worst),
          other.mean(worst), std::abs(deviations(worst))};
}

std::string disagreeing_runs(const model::Model& type, const KnownDeviations& prior, const std::vector<UnitRun>& runs) {
  if (runs.size() < 2) return {};
  struct Said {
    std::string file;
    KnownDeviations unit;
    std::size_t rows;
  };
  std::vector<Said> said;
  for (const UnitRun& run : runs) {
    const UnitEvidence evidence(type, {run});
    if (evidence.kinds().empty()) continue;
    said.push_back(
        {run.recording->file.filename().string(), most_likely_unit(evidence, prior).known, evidence.kinds().size()});
  }
  std::string out;
  double worst = 1;
  for (std::size_t k = 0; k < said.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      const Disagreement found = disagreement_of(said[j].unit, said[k].unit, prior);
      const double most = disagreeing_chi_square_of(said[j].rows, said[k].rows);
      if (!(found.chi_square > worst * most)) continue;
      worst = found.chi_square / most;
      const VariationAbout& about = all_variations()[found.variation];
      out = fmt::format(
          "{} and {} are hardly of one unit: {} is {} by the one and {} by the other, {:.1f} standard deviations "
          "apart (all directions: chi square {:.0f}, and of one unit {:.0f} at most); look whose recordings they are, "
          "and whether position sensor and spring stayed as they were between them",
          said[j].file, said[k].file, about.name, written_deviation(about.unit, found.one),
          written_deviation(about.unit, found.other), found.deviations, found.chi_square, most);
    }
  }
  return out;
}

}  // namespace spoolflow::calibration
