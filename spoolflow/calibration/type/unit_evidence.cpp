#include "spoolflow/calibration/type/unit_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/calibration/operation/replay.hpp"
#include "spoolflow/calibration/type/unit_parameters.hpp"
#include "spoolflow/estimation/edge_flow.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

/// Of the force at which a spool breaks away, beside that of forces [N].
constexpr double breakaway_uncertainty_N = 0.5;

double value_or(const recording::Recording& recording, Channel channel, std::size_t k, double otherwise) {
  if (!recording.has(channel)) return otherwise;
  const double value = recording[channel][k];
  return std::isfinite(value) ? value : otherwise;
}

}  // namespace

double force_row_uncertainty_N(const model::Model& type) {
  const sensor::ObserverParameters<double>& parameters = type.observer->parameters;
  return std::hypot(unit_force_residual_N, parameters.band.force_residual_N, parameters.actuator.force_uncertainty_N);
}

double flow_row_uncertainty_m3_per_s(const model::Model& type) {
  return std::hypot(type.observer->parameters.band.flow_residual_m3_per_s,
                    meter_uncertainty_share * type.valve.rated_flow_m3_per_s);
}

UnitEvidence::UnitEvidence(const model::Model& type, std::vector<UnitRun> runs) : type_(type) {
  for (const UnitRun& run : runs) {
    meter_gain_deviation_ = std::max(meter_gain_deviation_, run.meter_gain_deviation);
    const std::size_t before = kinds_.size();
    prepare(run);
    if (kinds_.size() > before) shown_by_.push_back(run.recording->file);
    add_closed_reading();
    add_resistance(run);
  }
}

bool UnitEvidence::any(EvidenceOf kind) const {
  return std::ranges::count(kinds_, kind) > 0;
}

void UnitEvidence::prepare(const UnitRun& of) {
  const recording::Recording& recording = *of.recording;
  const sensor::ObserverParameters<double>& type = type_.observer->parameters;
  Run run{};
  run.pressurised = of.protocol == recording::Protocol::operation;
  run.has_pressure = recording.has(Channel::pressure_difference);
  run.has_flow = run.pressurised && recording.has(Channel::flow_reference);
  estimation::RunningSensor sensor(&type, type_.valve.rated_flow_m3_per_s);
  const estimation::Columns columns = operating_columns(recording);
  SpoolTrack track(type, type_.valve.stroke_m, run.pressurised);
  std::size_t ended = 0;  // the last passage
  double before_s = columns.time_s.empty() ? 0 : columns.time_s[0];
  estimation::run(sensor, columns, [&](std::size_t k, const sensor::Estimate<double>& estimate) {
    const sensor::ObserverState<double>& state = sensor.state().observer;
    const double step_s = columns.time_s[k] - before_s, current_A = columns.current_A[k];
    before_s = columns.time_s[k];
    const double position_m =
        sensor::drift_free_m(type.position_sensor, columns.position_m[k], state.oil.temperature_K);
    const Doing doing =
        track.next(state, estimate.status, {step_s, current_A, {}, columns.position_m[k], {}}, position_m);
    run.samples.push_back(
        {position_m, current_A, step_s, run.pressurised ? value_or(recording, Channel::pressure_difference, k, NAN) : 0,
         value_or(recording, Channel::flow_reference, k, NAN), state.oil.temperature_K, doing.slides ? 0 : -1,
         doing.metered && run.has_flow ? 0 : -1, static_cast<signed char>(doing.direction)});
    if (track.ended()) {
      for (std::size_t back = std::max(track.went_on(), ended) + 1; back <= k; ++back) {
        if (run.samples[back].rested_s == 0) run.samples[back].force_row = -1;
      }
      ended = k;
    }
    if (doing.broke_after_s > 0) add_breakaway(run, k, doing.broke_after_s, state.position.travel_m);
  });
  if (run.has_flow && run.has_pressure) run.meter = meter_of(recording);
  find_rows(run);
  runs_.push_back(std::move(run));
}

/// The lag that the meter shows beside the type's flow at the measured pressure difference.
numerics::MeterLag UnitEvidence::meter_of(const recording::Recording& recording) const {
  const std::vector<double> flow =
      estimation::edge_flow({&type_.observer->parameters}, recording[Channel::position],
                            recording[Channel::pressure_difference], recording.column(Channel::oil_temperature));
  return numerics::find_lag_of_known_flow(recording[Channel::time], flow, recording[Channel::flow_reference])
      .value_or(numerics::MeterLag{});
}

/// The last samples before the spool left where it stood, about to `sample`, at which the motion showed.
void UnitEvidence::add_breakaway(Run& run, std::size_t sample, double rested_s, double travel_m) {
  constexpr std::size_t look_back = 12, mean_over = 3;
  constexpr double left_m = 4e-6;
  if (sample < 2 * look_back) return;
  double rest_m = 0;
  for (std::size_t k = sample - 2 * look_back; k < sample - look_back; ++k)
    rest_m += run.samples[k].position_m / look_back;
  std::size_t last = sample;
  while (last > sample - look_back && std::abs(run.samples[last].position_m - rest_m) > left_m) --last;
  const double stroke_m = type_.valve.stroke_m;
  if (last == sample || last == sample - look_back || rest_m < end_share * stroke_m ||
      rest_m > (1 - end_share) * stroke_m)
    return;
  for (std::size_t k = last + 1 - mean_over; k <= last; ++k) {
    Sample& each = run.samples[k];
    each.force_row = 0;
    each.flow_row = -1;
    each.direction = travel_m > 0 ? 1 : -1;
    each.rested_s = rested_s;
  }
}

/// Numbers the rows, one after the other. Break-aways in the course of a passage have rows of their own.
void UnitEvidence::find_rows(Run& run) {
  const double force_N = force_row_uncertainty_N(type_), flow_m3_per_s = flow_row_uncertainty_m3_per_s(type_);
  const auto number = [&](int Sample::*row, EvidenceOf kind, double deviation, const auto& others) {
    int open = -1, direction = 0;
    double from_m = 0, lasted_s = 0;
    std::size_t first = 0;
    const auto close = [&](std::size_t end) {
      if (open >= 0 && kind != EvidenceOf::breakaway && lasted_s < least_row_s) {
        for (std::size_t k = first; k < end; ++k) {
          if (!others(run.samples[k])) run.samples[k].*row = -1;
        }
        kinds_.pop_back();
        counts_.pop_back();
        deviations_.pop_back();
      }
      open = -1;
    };
    for (std::size_t k = 0; k < run.samples.size(); ++k) {
      Sample& sample = run.samples[k];
      if (others(sample)) {
        lasted_s += sample.time_step_s;
        continue;
      }
      const bool turned = kind != EvidenceOf::flow && sample.direction != direction;  // flow knows no direction
      if (sample.*row < 0 || std::abs(sample.position_m - from_m) > row_travel_m || lasted_s > row_time_s || turned)
        close(k);
      if (sample.*row < 0) continue;
      if (open < 0) {
        open = static_cast<int>(kinds_.size());
        kinds_.push_back(kind);
        counts_.push_back(0);
        deviations_.push_back(deviation);
        from_m = sample.position_m;
        lasted_s = 0;
        direction = sample.direction;
        first = k;
      }
      lasted_s += sample.time_step_s;
      sample.*row = open;
      counts_.back() += 1;
    }
    close(run.samples.size());
  };
  const double highest_Pa = type_.observer->parameters.edge.highest_pressure_difference_Pa();
  for (Sample& sample : run.samples) {
    if (sample.pressure_Pa > (1 + sensor::ripple_share) * highest_Pa) sample.force_row = sample.flow_row = -1;
    if (std::isnan(sample.pressure_Pa)) sample.force_row = sample.flow_row = -1;
    if (std::isnan(sample.flow_m3_per_s)) sample.flow_row = -1;
  }
  const auto breaks_away = [](const Sample& sample) { return sample.rested_s > 0; };
  number(&Sample::force_row, run.pressurised ? EvidenceOf::force : EvidenceOf::unpressurised_force, force_N,
         breaks_away);
  number(&Sample::force_row, EvidenceOf::breakaway, std::hypot(force_N, breakaway_uncertainty_N),
         std::not_fn(breaks_away));
  number(&Sample::flow_row, EvidenceOf::flow, flow_m3_per_s, [](const Sample&) { return false; });
}

/// Where the spool rests at its closed end without current; readings of the unit in the type's drift.
void UnitEvidence::add_closed_reading() {
  const Run& run = runs_.back();
  const sensor::ObserverParameters<double>& type = type_.observer->parameters;
  std::vector<double> readings_m;
  for (const Sample& sample : run.samples) {
    if (std::abs(sample.current_A) < 0.01 * type.largest_current_A && sample.direction == 0 &&
        sample.position_m < type.closed_below_m)
      readings_m.push_back(sample.position_m);
  }
  constexpr std::size_t least_samples = 100;
  if (readings_m.size() < least_samples) return;
  kinds_.push_back(EvidenceOf::closed_reading);
  counts_.push_back(1);
  deviations_.push_back(closed_reading_uncertainty_m);
  closed_readings_m_.push_back(numerics::median(std::move(readings_m)));
}

void UnitEvidence::add_resistance(const UnitRun& of) {
  const recording::Recording& recording = *of.recording;
  const double known_Ohm = type_.observer->parameters.actuator.coil_resistance.resistance_Ohm;
  if (!recording.has(Channel::voltage) || !(known_Ohm > 0)) return;
  const auto voltage_V = recording[Channel::voltage], current_A = recording[Channel::current];
  double voltage_sum = 0, current_sum = 0;  // over whole strokes the flux returns to where it was
  for (std::size_t k = 0; k < voltage_V.size(); ++k) {
    if (!std::isfinite(voltage_V[k]) || !std::isfinite(current_A[k])) continue;
    voltage_sum += voltage_V[k];
    current_sum += current_A[k];
  }
  if (!(current_sum > 0.05 * type_.observer->parameters.largest_current_A * static_cast<double>(voltage_V.size())))
    return;
  kinds_.push_back(EvidenceOf::resistance);
  counts_.push_back(1);
  deviations_.push_back(resistance_uncertainty_share * known_Ohm);
  resistances_Ohm_.push_back(voltage_sum / current_sum);
}

void UnitEvidence::add_forces(const Run& run, const sensor::ObserverParameters<double>& unit,
                              const UnitUnknowns& unknowns, Eigen::VectorXd& sums) const {
  const double unloaded_Pa = unloaded_share * unit.edge.highest_pressure_difference_Pa();
  sensor::ActuatorState<double> actuator{};
  bool first = true;
  for (const Sample& sample : run.samples) {
    if (!std::isfinite(sample.current_A) || !std::isfinite(sample.position_m)) continue;
    const sensor::ActuatorEstimate<double> estimate =
        sensor::step(unit.actuator, actuator,
                     sensor::Sample<double>{sample.time_step_s, sample.current_A, {}, sample.position_m, {}}, first,
                     sample.force_row >= 0);
    first = false;
    if (sample.force_row < 0) continue;
    const sensor::EdgePoint<double> edge =
        unit.edge.at(sample.temperature_K, std::max(0.0, sample.pressure_Pa), sample.position_m);
    const double aged = sample.rested_s > 0 ? sensor::ageing(unit.friction, sample.rested_s) : 1;
    const double friction_N =
        unit.friction.operation_ratio * (aged * edge.friction_N + estimate.friction_half_width_N) +
        unknowns.friction_tilt_N * (2 * sample.position_m / type_.valve.stroke_m - 1) +
        (sample.pressure_Pa < unloaded_Pa ? unknowns.unloaded_friction_N : 0);
    sums(sample.force_row) += estimate.magnetic_force_N - unit.spring.at(sample.position_m).value -
                              (run.pressurised ? edge.flow_force_N : 0) - sample.direction * friction_N;
  }
}

void UnitEvidence::add_flows(const Run& run, const sensor::ObserverParameters<double>& unit,
                             const UnitUnknowns& unknowns, Eigen::VectorXd& sums) const {
  double seen_m3_per_s = NAN, unseen_s = 0;
  numerics::LagShare share_of(run.meter.lag_s + run.meter.dead_time_s);
  for (const Sample& sample : run.samples) {
    const double pressure_Pa = sample.pressure_Pa < 0 ? 0 : sample.pressure_Pa;  // NaN stays one
    const double flow_m3_per_s = unit.edge.at(sample.temperature_K, pressure_Pa, sample.position_m).conductance *
                                 std::sqrt(pressure_Pa) *
                                 (1 + unknowns.conductance_tilt * (2 * sample.position_m / type_.valve.stroke_m - 1));
    unseen_s += sample.time_step_s;
    if (std::isnan(flow_m3_per_s)) continue;
    const double share = std::isnan(seen_m3_per_s) ? 1 : share_of(unseen_s);
    unseen_s = 0;
    if (std::isnan(seen_m3_per_s)) seen_m3_per_s = 0;
    seen_m3_per_s += share * (flow_m3_per_s - seen_m3_per_s);
    if (sample.flow_row >= 0) sums(sample.flow_row) += sample.flow_m3_per_s - (1 + unknowns.meter_gain) * seen_m3_per_s;
  }
}

Eigen::VectorXd UnitEvidence::rows(const UnitUnknowns& unknowns) const {
  sensor::ObserverParameters<double> unit = unit_parameters(type_.observer->parameters, unknowns.deviations);
  unit.friction.ageing_ratio = 1 + (unit.friction.ageing_ratio - 1) * (1 + unknowns.ageing);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(kinds_.size()));
  for (const Run& run : runs_) {
    add_forces(run, unit, unknowns, out);
    if (run.has_pressure && run.has_flow) add_flows(run, unit, unknowns, out);
  }
  std::size_t closed = 0, resistance = 0;
  for (Eigen::Index row = 0; row < out.size(); ++row) {
    const auto k = static_cast<std::size_t>(row);
    if (kinds_[k] == EvidenceOf::closed_reading)
      out(row) = closed_readings_m_[closed++] - unknowns.deviations[at(Variation::position_zero)];
    if (kinds_[k] == EvidenceOf::resistance)
      out(row) = resistances_Ohm_[resistance++] - unit.actuator.coil_resistance.resistance_Ohm;
    out(row) /= counts_[k] * deviations_[k];
  }
  return out;
}

std::string why_it_shows_nothing(const UnitRun& run, const model::Model& type) {
  const recording::Recording& recording = *run.recording;
  const auto span_of = [&](Channel channel) {
    std::pair span{INFINITY, -INFINITY};
    for (const double value : recording[channel]) span = {std::fmin(span.first, value), std::fmax(span.second, value)};
    return span;
  };
  std::string why;
  for (const Channel channel : {Channel::position, Channel::current, Channel::pressure_difference}) {
    if (recording.has(channel) && span_of(channel).second == -INFINITY)
      why = fmt::format("channel {} has no values", recording::name(channel));
  }
  if (why.empty()) {
    const auto [lowest_m, highest_m] = span_of(Channel::position);
    why = fmt::format(
        "the spool nowhere moves slowly and without dither within the stroke of 0 to {:.2f} mm, under {:.0f} bar at "
        "most; position is {:.2f} to {:.2f} mm",
        1e3 * type.valve.stroke_m, 1e-5 * type.observer->parameters.edge.highest_pressure_difference_Pa(),
        1e3 * lowest_m + 0.0, 1e3 * highest_m + 0.0);  // no -0
  }
  return fmt::format("{} shows no forces and no flow of the unit: {}; record it again, or take it out",
                     recording.file.filename().string(), why);
}

}  // namespace spoolflow::calibration
