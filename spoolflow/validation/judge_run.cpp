#include "spoolflow/validation/judge_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "spoolflow/units/conversion.hpp"
#include "spoolflow/validation/phases.hpp"

namespace spoolflow::validation {
namespace {

constexpr std::size_t drawn_stretches = 1200;
constexpr std::size_t status_stretches = 500;
constexpr double worst_window_s = 1.5;      // before and after
constexpr double signed_flow_share = 0.02;  // of full scale: that the meter's noise and lag do not turn round
constexpr double no_flow_share = 0.01;      // of full scale: noise of the meter, which has no direction

template <class Number>
std::optional<Extent> extent_of(const std::vector<Number>& values) {
  std::optional<Extent> out;
  for (const Number value : values) {
    if (std::isnan(value)) continue;
    if (!out) out = Extent{value, value};
    out->lowest = std::min<double>(out->lowest, value);
    out->highest = std::max<double>(out->highest, value);
  }
  return out;
}

/// The pairs of position and another quantity that occur, to the given steps.
template <class Point>
std::vector<Point> used_points(const std::vector<double>& position_m, const std::vector<float>& other,
                               const Point& steps) {
  if (other.empty()) return {};
  const auto& [position_step_m, other_step] = steps;
  std::set<std::pair<int, int>> cells;
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    if (std::isnan(position_m[k]) || std::isnan(other[k])) continue;
    cells.emplace(static_cast<int>(std::lround(position_m[k] / position_step_m)),
                  static_cast<int>(std::lround(other[k] / other_step)));
  }
  std::vector<Point> out;
  for (const auto& [x, y] : cells) out.push_back({x * position_step_m, y * other_step});
  return out;
}

/// Part of a column around the worst moment.
template <class Number>
std::span<const Number> part(const std::vector<Number>& column, std::size_t begin, std::size_t end) {
  return std::span(column).subspan(begin, end - begin);
}

WorstMoment worst_moment(const RunSamples& run, const Phases& phases, const Answers& answers, std::size_t at) {
  const double when_s = run.time_s[at];
  const auto index = [&](double time_s) {
    return static_cast<std::size_t>(std::lower_bound(run.time_s.begin(), run.time_s.end(), time_s) -
                                    run.time_s.begin());
  };
  const std::size_t begin = index(when_s - worst_window_s);
  const std::size_t end = std::max(at + 1, index(when_s + worst_window_s));
  const std::span<const double> time_s = part(run.time_s, begin, end);
  WorstMoment out{.time_s = when_s,
                  .error_m3_per_s = answers.flow_m3_per_s[at] - run.reference_m3_per_s[at],
                  .position_m = run.position_m[at],
                  .pressure_difference_Pa = {},
                  .moving = phases.moving[at],
                  .rest = phases.rest[at],
                  .velocity_m_per_s = phases.velocity_m_per_s[at],
                  .status = {},
                  .reference_m3_per_s = thinned(time_s, part(run.reference_m3_per_s, begin, end), drawn_stretches / 2),
                  .band_m3_per_s = thinned_band(time_s, part(answers.lower_m3_per_s, begin, end),
                                                part(answers.upper_m3_per_s, begin, end), drawn_stretches / 2),
                  .flow_m3_per_s = {}};
  if (!run.pressure_difference_Pa.empty()) out.pressure_difference_Pa = run.pressure_difference_Pa[at];
  for (const sensor::StatusName& entry : sensor::status_names) {
    if (sensor::has(answers.status[at], entry.bit)) out.status.emplace_back(entry.name);
  }
  for (const Answers& each : run.answers) {
    out.flow_m3_per_s.push_back(thinned(time_s, part(each.flow_m3_per_s, begin, end), drawn_stretches / 2));
  }
  return out;
}

void draw(EstimatorResult& out, const RunSamples& run, const Answers& answers) {
  const auto line = [&](const std::vector<float>& column) { return thinned(run.time_s, column, drawn_stretches); };
  out.flow_m3_per_s = line(answers.flow_m3_per_s);
  out.band_m3_per_s = thinned_band(run.time_s, answers.lower_m3_per_s, answers.upper_m3_per_s, drawn_stretches);
  out.pressure_difference_Pa = line(answers.pressure_difference_Pa);
  out.magnetic_force_N = line(answers.magnetic_force_N);
  out.spring_force_N = line(answers.spring_force_N);
  out.flow_force_N = line(answers.flow_force_N);
  out.friction_force_N = line(answers.friction_force_N);
  out.status = status_rows(run.time_s, answers.status, status_stretches);
  const auto faulty = std::ranges::count_if(answers.status, [](sensor::Status status) {
    return (static_cast<std::uint32_t>(status) & sensor::fault_bits) != 0;
  });
  if (!answers.status.empty()) {
    out.fault_share = static_cast<double>(faulty) / static_cast<double>(answers.status.size());
  }
}

/// `least_m3_per_s`: of flow that has a direction.
void judge_sign(SignFigures& sign, double flow_m3_per_s, double reference_m3_per_s, double least_m3_per_s,
                sensor::Status status) {
  ++sign.samples;
  if (sensor::has(status, sensor::Status::sign_undetermined)) {
    ++sign.undetermined;
    sign.undetermined_largest_m3_per_s = std::max(sign.undetermined_largest_m3_per_s, std::abs(reference_m3_per_s));
  } else if (std::abs(reference_m3_per_s) > least_m3_per_s && flow_m3_per_s * reference_m3_per_s < 0) {
    ++sign.wrong;
  }
}

/// Figures, profiles and the worst moment of one estimator.
ComparedSamples compare(EstimatorResult& out, const RunSamples& run, const Phases& phases, const Answers& answers,
                        const model::Valve& valve) {
  ComparedSamples compared(valve.rated_flow_m3_per_s);
  std::vector<float> errors;
  out.profiles = empty_profiles(valve);
  out.direction = empty_direction(valve);
  const bool whole = valve.direction == "both";
  const double least_m3_per_s = no_flow_share * valve.rated_flow_m3_per_s;
  if (whole) out.sign.emplace();
  std::size_t worst = run.time_s.size();
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < run.time_s.size(); ++k) {
    const double reference = run.reference_m3_per_s[k];
    const double error = answers.flow_m3_per_s[k] - reference;
    errors.push_back(static_cast<float>(error));
    if (std::isnan(error)) continue;
    compared.add({answers.flow_m3_per_s[k], answers.lower_m3_per_s[k], answers.upper_m3_per_s[k], reference,
                  phases.moving[k], phases.rest[k], phases.reversal[k], whole && reference > least_m3_per_s,
                  whole && reference < -least_m3_per_s});
    if (whole)
      judge_sign(*out.sign, answers.flow_m3_per_s[k], reference, signed_flow_share * valve.rated_flow_m3_per_s,
                 answers.status[k]);
    if (worst == run.time_s.size() || std::abs(errors[k]) > std::abs(errors[worst])) worst = k;
    const std::array values{
        std::abs(reference) < least_m3_per_s ? 0.0 : reference, run.position_m[k],
        run.pressure_difference_Pa.empty() ? nothing : static_cast<double>(run.pressure_difference_Pa[k]),
        run.oil_temperature_K.empty() ? nothing : static_cast<double>(run.oil_temperature_K[k])};
    const bool inside = answers.lower_m3_per_s[k] <= reference && reference <= answers.upper_m3_per_s[k];
    for (std::size_t q = 0; q < values.size(); ++q) out.profiles[q].add(values[q], error, inside);
    const Direction direction =
        !phases.moving[k] ? Direction::rest : (phases.opening[k] ? Direction::opening : Direction::closing);
    if (phases.moving[k] || phases.rest[k]) out.direction->add(direction, run.position_m[k], error);
  }
  if (compared.size() == 0) return compared;
  out.metrics = compared.metrics();
  out.error_m3_per_s = thinned(run.time_s, errors, drawn_stretches);
  out.worst = worst_moment(run, phases, answers, worst);
  return compared;
}

}  // namespace

std::vector<ErrorProfile> empty_profiles(const model::Valve& valve) {
  const double full_scale = valve.rated_flow_m3_per_s;
  return {ErrorProfile(full_scale / 16, full_scale), ErrorProfile(valve.stroke_m / 16, full_scale),
          ErrorProfile(5e5, full_scale), ErrorProfile(2.5, full_scale, units::kelvin_at_0_degC)};
}

DirectionProfile empty_direction(const model::Valve& valve) {
  return DirectionProfile({valve.stroke_m, valve.rated_flow_m3_per_s, valve.direction == "both"});
}

JudgedRun judge_run(const model::Valve& valve, RunSamples& run, const KnownMeter& meter,
                    const ValidationOptions& options, std::size_t traced_values) {
  JudgedRun out;
  RunResult& result = out.result;
  result.samples = run.time_s.size();
  result.duplicate_times = run.notes.duplicate_times;
  result.missing_values = run.notes.missing_values();
  result.resampled = run.notes.resampled;
  result.duration_s = run.time_s.empty() ? 0 : run.time_s.back() - run.time_s.front();
  result.has_reference = !run.reference_m3_per_s.empty();
  result.current_A = extent_of(run.current_A);
  result.position_m = extent_of(run.position_m);
  result.oil_temperature_K = extent_of(run.oil_temperature_K);
  result.pressure_difference_Pa = extent_of(run.pressure_difference_Pa);
  result.reference_m3_per_s = extent_of(run.reference_m3_per_s);
  result.operating_points =
      used_points(run.position_m, run.pressure_difference_Pa, OperatingPoint{0.01 * valve.stroke_m, 1e5});
  result.flow_points = used_points(
      run.position_m, run.reference_m3_per_s.empty() ? run.answers.back().flow_m3_per_s : run.reference_m3_per_s,
      FlowPoint{0.01 * valve.stroke_m, 0.01 * valve.rated_flow_m3_per_s});
  result.solenoid_points = used_points(run.position_m, run.current_A, SolenoidPoint{0.01 * valve.stroke_m, 0.02});
  const std::vector<float> position_m(run.position_m.begin(), run.position_m.end());
  result.position_line_m = thinned(run.time_s, position_m, drawn_stretches);
  if (result.has_reference) {
    result.reference_line_m3_per_s = thinned(run.time_s, run.reference_m3_per_s, drawn_stretches);
  }
  if (!run.pressure_difference_Pa.empty()) {
    result.pressure_difference_line_Pa = thinned(run.time_s, run.pressure_difference_Pa, drawn_stretches);
  }
  const Phases phases = phases_of_position(run.time_s, run.position_m, valve.stroke_m);
  if (result.has_reference) result.reference_meter = meter;
  if (result.has_reference && options.apply_reference_lag) {
    for (Answers& answers : run.answers) apply_lag(run.time_s, answers, meter.meter);
  }
  if (result.has_reference) {
    result.reference_scale =
        reference_scale(run.answers.back().flow_m3_per_s, run.reference_m3_per_s, valve.rated_flow_m3_per_s);
  }
  for (const Answers& answers : run.answers) {
    EstimatorResult& each = result.results.emplace_back();
    each.estimator = answers.estimator;
    if (result.has_reference) {
      out.compared.push_back(compare(each, run, phases, answers, valve));
      each.frequency_response = frequency_response({run.time_s, run.reference_m3_per_s, answers.flow_m3_per_s,
                                                    options.apply_reference_lag ? 0 : meter.meter.lag_s});
    }
    draw(each, run, answers);
  }
  result.step_response = step_response(run, valve.rated_flow_m3_per_s);
  result.trace = run_trace(run, traced_values);
  return out;
}

}  // namespace spoolflow::validation
