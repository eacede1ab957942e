#include "spoolflow/calibration/operation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spoolflow/calibration/band.hpp"
#include "spoolflow/calibration/replay.hpp"

namespace spoolflow::calibration {
namespace {

/// A parameter that operation shows, with the range that is searched.
struct Dial {
  double* value;
  double lowest, highest;
};

std::vector<Dial> dials(sensor::ObserverParameters<double>& parameters) {
  return {
      {&parameters.friction.operation_ratio, 0.5, 2.5}, {&parameters.friction.ageing_ratio, 1.01, 12},
      {&parameters.friction.ageing_s, 0.1, 20},         {&parameters.friction.contact_stiffness_N_per_m, 5e5, 5e7},
      {&parameters.friction.tolerance_N, 0.3, 2.5},     {&parameters.friction.breakaway_share, 0.05, 0.4},
      {&parameters.band.friction_share, 0.01, 0.2},     {&parameters.position_sensor.backlash_m, 5e-8, 4e-6},
  };
}

/// What the observer answered beside the reference, summed up.
struct Outcome {
  double interval_score = 0;  ///< sum [m3/s]
  FitResidual error;
  std::size_t inside = 0;

  [[nodiscard]] double score(double full_scale_m3_per_s) const {
    if (error.samples == 0) return std::numeric_limits<double>::infinity();
    constexpr double weight_of_error = 4;
    return (interval_score / static_cast<double>(error.samples) + weight_of_error * error.rms()) / full_scale_m3_per_s;
  }
};

Outcome replay_all(const sensor::ObserverParameters<double>& parameters,
                   const std::vector<const recording::Recording*>& recordings) {
  constexpr double outside_weight = 2 / 0.05;  // of a 95 % interval
  Outcome outcome;
  replay(parameters, recordings, [&](const sensor::ObserverState<double>& state, double, double reference_m3_per_s) {
    const sensor::Estimate<double>& estimate = state.last;
    const double outside = std::max(
        {0.0, estimate.flow_lower_m3_per_s - reference_m3_per_s, reference_m3_per_s - estimate.flow_upper_m3_per_s});
    outcome.interval_score += estimate.flow_upper_m3_per_s - estimate.flow_lower_m3_per_s + outside_weight * outside;
    outcome.error.add(estimate.flow_m3_per_s - reference_m3_per_s);
    if (outside == 0) ++outcome.inside;
  });
  return outcome;
}

}  // namespace

double operation_score(const sensor::ObserverParameters<double>& parameters,
                       const std::vector<const recording::Recording*>& recordings, double full_scale_m3_per_s) {
  return replay_all(parameters, recordings).score(full_scale_m3_per_s);
}

OperationFit fit_operation(sensor::ObserverParameters<double>& parameters,
                           const std::vector<const recording::Recording*>& recordings, double full_scale_m3_per_s,
                           const std::function<void(double)>& progress) {
  const std::vector<Dial> all = dials(parameters);
  scale_band(parameters, 0.7);  // as wide as most valves need, for the search
  // The recording's supply may be steady. Friction must be found so that the pressure is found again where it is not.
  const sensor::PressureParameters<double> given_supply = parameters.pressure;
  constexpr double lively = 0.3;
  parameters.pressure.least_liveliness = parameters.pressure.first_liveliness = lively;
  std::vector<double> prior;
  for (const Dial& dial : all) prior.push_back(*dial.value);
  // An operating recording shows one supply and one oil temperature: a parameter moves only where that pays.
  const auto cost = [&] {
    constexpr double pull = 0.1;
    double distance2 = 0;
    for (std::size_t k = 0; k < all.size(); ++k) distance2 += std::pow(std::log(*all[k].value / prior[k]), 2);
    return operation_score(parameters, recordings, full_scale_m3_per_s) * (1 + pull * distance2);
  };

  OperationFit out{};
  out.score_before = operation_score(parameters, recordings, full_scale_m3_per_s);
  double best = cost();
  constexpr int rounds = 20;
  constexpr double first_step = 1.35;  // as a factor
  std::vector<double> step(all.size(), first_step);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      progress((round + static_cast<double>(k) / static_cast<double>(all.size())) / rounds);
      const double before = *all[k].value;
      bool better = false;
      for (const double factor : {step[k], 1 / step[k]}) {
        *all[k].value = std::clamp(before * factor, all[k].lowest, all[k].highest);
        const double tried = cost();
        better = tried < best;
        if (better) {
          best = tried;
          break;
        }
        *all[k].value = before;
      }
      step[k] = better ? std::min(2.0, 1 + 1.3 * (step[k] - 1)) : 1 + 0.6 * (step[k] - 1);
    }
  }

  out.score = operation_score(parameters, recordings, full_scale_m3_per_s);
  parameters.pressure = given_supply;
  out.force_error_ratio = force_error_ratio(parameters, recordings);
  scale_band(parameters, out.force_error_ratio);
  const Outcome outcome = replay_all(parameters, recordings);
  out.flow_m3_per_s = outcome.error;
  out.samples = outcome.error.samples;
  out.band_coverage = static_cast<double>(outcome.inside) / static_cast<double>(std::max<std::size_t>(1, out.samples));
  return out;
}

}  // namespace spoolflow::calibration
