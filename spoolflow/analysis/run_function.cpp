#include "spoolflow/analysis/run_function.hpp"

#include <algorithm>

#include "spoolflow/analysis/run_samples.hpp"
#include "spoolflow/estimation/columns.hpp"
#include "spoolflow/numerics/meter_lag.hpp"
#include "spoolflow/uncertainty/seeded_numbers.hpp"

namespace spoolflow::analysis {

using estimation::Estimator;
using uncertainty::InputErrors;
using uncertainty::InputQuantity;
using uncertainty::SeededNumbers;

void BandedFlow::add(const sensor::Estimate<double>& answer, double shift_m3_per_s) {
  flow_m3_per_s.push_back(answer.flow_m3_per_s + shift_m3_per_s);
  lower_m3_per_s.push_back(answer.flow_lower_m3_per_s + shift_m3_per_s);
  upper_m3_per_s.push_back(answer.flow_upper_m3_per_s + shift_m3_per_s);
}

RunFunction::RunFunction(const model::Model& model, Estimator estimator, const RunSamples& run)
    : model_(model),
      estimator_(estimator),
      run_(run),
      temperature_per_viscosity_K_(
          uncertainty::temperature_per_viscosity_K(model.fluid, uncertainty::map_temperature_K(model))) {
  run_undisturbed();
  if (estimator == Estimator::condensed) learn_surroundings();
}

void RunFunction::run_undisturbed() {
  estimation::RunningSensor sensor = estimation::running_sensor(model_, estimator_);
  auto instant = run_.instants.begin();
  estimation::run(sensor, run_.samples, [&](std::size_t k, const sensor::Estimate<double>& answer) {
    every_flow_m3_per_s_.push_back(answer.flow_m3_per_s);
    if (instant == run_.instants.end() || *instant != k) return;
    ++instant;
    undisturbed_.add(answer);
    pressure_Pa_.push_back(answer.pressure_difference_Pa);
    if (estimator_ != Estimator::observer) return;
    const double step_s = k == 0 ? 0 : run_.samples[k].time_s - run_.samples[k - 1].time_s;
    beliefs_.push_back(uncertainty::pressure_belief(model_.observer->parameters, sensor.state().observer,
                                                    run_.samples[k].position_m, step_s));
  });
}

void RunFunction::learn_surroundings() {
  for (std::size_t k = 0; k < run_.instants.size(); ++k) {
    const estimation::TimedSample& sample = run_.samples[run_.instants[k]];
    surroundings_.push_back(uncertainty::surroundings_at(
        model_, {sample.position_m, pressure_Pa_[k], uncertainty::map_temperature_K(model_)}, sample.current_A));
  }
}

std::vector<double> RunFunction::lagged_m3_per_s(double lag_s) const {
  std::vector<double> time_s, out;
  for (const estimation::TimedSample& sample : run_.samples) time_s.push_back(sample.time_s);
  std::vector<double> all = every_flow_m3_per_s_;
  numerics::apply_lag<double>(time_s, all, {.lag_s = lag_s});
  for (const std::size_t k : run_.instants) out.push_back(all[k]);
  return out;
}

std::vector<double> RunFunction::belief_m3_per_s() const {
  std::vector<double> out;
  for (const uncertainty::PressureBelief& belief : beliefs_) out.push_back(belief.flow_uncertainty_m3_per_s());
  return out;
}

BandedFlow RunFunction::operator()(const InputErrors<double>& error, SeededNumbers& noise) const {
  return estimator_ == Estimator::condensed ? condensed(error, noise) : observer(error, noise);
}

BandedFlow RunFunction::condensed(const InputErrors<double>& error, SeededNumbers& noise) const {
  const auto valve = uncertainty::disturbed<double>(model_.condensed.parameters, error);
  estimation::RunningSensor sensor(&valve, model_.valve.rated_flow_m3_per_s);  // has no memory: the instants are enough
  uncertainty::NoisyErrors noisy(error, noise);
  BandedFlow out;
  for (std::size_t k = 0; k < run_.instants.size(); ++k) {
    const estimation::TimedSample& given = run_.samples[run_.instants[k]];
    const InputErrors<double>& now = noisy.next();
    out.add(sensor.step(uncertainty::disturbed(given, surroundings_[k], now)),
            -uncertainty::unseen_flow_m3_per_s(surroundings_[k], now));
  }
  return out;
}

BandedFlow RunFunction::observer(const InputErrors<double>& error, SeededNumbers& noise) const {
  const auto valve = uncertainty::disturbed(model_.observer->parameters, error, temperature_per_viscosity_K_);
  estimation::RunningSensor sensor(&valve, model_.valve.rated_flow_m3_per_s);
  uncertainty::NoisyErrors noisy(error, noise);
  BandedFlow out;
  auto instant = run_.instants.begin();
  for (std::size_t k = 0; k < run_.samples.size(); ++k) {
    const auto answer = sensor.step(uncertainty::disturbed(run_.samples[k], noisy.next()));
    if (instant == run_.instants.end() || *instant != k) continue;
    ++instant;
    const uncertainty::PressureBelief& belief = beliefs_[out.flow_m3_per_s.size()];
    out.add(answer, error[InputQuantity::flow_map] + belief.flow_error_m3_per_s(error[InputQuantity::pressure_belief]));
  }
  return out;
}

std::vector<uncertainty::PerQuantity<double>> RunFunction::slopes() const {
  const uncertainty::CondensedSlopes all(model_);
  std::vector<uncertainty::PerQuantity<double>> out;
  const auto& valve = model_.condensed.parameters;
  for (std::size_t k = 0; k < run_.instants.size(); ++k) {
    sensor::Sample<double> sample = uncertainty::without_time(run_.samples[run_.instants[k]]);
    // Beyond the measured forces the sensor answers at the map's edge, whose slope is that of its outermost cell. Below
    // what friction hides the slope of the root runs away: there that at the friction's half width stands for it.
    const double force_N =
        valve.magnetic_force.at(sample.current_A, sample.position_m).value - valve.spring.at(sample.position_m).value;
    const double largest_N = valve.flow_rate.largest_force_N.at(sample.position_m).value;
    const double least_N = std::clamp(surroundings_[k].friction_half_width_N, 0.01 * largest_N, 0.5 * largest_N);
    const double inside_N = std::clamp(force_N, least_N, 0.99 * largest_N);
    sample.current_A += (inside_N - force_N) / surroundings_[k].force_per_current_N_per_A;
    out.push_back(all.at(sample, surroundings_[k]));
  }
  return out;
}

}  // namespace spoolflow::analysis
