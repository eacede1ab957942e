#include "spoolflow/monitor/monitor.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/monitor/healthy_spread.hpp"
#include "spoolflow/monitor/indicators.hpp"
#include "spoolflow/numerics/number_check.hpp"
#include "spoolflow/sensor/signals/oil_temperature.hpp"

namespace spoolflow::monitor {
namespace {

/// A longer step [s] between two samples is a gap: nothing is carried over it.
constexpr double longest_step_s = 0.1;
/// The oil temperature is smoothed over this [s].
constexpr double oil_smoothing_s = 2;

const sensor::ObserverParameters<double>& parameters(const model::Model& model, bool opens_a) {
  return opens_a ? model.p_to_a->observer->parameters : model.observer->parameters;
}

/// Odds from which a cause is reported before its charts have decided: it is suspected, and raises no sign.
constexpr double suspicion_odds = 10;

using sensor::has;

bool status_raised(const StatusShares& shares, sensor::Status status) {
  const std::size_t k = rule_of(status);
  return k < status_rules.size() && shares.raised[k];
}

}  // namespace

Monitor::Monitor(const model::Model& model, const Options& options, const std::optional<Baseline>& baseline)
    : model_(&model), limits_(limits_for(options.false_alarms_per_year)) {
  if (!model.has_observer()) {
    throw model::ModelError(
        "the model of " + model.valve.name +
        " is not calibrated for the observer, which the monitor needs; calibrate it again with this "
        "program from a campaign with bench tests of solenoid and axial force");
  }
  if (baseline && baseline->model != fingerprint(model)) {
    throw model::ModelError("the baseline was learnt with another model than that of " + model.valve.name +
                            "; learn it again with this one, or name the model that it was learnt with");
  }
  for (std::size_t k = 0; k < sides(); ++k) {
    reference_[k].valve = &parameters(model, k == 1);
    reference_[k].stroke_m = model.valve.stroke_m;
    reference_[k].largest_voltage_V = estimation::coil_limits(*reference_[k].valve).voltage_V;
    reference_[k].whole = model.whole();
    reference_[k].healthy = healthy_spread_of(model::of_direction(model, k == 1 ? "a" : "b"));
    reference_[k].baseline = baseline ? baseline->side[k] : DirectionBaseline{.spread = reference_[k].healthy};
  }
  if (baseline) {
    dither_amplitude_A_ = baseline->dither_amplitude_A;
    dither_frequency_Hz_ = baseline->dither_frequency_Hz;
  }
}

bool Monitor::set_state(const MonitorState& state) {
  if (state.version != watch_state_version || !numerics::holds_numbers(state)) return false;
  state_ = state;
  return true;
}

void Monitor::take(const estimation::TimedSample& sample, const sensor::Estimate<double>& answer,
                   double position_set_m) {
  const double since_s = sample.time_s - state_.last_time_s;
  const bool timed = std::isfinite(sample.time_s);
  const bool follows = state_.started && timed && since_s > 0 && since_s <= longest_step_s;
  if (timed) {
    state_.last_time_s = sample.time_s;
    state_.started = true;
  }
  const double time_step_s = follows ? since_s : 0.0;
  follow_status(state_.status, answer.status, time_step_s);
  constexpr sensor::Status held =
      sensor::Status::sample_missing | sensor::Status::time_fault | sensor::Status::position_fault;
  const bool usable = std::isfinite(sample.position_m) && !has(answer.status, sensor::Status::sample_missing) &&
                      !has(answer.status, sensor::Status::time_fault);
  if (usable && sensor::is_oil_temperature(sample.oil_temperature_K) &&
      !has(answer.status, sensor::Status::temperature_fault)) {
    const bool first = !(state_.oil_temperature_K > 0);
    const double pace = first ? 1.0 : std::min(time_step_s / oil_smoothing_s, 1.0);
    state_.oil_temperature_K += pace * (sample.oil_temperature_K - state_.oil_temperature_K);
  }
  if (usable && !has(answer.status, uncounted)) {
    const sensor::ObserverParameters<double>& valve = *reference_[0].valve;
    const bool driven = !(std::abs(sample.current_A) < silent_current_share * valve.largest_current_A) ||
                        std::abs(sample.current_a_A) > silent_current_share * valve.largest_current_A;
    count(state_.usage,
          {model_->valve.stroke_m, model_->valve.rated_flow_m3_per_s, valve.edge.highest_pressure_difference_Pa()},
          {time_step_s, sample.position_m, driven, answer.flow_m3_per_s, answer.pressure_difference_Pa});
  }
  const bool judged =
      follows && usable && (static_cast<std::uint32_t>(answer.status) & static_cast<std::uint32_t>(held)) == 0;
  if (!judged) {
    for (DirectionState& side : state_.side) leave(side);
    leave(state_.centre);
    interrupt(state_.dither);
    interrupt(state_.response);
    return;
  }
  take_command(position_set_m, sample.position_m, time_step_s);
  take_motion(sample, answer, time_step_s);
  if (model_->whole()) take_centre(sample, time_step_s);
}

double Monitor::beyond_pressure_share() const {
  constexpr double shortest_s = 20;
  if (model::declares_pressure(*reference_[0].valve) || state_.usage.watched_s < shortest_s) return 0;
  return std::min(mean_share(state_.status, sensor::Status::outside_flow_force_map, state_.usage.watched_s),
                  highest_pressure_share(state_.usage));
}

/// Of a recording with one current, that of the active coil, the other is silent.
void Monitor::take_centre(const estimation::TimedSample& sample, double time_step_s) {
  const auto silent = [&](double current_A, std::size_t side) {
    return !(std::abs(current_A) > silent_current_share * reference_[side].valve->largest_current_A);
  };
  const sensor::ObserverParameters<double>& valve = *reference_[0].valve;
  const double oil_K = state_.oil_temperature_K > 0 ? state_.oil_temperature_K : valve.edge.temperature_K.at(1);
  monitor::take_centre(
      reference_, limits_, state_.side, state_.centre,
      {time_step_s, sensor::drift_free_m(valve.position_sensor, sample.position_m, oil_K),
       std::isfinite(sample.current_A) && silent(sample.current_A, 0) && silent(sample.current_a_A, 1)});
}

void Monitor::take_command(double position_set_m, double position_m, double time_step_s) {
  if (!std::isfinite(position_set_m) || !std::isfinite(position_m)) return;
  follow(state_.response, model_->valve.stroke_m, {time_step_s, position_set_m, position_m});
}

void Monitor::take_motion(const estimation::TimedSample& sample, const sensor::Estimate<double>& answer,
                          double time_step_s) {
  const bool opens_a = model_->whole() && sample.position_m < 0;
  const std::size_t own = opens_a ? 1 : 0;
  if (model_->whole()) leave(state_.side[1 - own]);
  const DirectionReference& reference = reference_[own];
  const sensor::ObserverParameters<double>& valve = *reference.valve;
  const double sign = opens_a ? -1 : 1;
  const bool of_a = opens_a && std::isfinite(sample.current_a_A);
  const double oil_K = state_.oil_temperature_K > 0 ? state_.oil_temperature_K : valve.edge.temperature_K.at(1);
  const double raw_m = sign * sample.position_m;
  const double position_m = sensor::drift_free_m(valve.position_sensor, raw_m, oil_K);
  const double net_force_N = sign * answer.magnetic_force_N - valve.spring.at(position_m).value;
  const FinderSample motion{.time_s = sample.time_s,
                            .time_step_s = time_step_s,
                            .position_m = position_m,
                            .net_force_N = net_force_N,
                            .friction_N = sign * answer.friction_force_N,
                            .current_A = of_a ? sample.current_a_A : sample.current_A,
                            .oil_temperature_K = oil_K,
                            .pressure_difference_Pa = answer.pressure_difference_Pa,
                            .sliding = !has(answer.status, sensor::Status::spool_at_rest),
                            .dithered = has(answer.status, sensor::Status::dithered)};
  double voltage_V = of_a ? sample.voltage_a_V : sample.voltage_V;
  estimation::take_away(voltage_V, reference.largest_voltage_V, estimation::not_measured);
  if (std::isfinite(motion.current_A))
    follow(state_.dither, valve.largest_current_A, {time_step_s, motion.current_A, motion.sliding});
  monitor::take(reference, limits_, state_.side[own],
                {motion, voltage_V, raw_m, std::isfinite(motion.current_A) && std::isfinite(net_force_N)});
}

void Monitor::finish() {
  for (std::size_t k = 0; k < sides(); ++k) monitor::finish(reference_[k], limits_, state_.side[k]);
}

std::vector<Indicator> Monitor::indicators() const {
  std::vector<Indicator> out;
  for (std::size_t k = 0; k < sides(); ++k) add_direction(reference_[k], state_.side[k], k == 1, out);
  if (model_->whole()) add_centre(reference_, state_.side, state_.centre, out);
  add_command_response(state_.response, out);
  add_dither_health(state_.dither, dither_amplitude_A_, dither_frequency_Hz_, out);
  add_usage(state_.usage, judged_windows(), out);
  return out;
}

std::vector<Cause> Monitor::causes() const {
  std::array<double, faults> odds{};
  for (std::size_t k = 0; k < sides(); ++k) {
    const DirectionState& side = state_.side[k];
    if (!raised(side) && side.learnt.shape.weight == 0) continue;
    const Isolation found = isolation_of(reference_[k], side);
    const bool decided = monitor::decided(side, found);
    std::size_t best = 0;
    bool explained = false;
    for (std::size_t f = 0; f < isolated_faults; ++f) {
      if (found.odds[f] > found.odds[best]) best = f;
      if (found.odds[f] < (decided ? 1.0 : suspicion_odds)) continue;
      explained = true;
      odds[f] = std::max(odds[f], found.odds[f]);
    }
    if (explained || !decided) continue;
    // Something is wrong: the likeliest explanation, or that there is none.
    const bool likely = found.odds[best] > least_reported_odds;
    const std::size_t reported = likely ? best : static_cast<std::size_t>(Fault::wrong_model);
    odds[reported] = std::max(odds[reported], likely ? found.odds[best] : found.unexplained_odds);
  }
  const bool resistive = std::ranges::any_of(state_.side, [](const DirectionState& side) { return side.resistive; });
  if (resistive || status_raised(state_.status, sensor::Status::coil_fault))
    odds[static_cast<std::size_t>(Fault::coil)] = most_odds;
  if (status_raised(state_.status, sensor::Status::temperature_fault))
    odds[static_cast<std::size_t>(Fault::temperature_sensor)] = most_odds;
  if (status_raised(state_.status, sensor::Status::position_fault))
    odds[static_cast<std::size_t>(Fault::position_sensor)] = most_odds;
  std::vector<Cause> out;
  for (std::size_t f = 0; f < faults; ++f) {
    if (odds[f] > 0) out.push_back({static_cast<Fault>(f), odds[f]});
  }
  std::ranges::stable_sort(out, [](const Cause& a, const Cause& b) { return a.odds > b.odds; });
  return out;
}

Ne107 Monitor::condition() const {
  Ne107 worst = monitor::sign_of(state_.status);
  bool any = false;
  for (std::size_t k = 0; k < sides(); ++k) {
    const DirectionState& side = state_.side[k];
    any = any || side.resistive || (raised(side) && decided(side, isolation_of(reference_[k], side)));
  }
  if (!any) return worst;
  for (const Cause& cause : causes()) worst = std::max(worst, sign_of(cause.fault));
  return worst;
}

Findings Monitor::findings() const {
  Findings out;
  for (std::size_t k = 0; k < sides(); ++k) {
    if (!raised(state_.side[k])) continue;
    const Isolation found = isolation_of(reference_[k], state_.side[k]);
    if (!decided(state_.side[k], found)) continue;
    out.side[k] = {true, found.likeliest, found.value, found.deviation};
  }
  return out;
}

Doubt Monitor::doubt() const {
  Doubt out;
  const Findings found = findings();
  for (std::size_t k = 0; k < sides(); ++k) out.side[k] = {found.side[k].raised, found.side[k].value};
  return out;
}

double Monitor::judged_windows() const {
  double sum = 0;
  for (std::size_t k = 0; k < sides(); ++k) sum += state_.side[k].windows;
  return sum;
}

Baseline Monitor::learnt() const {
  Baseline out{fingerprint(*model_), {}};
  if (state_.dither.dithered_s >= least_dithered_s) {
    out.dither_amplitude_A = state_.dither.amplitude_A;
    out.dither_frequency_Hz = state_.dither.frequency_Hz;
  }
  for (std::size_t k = 0; k < sides(); ++k) out.side[k] = baseline_of(reference_[k], state_.side[k]);
  return out;
}

}  // namespace spoolflow::monitor
