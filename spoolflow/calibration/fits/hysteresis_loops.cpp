#include "spoolflow/calibration/fits/hysteresis_loops.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/numerics/nonnegative_least_squares.hpp"

namespace spoolflow::calibration {
namespace {

sensor::MagneticHysteresis<double> with_thresholds(double lowest, double highest, double full_flux) {
  sensor::MagneticHysteresis<double> out;
  for (int k = 0; k < sensor::hysteresis_elements; ++k)
    out.threshold[static_cast<std::size_t>(k)] =
        lowest * std::pow(highest / lowest, static_cast<double>(k) / (sensor::hysteresis_elements - 1));
  out.per_full_flux = 1 / full_flux;
  return out;
}

/// Unknowns: each stop's stiffness without flux and at full flux, then the companions' shares.
struct Rows {
  NormalEquations equations;
  double sum_of_squares = 0;
  std::size_t count = 0;
};

template <class Visit>
void visit_rows(std::span<const HysteresisHistory> histories, const sensor::MagneticHysteresis<double>& hysteresis,
                const Visit& visit) {
  const std::size_t companions = histories.front().companions.size();
  Eigen::VectorXd row(2 * sensor::hysteresis_elements + static_cast<Eigen::Index>(companions));
  for (const HysteresisHistory& history : histories) {
    sensor::HysteresisState<double> state;
    for (std::size_t n = 0; n < history.flux.size(); ++n) {
      sensor::advance(hysteresis, state, history.flux[n]);
      const double weight = history.weight[n];
      if (!(weight > 0)) continue;
      const double share = std::min(1.0, std::abs(history.flux[n]) * hysteresis.per_full_flux);
      for (int k = 0; k < sensor::hysteresis_elements; ++k) {
        const double deflection = sensor::deflection(state, static_cast<unsigned>(k));
        row(k) = weight * (1 - share) * deflection;
        row(sensor::hysteresis_elements + k) = weight * share * deflection;
      }
      for (std::size_t c = 0; c < companions; ++c)
        row(2 * sensor::hysteresis_elements + static_cast<Eigen::Index>(c)) = weight * history.companions[c][n];
      visit(row, weight * history.output[n]);
    }
  }
}

HysteresisFit fit_with(std::span<const HysteresisHistory> histories, sensor::MagneticHysteresis<double> hysteresis) {
  const auto unknowns =
      static_cast<Eigen::Index>(2 * sensor::hysteresis_elements + histories.front().companions.size());
  NormalEquations equations{Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns)};
  visit_rows(histories, hysteresis, [&](const Eigen::VectorXd& row, double right) {
    equations.matrix.selfadjointView<Eigen::Lower>().rankUpdate(row);
    equations.right += right * row;
  });
  equations.matrix.triangularView<Eigen::StrictlyUpper>() = equations.matrix.transpose();
  const Eigen::VectorXd shares = solve_nonnegative(equations);

  HysteresisFit fit{};
  for (int k = 0; k < sensor::hysteresis_elements; ++k) {
    hysteresis.stiffness[static_cast<std::size_t>(k)] = shares(k);
    hysteresis.stiffness_increase[static_cast<std::size_t>(k)] = shares(sensor::hysteresis_elements + k) - shares(k);
  }
  fit.hysteresis = hysteresis;
  for (Eigen::Index c = 2 * sensor::hysteresis_elements; c < unknowns; ++c) fit.companion_shares.push_back(shares(c));
  visit_rows(histories, hysteresis,
             [&](const Eigen::VectorXd& row, double right) { fit.residual.add(right - row.dot(shares)); });
  return fit;
}

}  // namespace

HysteresisFit fit_hysteresis(std::span<const HysteresisHistory> histories) {
  double full_flux = 0;
  for (const HysteresisHistory& history : histories)
    for (const double flux : history.flux) full_flux = std::fmax(full_flux, std::abs(flux));

  HysteresisFit best{};
  bool first = true;
  for (const double lowest : {0.0007, 0.002, 0.006}) {
    for (const double highest : {0.1, 0.25, 0.55}) {
      HysteresisFit fit = fit_with(histories, with_thresholds(lowest * full_flux, highest * full_flux, full_flux));
      if (first || fit.residual.sum_of_squares < best.residual.sum_of_squares) best = std::move(fit);
      first = false;
    }
  }
  return best;
}

}  // namespace spoolflow::calibration
