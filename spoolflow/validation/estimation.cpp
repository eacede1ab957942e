#include "spoolflow/validation/estimation.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace spoolflow::validation {

using recording::Channel;

std::string_view name(Estimator estimator) {
  return estimator == Estimator::condensed ? "condensed" : "observer";
}

Estimator best_estimator(const model::Model& model) {
  return model.observer ? Estimator::observer : Estimator::condensed;
}

recording::ReadOptions sensor_channels(const model::Model& model, recording::ChannelMap channels) {
  return {std::move(channels),
          {Channel::time, Channel::current, Channel::position},
          {Channel::voltage, Channel::oil_temperature},
          model.valve.stroke_m};
}

Estimation::Estimation(const model::Model& model, Estimator estimator) : model_(model) {
  if (estimator == Estimator::observer) {
    if (!model.observer) {
      throw model::ModelError(
          fmt::format("the model of {} is not calibrated for the observer; calibrate it again with this "
                      "program, or use --estimator condensed",
                      model.valve.name));
    }
    state_ = sensor::ObserverState<double>{};
  }
}

template <class Parameters, class State>
void Estimation::run_with(const Parameters& parameters, State& state, const recording::SampleBlock& block,
                          std::vector<sensor::Estimate<double>>& estimates) {
  const auto column = [&](Channel channel) -> const std::vector<double>& {
    return block.columns[static_cast<std::size_t>(channel)];
  };
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const double* const time_s = column(Channel::time).data();
  const double* const current_A = column(Channel::current).data();
  const double* const position_m = column(Channel::position).data();
  const double* const voltage_V = column(Channel::voltage).empty() ? nullptr : column(Channel::voltage).data();
  const double* const temperature_K =
      column(Channel::oil_temperature).empty() ? nullptr : column(Channel::oil_temperature).data();
  for (std::size_t k = 0; k < block.rows; ++k) {
    const double step_s = started_ ? time_s[k] - last_time_s_ : 0.0;
    started_ = true;
    last_time_s_ = time_s[k];
    estimates[k] = step(parameters, state,
                        sensor::Sample<double>{step_s, current_A[k], voltage_V == nullptr ? nothing : voltage_V[k],
                                               position_m[k], temperature_K == nullptr ? nothing : temperature_K[k]});
    if (!answered_) {
      answered_ = !sensor::has(estimates[k].status, sensor::Status::sample_missing);
      if (!answered_) estimates[k].flow_upper_m3_per_s = model_.valve.rated_flow_m3_per_s;
    }
  }
}

void Estimation::run(const recording::SampleBlock& block, std::vector<sensor::Estimate<double>>& estimates) {
  estimates.resize(block.rows);
  if (auto* state = std::get_if<sensor::ObserverState<double>>(&state_)) {
    run_with(model_.observer->parameters, *state, block, estimates);
  } else {
    run_with(model_.condensed.parameters, std::get<sensor::CondensedState<double>>(state_), block, estimates);
  }
}

std::string_view StatusText::operator()(sensor::Status status) {
  if (status == sensor::Status::none) return {};
  for (const auto& [bits, text] : known_) {
    if (bits == status) return text;
  }
  std::string text;
  for (const sensor::StatusName& entry : sensor::status_names) {
    if (!sensor::has(status, entry.bit)) continue;
    if (!text.empty()) text += '|';
    text += entry.name;
  }
  known_.emplace_back(status, std::move(text));
  return known_.back().second;
}

}  // namespace spoolflow::validation
