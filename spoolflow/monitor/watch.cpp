#include "spoolflow/monitor/watch.hpp"

#include <cmath>
#include <stdexcept>

namespace spoolflow::monitor {
namespace {

/// A longer step [s] between two samples is a gap: nothing is carried over it.
constexpr double longest_step_s = 0.1;

}  // namespace

Watch::Watch(const model::Model& model) : model_(&model) {
  if (!model.has_observer()) {
    throw model::ModelError(
        "the model of " + model.valve.name +
        " is not calibrated for the observer, which the monitor needs; calibrate it again with this "
        "program from a campaign with bench tests of solenoid and axial force");
  }
}

const sensor::ObserverParameters<double>& Watch::side(bool opens_a) const {
  return opens_a ? model_->p_to_a->observer->parameters : model_->observer->parameters;
}

bool Watch::set_state(const WatchState& state) {
  if (state.version != watch_state_version) return false;
  state_ = state;
  return true;
}

void Watch::take(std::span<const estimation::TimedSample> samples, std::span<const sensor::Estimate<double>> answers) {
  if (samples.size() != answers.size()) throw std::invalid_argument("as many answers as samples are needed");
  for (std::size_t k = 0; k < samples.size(); ++k) take(samples[k], answers[k]);
}

void Watch::take(const estimation::TimedSample& sample, const sensor::Estimate<double>& answer) {
  const double since_s = sample.time_s - state_.last_time_s;
  const bool timed = std::isfinite(sample.time_s);
  const bool follows = state_.started && timed && since_s > 0 && since_s <= longest_step_s;
  if (timed) {
    state_.last_time_s = sample.time_s;
    state_.started = true;
  }
  const double time_step_s = follows ? since_s : 0.0;
  follow_status(state_.status, answer.status, time_step_s);
  const bool opens_a = model_->whole() && sample.position_m < 0;
  const bool of_a = opens_a && std::isfinite(sample.current_a_A);
  const double current_A = of_a ? sample.current_a_A : sample.current_A;
  const double voltage_V = of_a ? sample.voltage_a_V : sample.voltage_V;
  if (sensor::has(answer.status, sensor::Status::sample_missing) ||
      sensor::has(answer.status, sensor::Status::time_fault) || !std::isfinite(sample.position_m) ||
      !std::isfinite(current_A)) {
    for (WindingState& winding : state_.winding) begin_winding_window(winding);
    return;
  }
  const sensor::ObserverParameters<double>& valve = side(opens_a);
  const double highest_Pa = valve.edge.highest_pressure_difference_Pa();
  if (std::isfinite(sample.oil_temperature_K)) state_.oil_temperature_K = sample.oil_temperature_K;
  const bool driven = current_A > winding_current_share * valve.largest_current_A;
  count(state_.usage, {model_->valve.stroke_m, model_->valve.rated_flow_m3_per_s, highest_Pa},
        {time_step_s, sample.position_m, driven, answer.flow_m3_per_s, answer.pressure_difference_Pa});
  if (!follows || !std::isfinite(voltage_V)) {
    begin_winding_window(state_.winding[opens_a ? 1 : 0]);
    return;
  }
  begin_winding_window(state_.winding[opens_a ? 0 : 1]);
  follow_winding(valve.actuator, valve.largest_current_A, state_.winding[opens_a ? 1 : 0],
                 {time_step_s, current_A, voltage_V, std::abs(sample.position_m), state_.oil_temperature_K});
}

std::vector<Indicator> Watch::indicators() const {
  std::vector<Indicator> out;
  const auto counted = [&](std::string_view name, double value, std::string_view unit) {
    out.push_back({name, value, unit, 0, estimation::not_measured, IndicatorState::counts});
  };
  const Usage& usage = state_.usage;
  for (const bool a : {false, true}) {
    if (a && !model_->whole()) continue;
    const WindingState& winding = state_.winding[a ? 1 : 0];
    const bool known = winding.windows > 0;
    out.push_back(
        {a ? "coil_resistance_a" : "coil_resistance", known ? winding.resistance_Ohm : estimation::not_measured, "Ohm",
         known ? 2 * resistance_deviation_Ohm(winding) : estimation::not_measured,
         side(a).actuator.coil_resistance.resistance_Ohm, known ? IndicatorState::good : IndicatorState::unknown});
  }
  counted("watched_time", usage.watched_s, "s");
  counted("driven_time", usage.driven_s, "s");
  counted("strokes", static_cast<double>(usage.strokes), "1");
  counted("reversals", static_cast<double>(usage.reversals), "1");
  counted("distance", usage.distance_m, "m");
  counted("oil_volume", usage.volume_m3, "m3");
  counted("hydraulic_energy", usage.energy_J, "J");
  return out;
}

std::vector<Cause> Watch::causes() const {
  return {};
}

Ne107 Watch::condition() const {
  return sign_of(state_.status);
}

}  // namespace spoolflow::monitor
