#include "spoolflow/validation/estimation.hpp"

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

namespace {

model::RunningSensor::Parameters parameters(const model::Model& model, Estimator estimator) {
  if (estimator == Estimator::condensed) return &model.condensed.parameters;
  if (!model.observer) {
    throw model::ModelError(
        fmt::format("the model of {} is not calibrated for the observer; calibrate it again with this "
                    "program, or use --estimator condensed",
                    model.valve.name));
  }
  return &model.observer->parameters;
}

}  // namespace

Estimation::Estimation(const model::Model& model, Estimator estimator)
    : sensor_(parameters(model, estimator), model.valve.rated_flow_m3_per_s) {}

void Estimation::run(const recording::SampleBlock& block, std::vector<sensor::Estimate<double>>& estimates) {
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
  estimates.resize(block.rows);
  for (std::size_t k = 0; k < block.rows; ++k) {
    estimates[k] = sensor_.step({time_s[k], current_A[k], voltage_V == nullptr ? nothing : voltage_V[k], position_m[k],
                                 temperature_K == nullptr ? nothing : temperature_K[k]});
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
