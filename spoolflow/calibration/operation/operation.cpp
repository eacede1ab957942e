#include "spoolflow/calibration/operation/operation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "spoolflow/calibration/operation/identifiable_parameters.hpp"
#include "spoolflow/calibration/operation/operation_score.hpp"
#include "spoolflow/calibration/operation/operation_uncertainty.hpp"
#include "spoolflow/parallel/for_each.hpp"

namespace spoolflow::calibration {
namespace {

/// Pattern search: one parameter after the other, by a factor that grows where it helps and shrinks where it does not.
/// A larger and a smaller value are tried at once. Leaves the best values in both trials.
void search(const std::vector<OperationParameter>& fitted, std::array<OperationTrial, 2>& trials,
            const std::function<double(OperationTrial&)>& cost, const std::function<void(double)>& progress) {
  double best = cost(trials[0]);
  constexpr int rounds = 20;
  constexpr double first_step = 1.35;  // as a factor
  std::vector<double> step(fitted.size(), first_step);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < fitted.size(); ++k) {
      progress((round + static_cast<double>(k) / static_cast<double>(fitted.size())) / rounds);
      const double before = fitted[k].in(trials[0]);
      std::array<double, 2> tried{};
      parallel::for_each(trials.size(), parallel::cores(), [&](std::size_t t) {
        const double factor = t == 0 ? step[k] : 1 / step[k];
        fitted[k].in(trials[t]) = std::clamp(before * factor, fitted[k].lowest, fitted[k].highest);
        tried[t] = cost(trials[t]);
      });
      const std::size_t chosen = tried[0] < best ? 0 : 1;
      const bool better = tried[chosen] < best;
      const double value = better ? fitted[k].in(trials[chosen]) : before;
      for (OperationTrial& trial : trials) fitted[k].in(trial) = value;
      if (better) best = tried[chosen];
      step[k] = better ? std::min(2.0, 1 + 1.3 * (step[k] - 1)) : 1 + 0.6 * (step[k] - 1);
    }
  }
}

/// Names of those of all parameters that are not identifiable.
std::vector<std::string> not_identifiable(const std::vector<OperationParameter>& identifiable) {
  std::vector<std::string> out;
  for (const OperationParameter& parameter : operation_parameters()) {
    if (std::ranges::none_of(identifiable, [&](const OperationParameter& each) { return each.in == parameter.in; }))
      out.emplace_back(parameter.name);
  }
  return out;
}

}  // namespace

OperationFit fit_operation(sensor::ObserverParameters<double>& parameters, const std::vector<OperatingRun>& recorded,
                           const InOperation& valve, const std::function<void(double)>& progress) {
  const double full_scale_m3_per_s = valve.rated_flow_m3_per_s;
  OperationFit out{};
  const std::vector<OperatingRun> runs = with_meters(parameters, recorded);
  for (const OperatingRun& run : runs) out.meters.push_back(run.meter);
  const bool rests = undithered_rest_s(parameters, runs) >= least_undithered_rest_s;
  if (!rests) assume_rest(parameters);
  scale_band(parameters, 1.1);  // wider than most valves need: the search must not pay for a narrow band with friction
  // The recording's supply may be steady. Friction must be found so that the pressure is found again where it is not.
  const sensor::PressureParameters<double> given_supply = parameters.pressure;
  constexpr double restless = 0.3;
  parameters.pressure.first_process_noise = restless;
  parameters.pressure.least_process_noise = restless * restless;
  // Dither that hardly frees the spool shows of friction, and the search must not pass it by.
  const double given_freeing_share = parameters.friction.freeing_share;
  parameters.friction.freeing_share = 1;
  std::array<OperationTrial, 2> trials{OperationTrial(parameters, runs), OperationTrial(parameters, runs)};
  std::vector<OperationParameter> all = identifiable_parameters(trials[0], full_scale_m3_per_s);
  out.not_identifiable = not_identifiable(all);
  if (valve.mass_is_declared)
    std::erase_if(all, [](const OperationParameter& each) { return std::string_view(each.name) == "moving_mass_kg"; });
  // An operating recording shows one supply and one oil temperature: a parameter moves only where that pays. One that
  // is known beforehand moves little.
  constexpr double pull = 0.1, pull_of_known = 3;
  std::vector<double> prior, pulls;
  for (const OperationParameter& parameter : all) {
    const bool known = valve.friction_is_known && std::string_view(parameter.name).starts_with("operation_friction");
    prior.push_back(parameter.in(trials[0]));
    pulls.push_back(known ? pull_of_known : pull);
  }
  const auto cost = [&](OperationTrial& trial) {
    double share = 0;
    for (std::size_t k = 0; k < all.size(); ++k) share += pulls[k] * std::pow(std::log(all[k].in(trial) / prior[k]), 2);
    return operation_score(trial, full_scale_m3_per_s) * (1 + share);
  };

  out.score_before = operation_score(trials[0], full_scale_m3_per_s);
  search(all, trials, cost, progress);
  out.score = operation_score(trials[0], full_scale_m3_per_s);
  out.known = known_of_operation(all, trials[0], full_scale_m3_per_s, pull * out.score);
  parameters = trials[0].parameters();
  for (const OperatingRun& run : runs) {
    if (run.other != nullptr) *run.other = trials[0].other();
  }
  parameters.pressure = given_supply;
  out.force_error_ratio = force_error_ratio(parameters, runs);
  if (!rests) out.force_error_ratio = std::max(out.force_error_ratio, least_dithered_force_error_ratio);
  scale_band(parameters, out.force_error_ratio);
  parameters.friction.freeing_share = given_freeing_share;
  const OperationOutcome outcome = replay_whole(parameters, runs);
  out.flow_m3_per_s = outcome.error;
  out.samples = outcome.error.samples;
  out.band_coverage = outcome.coverage();
  return out;
}

}  // namespace spoolflow::calibration
