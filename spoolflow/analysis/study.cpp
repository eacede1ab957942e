#include "spoolflow/analysis/study.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "spoolflow/analysis/study_ledger.hpp"
#include "spoolflow/analysis/virtual_unit.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/simulate.hpp"
#include "spoolflow/rig/plants/plant_group.hpp"
#include "spoolflow/units/conversion.hpp"
#include "spoolflow/validation/metrics.hpp"

namespace spoolflow::analysis {
namespace {

using estimation::Estimator;

/// The preset whose rated flow is nearest to the model's.
std::string nearest_preset(const model::Model& model) {
  std::string nearest;
  double least = INFINITY;
  for (const std::string& preset : rig::valve_presets()) {
    const rig::ValveUnderTest valve = rig::read_valve_and_campaign(preset).valve;
    if (valve.whole) continue;  // a study is of one direction
    const double rated_L_min = valve.rating.flow_L_per_min;
    const double distance =
        std::abs(std::log(rated_L_min / units::L_per_min_from_m3_per_s(model.valve.rated_flow_m3_per_s)));
    if (distance < least) {
      least = distance;
      nearest = preset;
    }
  }
  return nearest;
}

std::string text_of(const model::Model& model) {
  std::ostringstream out;
  model::write_model(out, model);
  return std::move(out).str();
}

/// Everything that the results follow from, as text.
std::string everything(const model::Model& given, const Scenario& scenario, const rig::ValveUnderTest& valve,
                       const std::string& identity) {
  std::ostringstream out;
  out << identity << ' ' << scenario.seed << ' ' << scenario.study.given_model << '\n';
  out << exact_text(scenario.study) << exact_text(valve.plant) << exact_text(valve.electronics)
      << exact_text(valve.instruments);
  if (scenario.study.given_model) model::write_model(out, given);
  return out.str();
}

/// A random duty cycle over the valve's rating, the same for every valve of the series.
rig::BenchRun duty_cycle(const rig::ValveUnderTest& valve, double oil_temperature_C, const Scenario& scenario) {
  rig::DutyCycleProtocol protocol;
  protocol.conditions.oil_temperature_start_C = oil_temperature_C;
  protocol.conditions.oil_temperature_end_C = oil_temperature_C;
  protocol.duration_s = scenario.study.run_s;
  protocol.highest_pressure_bar = valve.rating.pressure_difference_bar;
  protocol.lowest_pressure_bar = std::min(protocol.lowest_pressure_bar, 0.2 * protocol.highest_pressure_bar);
  protocol.longest_hold_s = 0.6;  // a short run is to hold many motions
  protocol.longest_pressure_hold_s = 2;
  return rig::plan(protocol, scenario.seed);
}

std::vector<unsigned> numbers_per_factor() {
  std::vector<unsigned> out;
  for (const Factor& factor : valve_factors()) out.push_back(factor.numbers);
  return out;
}

/// The sensor over one simulated run, against the true flow of the plant.
RunErrors run_errors(const model::Model& model, const rig::Simulation& run) {
  const std::vector<double>& flow_L_min = run.truth["flow_L_min"];
  const estimation::Columns columns = estimation::sensor_columns(run.recording);
  constexpr double finding_s = 0.5;  // until then nothing moves and nothing is known
  RunErrors out{};
  std::size_t k = 0;
  for (const Estimator estimator : {Estimator::condensed, Estimator::observer}) {
    estimation::RunningSensor sensor = estimation::running_sensor(model, estimator);
    std::vector<float> errors;
    estimation::run(sensor, columns, [&](std::size_t s, const sensor::Estimate<double>& estimate) {
      if (columns.time_s[s] < finding_s) return;
      const double error_m3_per_s = estimate.flow_m3_per_s - units::m3_per_s_from_L_per_min(flow_L_min[s]);
      errors.push_back(static_cast<float>(error_m3_per_s / model.valve.rated_flow_m3_per_s));
    });
    const validation::ErrorFigures figures = validation::error_figures(std::move(errors));
    out[k++] = figures.p95;
    out[k++] = figures.rms;
  }
  return out;
}

}  // namespace

const std::array<StudyOutput, study_outputs>& study_output_list() {
  static constexpr std::array<StudyOutput, study_outputs> all{{{Estimator::condensed, true},
                                                               {Estimator::condensed, false},
                                                               {Estimator::observer, true},
                                                               {Estimator::observer, false}}};
  return all;
}

rig::ValveAndCampaign study_valve(const model::Model& given, const Scenario& scenario) {
  if (scenario.study.given_model && !given.observer) {
    throw model::ModelError(
        fmt::format("the model of {} is not calibrated for the observer, which the global study runs; "
                    "set study.given_model = false or study.skip = true in the scenario",
                    given.valve.name));
  }
  rig::ValveAndCampaign asked =
      rig::read_valve_and_campaign(scenario.study.valve == "auto" ? nearest_preset(given) : scenario.study.valve);
  if (asked.valve.whole) {  // a study is of one direction, P to B
    asked.valve.whole = false;
    asked.valve.plant.load.kind = rig::LoadKind::held_difference;
  }
  return asked;
}

StudyRuns::StudyRuns(const model::Model& given, const Scenario& scenario, const rig::ValveAndCampaign& asked,
                     const std::string& identity)
    : scenario_(scenario),
      nominal_(rig::as_built(asked.valve)),
      design_(numbers_per_factor(), static_cast<std::uint32_t>(scenario.study.base_samples), scenario.seed),
      fingerprint_(fingerprint_of(everything(given, scenario, nominal_, identity))) {}

std::vector<RunErrors> StudyRuns::run(const model::Model& model, std::span<const std::size_t> numbers) const {
  std::vector<rig::ValveUnderTest> valves;
  std::vector<rig::BenchRun> runs;
  for (const std::size_t number : numbers) {
    const DrawnValve drawn = drawn_valve(nominal_, scenario_.study.spread, design_.point(number));
    valves.push_back(drawn.valve);
    runs.push_back(duty_cycle(drawn.valve, drawn.oil_temperature_C, scenario_));
  }
  const std::vector<std::uint64_t> seeds(numbers.size(), scenario_.seed);
  std::vector<RunErrors> out;
  for (const rig::Simulation& run : rig::simulate_together(valves, runs, seeds, {.with_truth = true})) {
    out.push_back(run_errors(model, run));
  }
  return out;
}

std::size_t StudyRuns::runs_at_once(std::size_t runs, unsigned workers) const {
  constexpr double most_kept_s = 600;  // of recordings and truths in memory
  const auto kept = static_cast<std::size_t>(most_kept_s / scenario_.study.run_s);
  const std::size_t wanted = std::min(rig::plants_at_once(), kept);
  return std::clamp<std::size_t>(runs / std::max(1U, workers), 1, std::max<std::size_t>(1, wanted));
}

Study global_study(const model::Model& given, const Scenario& scenario, const rig::ValveAndCampaign& asked,
                   const StudyWork& work) {
  const StudyRuns study(given, scenario, asked, work.identity);
  const SaltelliDesign& design = study.design();
  FinishedRuns runs = finished_runs(work.saved, study.fingerprint(), design.points());

  constexpr double calibrating_share = 0.2;
  const bool own_model = !scenario.study.given_model;
  // As its file would hold it: the same wherever the runs are done.
  const std::string text =
      own_model ? text_of(virtual_model(
                      asked, work.workers,
                      [&](double share) { work.progress("calibrating the virtual valve", calibrating_share * share); }))
                : std::string();
  const model::Model model = own_model ? model::parse_model(text, "the virtual valve's model") : given;
  const double before = own_model ? calibrating_share : 0;
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!runs[k]) open.push_back(k);
  }
  Ledger ledger(
      open.size(), {work.saving_interval_s, work.save}, [&] { return study_state(study.fingerprint(), runs); },
      [&](double share) { work.progress("simulating the series", before + (1 - before) * share); });
  const auto keep = [&](std::size_t k, const RunErrors& errors) { ledger.finished([&] { runs[k] = errors; }); };
  if (work.elsewhere) {
    work.elsewhere(study, text, open, keep);
  } else {
    const std::size_t at_once = study.runs_at_once(open.size(), work.workers);
    parallel::for_each((open.size() + at_once - 1) / at_once, work.workers, [&](std::size_t piece) {
      const std::size_t first = piece * at_once;
      const auto numbers = std::span(open).subspan(first, std::min(at_once, open.size() - first));
      const std::vector<RunErrors> errors = study.run(model, numbers);
      for (std::size_t k = 0; k < numbers.size(); ++k) keep(numbers[k], errors[k]);
    });
  }

  Study out{study.nominal().name, scenario.study.given_model, static_cast<std::uint32_t>(scenario.study.base_samples),
            design.points(),      scenario.study.run_s,       {}};
  for (std::size_t o = 0; o < study_outputs; ++o) {
    std::vector<double> outputs;
    for (const auto& run : runs) outputs.push_back((*run)[o]);
    out.indices[o] = sobol_indices(design, outputs, scenario.seed);
  }
  return out;
}

}  // namespace spoolflow::analysis
