#include "spoolflow/calibration/fits/sliding_friction.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/numerics/linear_least_squares.hpp"
#include "spoolflow/calibration/numerics/zero_phase_filter.hpp"

namespace spoolflow::calibration {
namespace {

using Members = std::vector<double FrictionLaw::*>;

/// One unknown: its share of the force at each sample, and where its value goes.
struct Unknown {
  std::vector<double> regressor;
  Members members;
};

/// Missing samples on the straight line between their neighbours.
std::vector<double> bridged(std::span<const double> values) {
  std::vector<double> out(values.begin(), values.end());
  std::size_t known = out.size();
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (std::isnan(out[k])) continue;
    for (std::size_t gap = known == out.size() ? 0 : known + 1; gap < k; ++gap) {
      const double from = known == out.size() ? out[k] : out[known];
      const double share = known == out.size() ? 1 : static_cast<double>(gap - known) / static_cast<double>(k - known);
      out[gap] = from + share * (out[k] - from);
    }
    known = k;
  }
  if (known == out.size()) throw CalibrationError("friction cannot be identified: no sample of position or force");
  for (std::size_t gap = known + 1; gap < out.size(); ++gap) out[gap] = out[known];
  return out;
}

std::vector<Unknown> unknowns_of(const std::vector<double>& velocity_m_per_s, double time_step_s,
                                 FrictionSymmetry symmetry, FrictionMotion motion) {
  const auto over_samples = [&](auto&& share) {
    std::vector<double> out;
    for (const double v : velocity_m_per_s) out.push_back(share(v));
    return out;
  };
  const auto sign = [](double v) { return v > 0 ? 1.0 : v < 0 ? -1.0 : 0.0; };
  std::vector<Unknown> out;
  if (motion == FrictionMotion::accelerated)
    out.push_back({derivative({velocity_m_per_s, time_step_s}), {&FrictionLaw::mass_kg}});
  if (symmetry == FrictionSymmetry::same_both_ways) {
    if (motion == FrictionMotion::accelerated)
      out.push_back(
          {velocity_m_per_s, {&FrictionLaw::viscous_opening_N_s_per_m, &FrictionLaw::viscous_closing_N_s_per_m}});
    out.push_back({over_samples(sign), {&FrictionLaw::coulomb_opening_N, &FrictionLaw::coulomb_closing_N}});
    out.push_back({over_samples([](double) { return 1.0; }), {&FrictionLaw::offset_N}});
    return out;
  }
  if (motion == FrictionMotion::accelerated) {
    out.push_back({over_samples([](double v) { return std::max(v, 0.0); }), {&FrictionLaw::viscous_opening_N_s_per_m}});
    out.push_back({over_samples([](double v) { return std::min(v, 0.0); }), {&FrictionLaw::viscous_closing_N_s_per_m}});
  }
  out.push_back({over_samples([&](double v) { return std::max(sign(v), 0.0); }), {&FrictionLaw::coulomb_opening_N}});
  out.push_back({over_samples([&](double v) { return std::min(sign(v), 0.0); }), {&FrictionLaw::coulomb_closing_N}});
  return out;
}

}  // namespace

SlidingFrictionFit fit_sliding_friction(const SlidingHistory& history, FrictionSymmetry symmetry,
                                        FrictionMotion motion) {
  constexpr double rows_bandwidth_share = 0.4;
  const double step_s = history.time_step_s;
  const double rows_bandwidth_Hz = rows_bandwidth_share * history.bandwidth_Hz;
  const std::vector<double> position_m =
      zero_phase_low_pass({bridged(history.position_m), step_s}, history.bandwidth_Hz);
  std::vector<Unknown> unknowns = unknowns_of(derivative({position_m, step_s}), step_s, symmetry, motion);
  for (Unknown& unknown : unknowns)
    unknown.regressor = zero_phase_low_pass({unknown.regressor, step_s}, rows_bandwidth_Hz);
  const std::vector<double> force_N = zero_phase_low_pass({bridged(history.force_N), step_s}, rows_bandwidth_Hz);

  std::vector<std::size_t> rows;
  for (const Sweep& stretch : history.stretches)
    for (std::size_t k = stretch.begin; k < stretch.end; ++k)
      if (!std::isnan(history.position_m[k]) && !std::isnan(history.force_N[k])) rows.push_back(k);
  const auto columns = static_cast<Eigen::Index>(unknowns.size());
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), columns);
  Eigen::VectorXd right(matrix.rows());
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    const std::size_t k = rows[static_cast<std::size_t>(r)];
    for (Eigen::Index c = 0; c < columns; ++c) matrix(r, c) = unknowns[static_cast<std::size_t>(c)].regressor[k];
    right(r) = force_N[k];
  }
  if (matrix.rows() <= columns || !(matrix.colwise().squaredNorm().minCoeff() > 0))
    throw CalibrationError("friction cannot be identified: the recording does not slide both ways");
  const LinearLeastSquares solved = least_squares(matrix, right, "friction");

  SlidingFrictionFit fit{};
  fit.force_rms_N = right.norm() / std::sqrt(static_cast<double>(right.size()));
  for (const double each : solved.deviation) fit.residual.add(each);
  // Neighbouring rows share their noise: two of each period of the bandwidth are independent, and count.
  const double independent = static_cast<double>(matrix.rows()) * std::min(1.0, 2 * rows_bandwidth_Hz * step_s);
  const Eigen::MatrixXd covariance = solved.covariance(independent);
  for (Eigen::Index c = 0; c < columns; ++c) {
    for (double FrictionLaw::*member : unknowns[static_cast<std::size_t>(c)].members) {
      fit.law.*member = solved.solution(c);
      fit.uncertainty.*member = std::sqrt(covariance(c, c));
    }
  }
  return fit;
}

}  // namespace spoolflow::calibration
