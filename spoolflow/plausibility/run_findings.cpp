#include "spoolflow/plausibility/run_findings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "spoolflow/plausibility/bench_relations.hpp"
#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/coil_currents.hpp"
#include "spoolflow/plausibility/frozen_channel.hpp"
#include "spoolflow/plausibility/motion_delay.hpp"
#include "spoolflow/plausibility/oil_temperature.hpp"
#include "spoolflow/plausibility/recording_error.hpp"
#include "spoolflow/plausibility/reference_shift.hpp"
#include "spoolflow/plausibility/run_relations.hpp"
#include "spoolflow/plausibility/signals/clock_rate.hpp"
#include "spoolflow/plausibility/signals/coil_signals.hpp"
#include "spoolflow/plausibility/steady_lines.hpp"
#include "spoolflow/plausibility/zero_findings.hpp"
#include "spoolflow/recording/coil_channels.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

/// A run beside the valve that it should be of.
class RunTrial {
 public:
  RunTrial(const std::vector<KnownValve>& valve, Recording means)
      : run(std::move(means)),
        valve_(valve),
        both_(valve.size() > 1 && (recording::has_both_coils(run) || run.has(Channel::current))) {
    if (!both_) keep_known_side(run, stroke_m());
  }

  [[nodiscard]] std::vector<Deviation> deviations() const {
    std::vector<Deviation> out;
    if (!both_) {
      add_run_deviations(out, bounded(valve_.front()), valve_.front().magnetics, run);
      const Recording slow = longer_blocks(run);
      add_resistance_deviation(out, {&slow}, valve_.front().coil.resistance_Ohm);
      return out;
    }
    for (const int side : {1, -1}) {
      const KnownValve& known = valve_[side > 0 ? 0 : 1];
      const Recording part = one_side(run, side);
      if (part.size() < 2) continue;
      std::vector<Deviation> found;
      const Recording slow = longer_blocks(part);
      add_resistance_deviation(found, {&slow}, known.coil.resistance_Ohm);
      add_run_deviations(found, bounded(known), known.magnetics, part);
      std::erase_if(found, [](const Deviation& deviation) { return deviation.of == "travel"; });
      for (Deviation& deviation : found) {
        if (deviation.of.ends_with(',')) deviation.of.pop_back();
        deviation.of += side > 0 ? ", P to B," : ", P to A,";
        out.push_back(std::move(deviation));
      }
    }
    return out;
  }
  /// What the position makes of the pressure difference, > 0 from P to B of a whole valve.
  [[nodiscard]] std::vector<double> expected_flow() const {
    std::vector<double> out = plausibility::expected_flow(valve_.front().hydraulics, run);
    if (!both_) return out;
    Recording mirrored_run{run.file, {}};
    for (const Channel channel : {Channel::time, Channel::position, Channel::pressure_difference})
      mirrored_run.column(channel) = run.column(channel);
    for (double& position_m : mirrored_run.column(Channel::position)) position_m *= -1;
    const std::vector<double> of_a = plausibility::expected_flow(valve_.back().hydraulics, mirrored_run);
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (mirrored_run.column(Channel::position)[k] > 0) out[k] = -of_a[k];
    }
    return out;
  }
  [[nodiscard]] double stroke_m() const { return valve_.front().hydraulics.stroke_m; }
  [[nodiscard]] bool both() const { return both_; }
  /// Those between which the run goes: the first one alone, or both.
  [[nodiscard]] std::span<const KnownValve> directions() const { return std::span(valve_).first(both_ ? 2 : 1); }

  Recording run;
  double pressure_factor = 1;  ///< by which the machine's highest pressure difference is beyond what is known

 private:
  [[nodiscard]] HydraulicCurves bounded(const KnownValve& valve) const {
    HydraulicCurves out = valve.hydraulics;
    out.bounding_pressure_Pa = pressure_factor * out.highest_bound_Pa();
    return out;
  }
  const std::vector<KnownValve>& valve_;
  bool both_;
};

struct RunExplanation {
  std::string text;  ///< "position looks reversed: with …"
  bool of_position;  ///< the error is the position's
  double badness;
  std::vector<Deviation> deviations;
};

bool wholly(const RunExplanation& explanation) {
  return std::ranges::max(explanation.deviations, {}, &Deviation::over_limit).over_limit <= 1;
}

void keep_better(std::optional<RunExplanation>& best, const RunTrial& trial, const std::vector<Deviation>& before,
                 std::string text, bool of_position = false) {
  std::vector<Deviation> deviations = trial.deviations();
  if (!judges_as_much(deviations, before)) return;
  const double left = badness(deviations);
  if (!best || left < best->badness) best = RunExplanation{std::move(text), of_position, left, std::move(deviations)};
}

/// As the recording calls it, whose reference the relations take for the flow.
std::string_view shown_name(Channel channel) {
  return recording::name(channel == Channel::flow ? Channel::flow_reference : channel);
}

/// Two columns in each other's place. What stood in the second one's unit is read in the first one's.
struct Swap {
  Channel one, other;
  double one_per_other = 1;  ///< SI of the first for the number that the second had, over SI of the second
};

void try_swaps(RunTrial& trial, const std::vector<Deviation>& before, std::optional<RunExplanation>& best) {
  const double flow_per_pressure = units::m3_per_s_from_L_per_min(1) / units::Pa_from_bar(1);
  const std::array<Swap, 6> swaps{{{Channel::current, Channel::voltage},
                                   {Channel::current_a, Channel::current_b},
                                   {Channel::voltage_a, Channel::voltage_b},
                                   {Channel::position, Channel::current, units::m_from_mm(1)},
                                   {Channel::flow, Channel::pressure_difference},
                                   {Channel::flow, Channel::pressure_difference, flow_per_pressure}}};
  for (const Swap& swap : swaps) {
    if (!trial.run.has(swap.one) || !trial.run.has(swap.other)) continue;
    std::vector<double>& one = trial.run.column(swap.one);
    std::vector<double>& other = trial.run.column(swap.other);
    const std::vector<double> kept_one = one, kept_other = other;
    std::swap(one, other);
    for (double& value : one) value *= swap.one_per_other;
    for (double& value : other) value /= swap.one_per_other;
    keep_better(
        best, trial, before,
        fmt::format("{} and {} look swapped: with each as the other", shown_name(swap.one), shown_name(swap.other)),
        swap.one == Channel::position);
    one = kept_one;
    other = kept_other;
  }
  if (!trial.run.has(Channel::current_a) || !trial.run.has(Channel::voltage_a) || !trial.run.has(Channel::voltage_b))
    return;
  const auto exchange = [&] {
    std::swap(trial.run.column(Channel::current_a), trial.run.column(Channel::current_b));
    std::swap(trial.run.column(Channel::voltage_a), trial.run.column(Channel::voltage_b));
  };
  exchange();
  keep_better(best, trial, before, "solenoids a and b look swapped: with current and voltage of each as the other's");
  exchange();
}

/// A solenoid's current has one direction, which is > 0.
bool has_its_sign(Channel channel, const std::vector<double>& values) {
  if (channel != Channel::current && channel != Channel::current_a && channel != Channel::current_b) return false;
  double sum = 0;
  for (const double value : values) sum += std::isfinite(value) ? value : 0;
  return sum > 0;
}

std::optional<RunExplanation> best_explanation(RunTrial& trial, const std::vector<Deviation>& before) {
  std::optional<RunExplanation> best;
  for (const Channel channel :
       {Channel::position, Channel::current, Channel::current_b, Channel::current_a, Channel::voltage,
        Channel::voltage_b, Channel::voltage_a, Channel::flow, Channel::pressure_difference}) {
    if (!trial.run.has(channel)) continue;
    const std::vector<double> kept = trial.run.column(channel);
    const std::string_view name = shown_name(channel);
    for (const RecordingError& error : usual_recording_errors(channel)) {
      if (error.from_other_end && trial.both()) continue;
      if (error.factor < 0 && has_its_sign(channel, kept)) continue;
      for (double& value : trial.run.column(channel)) value = error.undone(value, trial.stroke_m());
      keep_better(best, trial, before, fmt::format("{} looks {}: with {}", name, error.looks, error.undo),
                  channel == Channel::position);
      trial.run.column(channel) = kept;
    }
  }
  try_swaps(trial, before, best);
  if (best && wholly(*best)) return best;
  // A reference that is off by no number of a usual recording error.
  for (const Deviation& deviation : before) {
    if (!deviation.of.starts_with(reference_ratio) || !(deviation.ratio > 0)) continue;
    const std::vector<double> kept = trial.run.column(Channel::flow);
    for (double& value : trial.run.column(Channel::flow)) value /= deviation.ratio;
    keep_better(best, trial, before,
                fmt::format("flow_reference reads {:.3g} times what this model's valve passes: with it divided by that",
                            deviation.ratio));
    trial.run.column(Channel::flow) = kept;
  }
  return best;
}

/// What the relations of a run say against it.
struct ErrorFinding {
  bool cannot_be;
  bool explained;    ///< as a channel's error, which all else that this channel shows has, too
  bool of_position;  ///< that of the position
  std::string text;
};

/// The lowest pressure difference with which nothing speaks against the run, if no more than 2.5 times what is known.
std::optional<double> explaining_pressure_Pa(RunTrial& trial) {
  std::optional<double> found;
  for (const double factor : {1.25, 1.5, 1.75, 2.0, 2.25, 2.5}) {
    trial.pressure_factor = factor;
    if (std::ranges::max(trial.deviations(), {}, &Deviation::over_limit).over_limit > 1) continue;
    found = factor * trial.directions().front().hydraulics.highest_bound_Pa();
    break;
  }
  trial.pressure_factor = 1;
  return found;
}

std::optional<ErrorFinding> error_finding(RunTrial& trial) {
  const std::vector<Deviation> now = trial.deviations();
  const auto worst = std::ranges::max_element(now, {}, &Deviation::over_limit);
  if (worst == now.end() || !(worst->over_limit > 1)) return std::nullopt;
  const std::optional<RunExplanation> found = best_explanation(trial, now);
  constexpr double left_share = 0.35;
  const bool all = found && wholly(*found);
  const bool explains =
      all || (found && found->badness < left_share * badness(now) && over_limit_of(found->deviations, *worst) <= 1);
  if (worst->of.starts_with(largest_opening) && !all) return std::nullopt;
  const bool cannot_be = worst->over_limit > surely;
  const std::string error =
      explains ? fmt::format("{}, {}", found->text, text(deciding_change(now, found->deviations))) : "";
  if (const std::optional<double> pressure_Pa = explaining_pressure_Pa(trial)) {
    const double known_Pa = trial.directions().front().hydraulics.highest_bound_Pa();
    return ErrorFinding{
        false, true, explains && found->of_position,
        fmt::format("forces ask for pressure differences of {:.0f} bar at least, and {:.0f} bar are "
                    "calibrated or declared: declare [environment] highest_pressure_bar{}{}",
                    units::bar_from_Pa(*pressure_Pa), units::bar_from_Pa(known_Pa), explains ? "; or " : "", error)};
  }
  if (explains) return ErrorFinding{cannot_be, true, found->of_position, error};
  return ErrorFinding{
      cannot_be, false, false,
      fmt::format("{} is {}, which no usual recording error of one channel explains: is the model of this valve, and "
                  "is every channel in its unit?",
                  worst->of, worst->shown)};
}

/// What the channels say against themselves, whatever the valve's forces. Resampled ones say nothing of the coil.
std::vector<Finding> signal_findings(const Recording& means, const RunMeans& run, const model::Range& calibrated_K,
                                     bool is_resampled) {
  std::vector<Finding> out;
  const auto add = [&](bool cannot_be, const std::string& text) {
    if (!text.empty()) out.push_back({cannot_be, text});
  };
  add(false, frozen_oil_temperature_alone(means));
  add(false, temperature_in_another_unit(means, calibrated_K, "the model's valve was calibrated at"));
  add(false, leaping_temperature(means));
  for (const std::string& clipped : run.clipped().findings()) add(true, clipped);
  if (!is_resampled) {
    for (const std::string& leap : resistance_leaps(means)) add(true, leap);
    for (const std::string& zero : currents_without_voltage(means)) add(false, zero);
    add(false, run.sample_grid().coarse_current());
  }
  if (const auto late_s = motion_delay_s(run.motion())) add(true, shown_delay(*late_s));
  return out;
}

}  // namespace

std::vector<Finding> run_findings(const std::vector<KnownValve>& valve, const RunMeans& run,
                                  const std::filesystem::path& file) {
  const std::string name = file == "-" ? "standard input" : file.filename().string();
  std::vector<Finding> out;
  if (run.gaps().count > 0) {
    out.push_back({false, fmt::format("{}: {} gap{} without samples, the longest {:.3g} s from {:.3f} s on: the answer "
                                      "is held there, and the sensor is reset behind it",
                                      name, run.gaps().count, run.gaps().count == 1 ? "" : "s", run.gaps().longest_s,
                                      run.gaps().longest_from_s)});
  }
  RunTrial trial(valve, run.means(file));
  for (const std::string& dead :
       {standing_channel(trial.run, trial.stroke_m()), signed_coil_currents(trial.run), frozen_channel(trial.run)}) {
    if (dead.empty()) continue;
    out.push_back({true, fmt::format("{}: {}", name, dead)});
    return out;
  }
  const auto add = [&](bool cannot_be, const std::string& text) {
    if (!text.empty()) out.push_back({cannot_be, fmt::format("{}: {}", name, text)});
  };
  if (const std::vector<std::string> markers = run.clipped().missing_markers(); !markers.empty()) {
    for (const std::string& marker : markers) add(true, marker);
    return out;  // its means hold them
  }
  if (const std::string supply = supply_voltage(trial.run); !supply.empty()) {
    add(true, supply);
    for (const Channel voltage : {Channel::voltage, Channel::voltage_a, Channel::voltage_b})
      trial.run.column(voltage).clear();
  }
  const std::string resampled = run.sample_grid().resampled();
  for (const Finding& finding : signal_findings(trial.run, run, valve.front().oil_temperature_K, !resampled.empty()))
    add(finding.cannot_be, finding.text);
  add(false, resampled);
  std::vector<double>& reference = trial.run.column(Channel::flow);
  const std::vector<double>& time_s = trial.run.column(Channel::time);
  if (const auto shift = reference_shift(time_s, trial.expected_flow(), reference)) {
    add(true, shown(*shift));
    reference = values_later(time_s, reference, shift->late_s);
  }
  for (const Finding& finding : run_zero_findings(trial.run, trial.directions())) add(finding.cannot_be, finding.text);
  if (const auto zero = meter_zero_finding(trial.run, trial.directions())) add(zero->cannot_be, zero->text);
  if (!resampled.empty()) return out;  // neither lines nor forces are the valve's
  const std::optional<ErrorFinding> error = error_finding(trial);
  const std::string coarse = coarse_position(run.position_resolution(), valve.front().position_noise_m);
  if (!(error && error->of_position)) add(false, coarse);
  add(false, noisy_current(run.steady_lines()));
  add(false, low_pass_finding(run.steady_lines(), valve.front().position_noise_m));
  const SteadyValve known{valve.front().position_noise_m,
                          {valve.front().coil.resistance_Ohm, valve.back().coil.resistance_Ohm}};
  if (!(error && error->explained && error->cannot_be)) {
    for (const std::string& line : steady_line_findings(run.steady_lines(), known)) add(false, line);
  }
  if (error) add(error->cannot_be, error->text);
  if (!trial.both()) add(false, undeclared_open_stop(valve.front(), trial.run));
  // A wrong current, voltage or position looks like both: they are asked for where nothing else speaks against the run.
  if (!out.empty()) return out;
  add(false, induced_delay(valve.front().coil, run, trial.stroke_m()));
  if (out.empty() && free_of_dither(run.steady_lines())) add(true, wrong_clock(trial.run, valve.front().coil));
  return out;
}

}  // namespace spoolflow::plausibility
