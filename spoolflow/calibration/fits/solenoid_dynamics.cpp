#include "spoolflow/calibration/fits/solenoid_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "spoolflow/calibration/fits/coil_deviation.hpp"
#include "spoolflow/calibration/numerics/fitted_parameters.hpp"
#include "spoolflow/calibration/numerics/nonnegative_least_squares.hpp"
#include "spoolflow/numerics/equations/symmetric_equations.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

/// Every part of the protocol counts alike, whatever its sample rate, or by its share. Left out: what follows a step of
/// the current that the samples do not resolve, and negative current, for which the force map holds no force.
std::vector<double> weights(const SolenoidSamples& samples, double largest_A, const std::vector<int>& only,
                            const std::map<int, double>& shares = {}) {
  constexpr std::size_t unresolved_samples = 10;
  const double noise_A = 0.01 * largest_A;
  std::vector<double> out(samples.size(), 0.0);
  std::map<int, double> count;
  std::size_t resolved_from = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const bool step = k > 0 && samples.restarts[k] == 0 &&
                      std::abs(samples.samples[k].current_A - samples.samples[k - 1].current_A) > 0.1 * largest_A;
    if (step) resolved_from = k + unresolved_samples;
    const int test = samples.test[k];
    if (k < resolved_from || samples.samples[k].current_A < -noise_A ||
        (!only.empty() && std::find(only.begin(), only.end(), test) == only.end()))
      continue;
    out[k] = 1;
    count[test] += 1;
  }
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (out[k] > 0) {
      const int test = samples.test[k];
      out[k] = std::sqrt(1000 * (shares.empty() ? 1.0 : shares.at(test)) / count[test]);
    }
  return out;
}

CoilUnknowns unknowns_of(const sensor::Coil<double>& coil) {
  CoilUnknowns values;
  for (std::size_t k = 0; k < sensor::hysteresis_elements; ++k) {
    values[k] = coil.hysteresis.stiffness[k] * coil.hysteresis.threshold[k];
    values[k + sensor::hysteresis_elements] =
        values[k] + coil.hysteresis.stiffness_increase[k] * coil.hysteresis.threshold[k];
  }
  values[2 * sensor::hysteresis_elements] = coil.eddy_currents.classical_A_per_V;
  values[2 * sensor::hysteresis_elements + 1] = coil.eddy_currents.excess_A_per_rootV;
  return values;
}

/// Weakly equal outputs without and at full flux, where the recording does not distinguish them.
void add_even_outputs(CoilDeviation& deviation, const CoilUnknowns& unknowns, double coercive_A) {
  const double weight = 1 / (coercive_A * coercive_A);
  for (int k = 0; k < sensor::hysteresis_elements; ++k) {
    const int full = k + sensor::hysteresis_elements;
    const double difference = unknowns[static_cast<std::size_t>(full)] - unknowns[static_cast<std::size_t>(k)];
    deviation.sum_of_squares += weight * difference * difference;
    deviation.gradient(full) += weight * difference;
    deviation.gradient(k) -= weight * difference;
    deviation.curvature(full, full) += weight;
    deviation.curvature(k, k) += weight;
    deviation.curvature(k, full) -= weight;
    deviation.curvature(full, k) -= weight;
  }
}

struct Trial {
  CoilUnknowns unknowns;
  Eigen::VectorXd corrections_N;
  CoilDeviation deviation;
  int iterations;
  double samples_counted;  ///< after weighting
};

/// Gauss-Newton with Levenberg's damping; each step is a non-negative least-squares problem in the unknowns, the free
/// corrections being eliminated. Not by Ceres's solver, which cuts each step off at the bounds, where 6 or 7 of the 18
/// unknowns end: on recordings of three valves it took 37 to 51 steps instead of 4 to 10, ten times as long, to a sum
/// of squares that was 1 % larger.
Trial solve(const CoilTask& task, const CoilUnknowns& start, double coercive_A) {
  const auto evaluate = [&](const CoilUnknowns& unknowns, const Eigen::VectorXd& corrections_N) {
    CoilDeviation deviation = coil_deviation(task, unknowns, corrections_N);
    add_even_outputs(deviation, unknowns, coercive_A);
    return deviation;
  };
  const auto free = static_cast<Eigen::Index>(map_corrections * task.held.size());
  Trial best{start, Eigen::VectorXd::Zero(free), {}, 0, 0};
  for (const double weight : task.weight) best.samples_counted += weight * weight;
  best.deviation = evaluate(best.unknowns, best.corrections_N);
  double damping = 1e-3;
  for (; best.iterations < 25; ++best.iterations) {
    const Eigen::MatrixXd& full = best.deviation.curvature;
    const Eigen::Map<const Eigen::VectorXd> here(best.unknowns.data(), coil_unknowns);
    Eigen::MatrixXd curvature = full;
    curvature.diagonal() *= 1 + damping;
    Eigen::VectorXd at(coil_unknowns + free);
    at << here, best.corrections_N;
    const Eigen::VectorXd right = curvature * at - best.deviation.gradient;
    const auto coupling = curvature.topRightCorner(coil_unknowns, free);
    const Eigen::MatrixXd free_part = numerics::inverse_of_symmetric(curvature.bottomRightCorner(free, free));
    const NormalEquations reduced{
        curvature.topLeftCorner(coil_unknowns, coil_unknowns) - coupling * free_part * coupling.transpose(),
        right.head(coil_unknowns) - coupling * free_part * right.tail(free)};
    const Eigen::VectorXd next = solve_nonnegative(reduced);
    CoilUnknowns unknowns;
    Eigen::VectorXd::Map(unknowns.data(), coil_unknowns) = next;
    const Eigen::VectorXd corrections_N = free_part * (right.tail(free) - coupling.transpose() * next);
    CoilDeviation deviation = evaluate(unknowns, corrections_N);
    const double gain = best.deviation.sum_of_squares - deviation.sum_of_squares;
    if (gain > 0) {
      const bool done = gain < 1e-3 * deviation.sum_of_squares;
      best.unknowns = unknowns;
      best.corrections_N = corrections_N;
      best.deviation = std::move(deviation);
      damping = std::max(1e-6, 0.1 * damping);
      if (done) break;
    } else {
      damping *= 10;
      if (damping > 1e6) break;
    }
  }
  return best;
}

/// Squares of deviations count by their variance: a part that the coil's model does not describe, as sines are where
/// eddy currents have several stages, must not bend the loops of the others. The mean share is 1.
std::map<int, double> shares_by_what_is_left(const std::map<int, FitResidual>& parts) {
  constexpr double least_share_of_median = 0.25;  // a part with hardly any samples may meet them all
  std::vector<double> variances_N2;
  for (const auto& [test, left] : parts) variances_N2.push_back(left.rms() * left.rms());
  const double least_N2 = least_share_of_median * numerics::median(variances_N2);
  std::map<int, double> shares;
  double sum = 0;
  for (const auto& [test, left] : parts) sum += shares[test] = 1 / std::max({left.rms() * left.rms(), least_N2, 1e-12});
  for (auto& [test, share] : shares) share *= static_cast<double>(parts.size()) / sum;
  return shares;
}

/// Calls `each(k, magnetising current [A])` at every sample of a held armature, the coil begun again.
template <class Each>
void along(const HeldArmature& held, const SolenoidSamples& samples, const sensor::Coil<double>& coil, Each&& each) {
  sensor::CoilState<double> state;
  const auto position = sensor::locate<sensor::flux_map_positions>(coil.flux_linkage.map.column_axis, held.position_m);
  for (std::size_t k = held.begin; k < held.end; ++k) {
    const auto& sample = samples.samples[k];
    sensor::follow_current(coil, state, {sample.time_step_s, sample.current_A}, position, k == held.begin);
    each(k, state.magnetising_current_A);
  }
}

/// Residuals of each part of the protocol, every sample counted.
std::vector<TestResidual> residuals_of(const SolenoidSamples& samples, const sensor::Coil<double>& coil,
                                       const sensor::MagneticForce<double>& magnetic_force) {
  struct Deviations {
    std::vector<double> static_map_N, model_N;
  };
  std::map<int, Deviations> tests;
  std::map<int, TestResidual> out;
  for (const HeldArmature& held : held_armature(samples)) {
    along(held, samples, coil, [&](std::size_t k, double magnetising_A) {
      const double current_A = samples.samples[k].current_A;
      const auto deviation_N = [&](double at_A) {
        return samples.force_N[k] - magnetic_force.at(at_A, held.position_m).value;
      };
      TestResidual& test = out[samples.test[k]];
      test.static_map_N.add(deviation_N(current_A));
      test.model_N.add(deviation_N(magnetising_A));
      tests[samples.test[k]].static_map_N.push_back(std::abs(deviation_N(current_A)));
      tests[samples.test[k]].model_N.push_back(std::abs(deviation_N(magnetising_A)));
    });
  }
  std::vector<TestResidual> list;
  for (auto& [number, test] : out) {
    test.test = number;
    test.static_map_p95_N = numerics::quantile(std::move(tests[number].static_map_N), 0.95);
    test.model_p95_N = numerics::quantile(std::move(tests[number].model_N), 0.95);
    list.push_back(test);
  }
  return list;
}

/// Some hundred samples of each part at the middle of the held positions, rounded as far as a plot shows.
std::vector<model::SolenoidTrace> traces_of(const SolenoidSamples& samples, const sensor::Coil<double>& coil,
                                            const sensor::MagneticForce<double>& magnetic_force) {
  constexpr std::size_t points = 160;
  const auto rounded = [](double value) { return std::round(1e3 * value) / 1e3; };  // to mA and mN
  std::vector<HeldArmature> all = held_armature(samples);
  if (all.empty()) return {};
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end(),
                   [](const HeldArmature& a, const HeldArmature& b) { return a.position_m < b.position_m; });
  const HeldArmature& held = *middle;
  std::map<int, std::size_t> length;
  for (std::size_t k = held.begin; k < held.end; ++k) ++length[samples.test[k]];
  std::map<int, std::size_t> seen;
  std::map<int, model::SolenoidTrace> traces;
  along(held, samples, coil, [&](std::size_t k, double magnetising_A) {
    const double current_A = samples.samples[k].current_A;
    const int test = samples.test[k];
    const std::size_t before = seen[test]++;
    if (before * points / length[test] == (before + 1) * points / length[test]) return;  // thinned
    model::SolenoidTrace& trace = traces[test];
    trace.test = test;
    trace.position_m = held.position_m;
    trace.current_A.push_back(rounded(current_A));
    trace.measured_N.push_back(rounded(samples.force_N[k]));
    trace.model_N.push_back(rounded(magnetic_force.at(magnetising_A, held.position_m).value));
    trace.map_N.push_back(rounded(magnetic_force.at(current_A, held.position_m).value));
  });
  std::vector<model::SolenoidTrace> out;
  for (auto& [test, trace] : traces) out.push_back(std::move(trace));
  return out;
}

std::string name_of(int k, const sensor::Coil<double>& coil) {
  if (k == 2 * sensor::hysteresis_elements) return "classical_eddy_current_A_per_V";
  if (k == 2 * sensor::hysteresis_elements + 1) return "excess_eddy_current_A_per_rootV";
  const auto e = static_cast<std::size_t>(k % sensor::hysteresis_elements);
  return fmt::format("stop_{:.3g}_mWb_{}_A", 1e3 * coil.hysteresis.threshold[e],
                     k < sensor::hysteresis_elements ? "without_flux" : "at_full_flux");
}

/// Values with their covariance, from the curvature at those unknowns that are not held at zero.
model::Fit known_parameters(const sensor::Coil<double>& coil, const Trial& solution) {
  const Eigen::Index all = solution.deviation.curvature.rows();
  std::vector<Eigen::Index> free = above_zero(Eigen::VectorXd::Map(solution.unknowns.data(), coil_unknowns));
  for (Eigen::Index k = coil_unknowns; k < all; ++k) free.push_back(k);
  const Eigen::MatrixXd curvature = solution.deviation.curvature(free, free);
  const double variance_N2 = solution.deviation.sum_of_squares / solution.samples_counted;
  const Eigen::MatrixXd known = variance_N2 * numerics::inverse_of_symmetric(curvature);
  const Eigen::MatrixXd covariance = spread_over(all, free, known).topLeftCorner(coil_unknowns, coil_unknowns);
  std::vector<std::string> names;
  std::vector<double> values;
  for (int k = 0; k < coil_unknowns; ++k) {
    names.push_back(name_of(k, coil));
    values.push_back(solution.unknowns[static_cast<std::size_t>(k)]);
  }
  return known_from("magnetic hysteresis and eddy currents", names, values, covariance);
}

}  // namespace

SolenoidDynamicsFit fit_solenoid_dynamics(const SolenoidSamples& given, const sensor::Coil<double>& coil,
                                          const sensor::MagneticForce<double>& magnetic_force,
                                          const std::vector<int>& only) {
  const double largest_A = magnetic_force.map.row_axis.at(sensor::force_map_currents - 1);
  const SolenoidSamples samples = thinned(given, 0.01 * largest_A);
  CoilTask task{samples, coil, magnetic_force, held_armature(samples), weights(samples, largest_A, only)};
  const double coercive_A = std::max(1e-4 * largest_A, sensor::saturated_output(coil.hysteresis, 0.5));
  Trial solution = solve(task, unknowns_of(coil), coercive_A);
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    task.weight = weights(samples, largest_A, only, shares_by_what_is_left(solution.deviation.parts));
    solution = solve(task, solution.unknowns, coercive_A);
  }

  SolenoidDynamicsFit fit{};
  fit.coil = coil_with(task, solution.unknowns);
  fit.iterations = solution.iterations;
  fit.tests = residuals_of(given, fit.coil, magnetic_force);
  fit.traces = traces_of(given, fit.coil, magnetic_force);
  fit.known = known_parameters(coil, solution);
  return fit;
}

}  // namespace spoolflow::calibration
