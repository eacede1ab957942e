#include "spoolflow/uncertainty/point_function.hpp"

#include <cmath>
#include <memory>

#include "spoolflow/uncertainty/condensed_slopes.hpp"
#include "spoolflow/uncertainty/seeded_numbers.hpp"

namespace spoolflow::uncertainty {

std::optional<PointFunction> PointFunction::at(const model::Model& model, estimation::Estimator estimator,
                                               const WorkingPoint& point) {
  PointFunction out(model, estimator, point);
  if (estimator == estimation::Estimator::condensed) {
    const std::optional<double> current_A = balanced_current_A(model, point);
    if (!current_A) return std::nullopt;
    out.sample_ = {0, *current_A, 0, point.position_m, point.oil_temperature_K};
    out.surroundings_ = surroundings_at(model, point, *current_A);
    return out;
  }
  auto course = course_to(model, point);
  if (!course) return std::nullopt;
  out.course_ = std::move(*course);
  out.temperature_per_viscosity_K_ = temperature_per_viscosity_K(model.fluid, point.oil_temperature_K);
  out.learn_belief();
  return out;
}

double PointFunction::operator()(const InputErrors<double>& error, SeededNumbers& noise) const {
  return estimator_ == estimation::Estimator::condensed ? condensed(error) : observer(error, noise);
}

double PointFunction::condensed(const InputErrors<double>& error) const {
  const auto valve = disturbed<double>(model_->condensed.parameters, error);
  const sensor::Sample<double> sample = disturbed(sample_, surroundings_, error);
  const auto tables = std::make_unique_for_overwrite<sensor::CondensedTables<double>>();
  sensor::lay_out_at(valve, sample.position_m, *tables);
  sensor::CondensedState<double> state;
  return sensor::step(*tables, state, sample).flow_m3_per_s - unseen_flow_m3_per_s(surroundings_, error);
}

double PointFunction::observer(const InputErrors<double>& error, SeededNumbers& noise) const {
  const auto valve = disturbed(model_->observer->parameters, error, temperature_per_viscosity_K_);
  estimation::RunningSensor sensor(&valve, model_->valve.rated_flow_m3_per_s);
  NoisyErrors noisy(error, noise);
  sensor::Estimate<double> answer;
  for (const estimation::TimedSample& given : course_) answer = sensor.step(disturbed(given, noisy.next()));
  const double u_Pa = belief_.standard_uncertainty_Pa();
  return answer.flow_m3_per_s + error[InputQuantity::flow_map] +
         (u_Pa > 0 ? belief_.flow_error_m3_per_s(error[InputQuantity::pressure_belief] / u_Pa) : 0);
}

void PointFunction::learn_belief() {
  const auto& valve = model_->observer->parameters;
  estimation::RunningSensor sensor(&valve, model_->valve.rated_flow_m3_per_s);
  for (const estimation::TimedSample& sample : course_) sensor.step(sample);
  const std::size_t last = course_.size() - 1;
  belief_ = pressure_belief(valve, sensor.state().observer, course_[last].position_m,
                            course_[last].time_s - course_[last - 1].time_s);
}

double PointFunction::current_A() const {
  return estimator_ == estimation::Estimator::condensed ? sample_.current_A : course_.back().current_A;
}

double PointFunction::position_reading_m() const {
  return estimator_ == estimation::Estimator::condensed ? sample_.position_m : course_.back().position_m;
}

Budget PointFunction::budget(const Inputs& inputs, int noise_runs) const {
  std::vector<BudgetLine> lines;
  SeededNumbers none(0, "");
  const double undisturbed = (*this)({}, none);
  PerQuantity<double> slopes;
  if (estimator_ == estimation::Estimator::condensed) slopes = CondensedSlopes(*model_).at(sample_, surroundings_);
  for (const InputUncertainty& input : inputs.uncertainties) {
    BudgetLine line{input};
    line.degrees_of_freedom = input.degrees_of_freedom;
    double& u = line.input.standard_uncertainty;
    if (input.quantity == InputQuantity::pressure_belief) u = belief_.standard_uncertainty_Pa();
    const bool noise =
        input.quantity == InputQuantity::position_noise || input.quantity == InputQuantity::current_noise;
    InputErrors<double> error;
    if (estimator_ == estimation::Estimator::condensed) {
      line.sensitivity_m3_per_s = slopes[input.quantity];
    } else if (noise && u > 0) {
      double squares = 0;
      error[input.quantity] = u;
      for (int run = 0; run < noise_runs; ++run) {
        SeededNumbers numbers(1, about(input.quantity).name, static_cast<std::uint64_t>(run));
        squares += std::pow((*this)(error, numbers) - undisturbed, 2);
      }
      line.sensitivity_m3_per_s = std::sqrt(squares / noise_runs) / u;
      line.degrees_of_freedom = std::min(line.degrees_of_freedom, static_cast<double>(noise_runs));
    } else if (u > 0) {
      error[input.quantity] = u;
      const double above = (*this)(error, none);
      error[input.quantity] = -u;
      line.sensitivity_m3_per_s = (above - (*this)(error, none)) / (2 * u);
    }
    line.contribution_m3_per_s = line.sensitivity_m3_per_s * u;
    lines.push_back(std::move(line));
  }
  return combine(std::move(lines), inputs.correlations);
}

}  // namespace spoolflow::uncertainty
