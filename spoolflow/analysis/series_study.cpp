#include "spoolflow/analysis/series_study.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

#include "spoolflow/analysis/study_ledger.hpp"
#include "spoolflow/calibration/type/plan_minute.hpp"
#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::analysis {
namespace {

/// Unit `k` of the study: its spread and its noise.
rig::ValveAndCampaign drawn_unit(rig::ValveAndCampaign unit, std::uint64_t seed, std::size_t k) {
  constexpr std::uint64_t most_units = 100000;
  rig::ValveUnderTest& valve = unit.valve;
  if (!(valve.spread.amount > 0)) valve.spread.amount = 1;
  valve.spread_seed = seed * most_units + k + 1;
  valve.seed = valve.spread_seed;
  valve.name += fmt::format(", spread seed {}", valve.spread_seed);
  return unit;
}

/// The planned strokes, as `plan --scenario` writes them.
rig::RampsProtocol minute_of(const calibration::PlannedMinute& planned) {
  rig::RampsProtocol out{.conditions = {},
                         .rate_percent_per_s = 100 * planned.rate_per_s,
                         .hold_s = calibration::planned_hold_s,
                         .pause_s = calibration::planned_pause_s};
  out.pressure_differences_bar.clear();
  for (const double pressure_Pa : planned.pressures_Pa)
    out.pressure_differences_bar.push_back(units::bar_from_Pa(pressure_Pa));
  return out;
}

std::array<rig::Protocol, series_runs> judging_runs(double highest_bar) {
  rig::RampsProtocol ramps{.conditions = {},
                           .pressure_differences_bar = {0.45 * highest_bar, 0.8 * highest_bar},
                           .rate_percent_per_s = 8,
                           .hold_s = 2};
  rig::DutyCycleProtocol duty;
  duty.duration_s = 40;
  duty.highest_pressure_bar = highest_bar;
  duty.lowest_pressure_bar = std::min(duty.lowest_pressure_bar, 0.2 * highest_bar);
  return {ramps, duty, duty};
}

void require_same_valve(const model::Model& type, const std::string& type_file, const rig::ValveUnderTest& valve) {
  const double rated_L_min = units::L_per_min_from_m3_per_s(type.valve.rated_flow_m3_per_s),
               stroke_mm = units::mm_from_m(type.valve.stroke_m),
               valve_mm = units::mm_from_m(valve.plant.spool.stroke_m);
  constexpr double alike = 1e-3;
  if (std::abs(rated_L_min / valve.rating.flow_L_per_min - 1) < alike && std::abs(stroke_mm / valve_mm - 1) < alike)
    return;
  throw model::ModelError(fmt::format(
      "{}: the type has a rated flow of {:g} L/min and a stroke of {:g} mm, the virtual valve {} has {:g} L/min and "
      "{:g} mm; name the type's valve by study.valve in a scenario",
      type_file, rated_L_min, stroke_mm, valve.name, valve.rating.flow_L_per_min, valve_mm));
}

/// All that a unit's result follows from, but for its number.
std::string everything(const SeriesPlan& plan, const rig::ValveAndCampaign& asked, const std::string& identity) {
  std::ostringstream out;
  const rig::ValveUnderTest& valve = asked.valve;
  out << identity << " units of a series " << plan.seed << ' ' << plan.type_file << ' ' << valve.name << '\n';
  out << exact_text(valve.plant) << exact_text(valve.electronics) << exact_text(valve.instruments);
  out << exact_text(valve.rating) << exact_text(valve.spread) << exact_text(valve.wear) << exact_text(asked.campaign);
  out << exact_text(valve.bench_amplifier) << static_cast<int>(asked.campaign.bench);
  model::write_model(out, plan.type);
  return out.str();
}

/// Figures exactly, then the refusals, one after a tab each.
std::string line_of(const SeriesStudyUnit& unit) {
  std::string out;
  for (const SeriesJudged& judged : unit.by) {
    for (const SeriesFigures& run : judged.runs)
      out += fmt::format("{:a} {:a} {:a} {:a} ", run.p95, run.largest, run.in_band, run.band_width);
  }
  for (const SeriesJudged& judged : unit.by) {
    std::string refusal = judged.refusal;
    std::ranges::replace_if(
        refusal, [](char letter) { return letter == '\n' || letter == '\t'; }, ' ');
    out += "\t" + refusal;
  }
  return out;
}

SeriesStudyUnit unit_from(const std::string& line, std::uint64_t spread_seed) {
  SeriesStudyUnit out{spread_seed, {}};
  std::istringstream in(line);
  std::string number;
  const auto next = [&](double& value) {
    in >> number;
    value = std::strtod(number.c_str(), nullptr);
  };
  for (SeriesJudged& judged : out.by) {
    for (SeriesFigures& run : judged.runs) {
      next(run.p95);
      next(run.largest);
      next(run.in_band);
      next(run.band_width);
    }
  }
  std::string before;
  std::getline(in, before, '\t');
  for (SeriesJudged& judged : out.by) std::getline(in, judged.refusal, '\t');
  return out;
}

}  // namespace

std::size_t SeriesStudy::refused(KnownBy by) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(units, [&](const SeriesStudyUnit& unit) { return !unit.judged(by).refusal.empty(); }));
}

SeriesQuantiles SeriesStudy::over_units(KnownBy by, std::size_t run, double SeriesFigures::*figure) const {
  std::vector<double> values;
  for (const SeriesStudyUnit& unit : units) {
    if (unit.judged(by).refusal.empty()) values.push_back(unit.judged(by).runs[run].*figure);
  }
  if (values.empty()) return {NAN, NAN, NAN};
  std::ranges::sort(values);
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
  };
  return {at(0.5), at(0.05), at(0.95)};
}

double SeriesStudy::holding(KnownBy by, std::size_t run) const {
  const auto holds = std::ranges::count_if(units, [&](const SeriesStudyUnit& unit) {
    return unit.judged(by).refusal.empty() && unit.judged(by).runs[run].in_band >= held_share;
  });
  return static_cast<double>(holds) / static_cast<double>(units.size() - refused(by));
}

SeriesStudy series_study(const model::Model& type, const std::string& type_file, const rig::ValveAndCampaign& asked,
                         std::size_t units, std::uint64_t seed, const StudyWork& work) {
  require_same_valve(type, type_file, asked.valve);
  work.progress("planning the minute", 0);
  const rig::RampsProtocol minute = minute_of(calibration::plan_minute(type, type_file, 60));
  const double highest_bar =
      std::min(asked.valve.rating.pressure_difference_bar,
               units::bar_from_Pa(type.observer->parameters.edge.highest_pressure_difference_Pa()));
  const SeriesPlan plan{type, type_file, minute, judging_runs(highest_bar), seed};
  const std::uint64_t fingerprint = fingerprint_of(everything(plan, asked, work.identity));
  FinishedLines lines = finished_lines(work.saved, fingerprint, units);
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < units; ++k) {
    if (!lines[k]) open.push_back(k);
  }
  constexpr double planning_share = 0.02;
  const auto report = [&](double share) {
    work.progress("units of the series", planning_share + (1 - planning_share) * share);
  };
  Ledger ledger(
      open.size(), {work.saving_interval_s, work.save}, [&] { return study_lines_state(fingerprint, lines); }, report);
  report(0);
  parallel::for_each(open.size(), work.workers, [&](std::size_t piece) {
    const std::size_t k = open[piece];
    std::string line = line_of(judged_unit(plan, drawn_unit(asked, seed, k)));
    ledger.finished([&] { lines[k] = std::move(line); });
  });
  SeriesStudy out{asked.valve.name, seed, 0, {}, {}};
  const rig::ValveUnderTest nominal = rig::as_built(asked.valve);
  out.minute_s = rig::plan(plan.minute, nominal, seed).duration_s();
  for (std::size_t run = 0; run < series_runs; ++run)
    out.run_s[run] = rig::plan(plan.judging[run], nominal, seed).duration_s();
  for (std::size_t k = 0; k < units; ++k)
    out.units.push_back(unit_from(*lines[k], drawn_unit(asked, seed, k).valve.spread_seed));
  return out;
}

}  // namespace spoolflow::analysis
