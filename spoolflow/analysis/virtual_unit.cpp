#include "spoolflow/analysis/virtual_unit.hpp"

#include <map>
#include <mutex>
#include <stdexcept>

#include "spoolflow/calibration/calibrate.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/type/calibrate_unit.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/rig/bench/campaign_loads.hpp"
#include "spoolflow/rig/bench/simulate.hpp"
#include "spoolflow/units/conversion.hpp"
#include "spoolflow/validation/metrics.hpp"

namespace spoolflow::analysis {

namespace {

using Recordings = std::map<std::string, recording::Recording>;  // by file name

/// Four of the levels, ends included: a study wants the model in seconds.
std::vector<double> four_of(const std::vector<double>& levels) {
  if (levels.size() <= 4) return levels;
  const std::size_t last = levels.size() - 1;
  return {levels[0], levels[last / 3], levels[2 * last / 3], levels[last]};
}

}  // namespace

model::Model virtual_model(const rig::ValveAndCampaign& asked, unsigned workers,
                           const std::function<void(double)>& progress) {
  rig::CampaignSettings campaign = asked.campaign;
  campaign.pressure_differences_bar = four_of(campaign.pressure_differences_bar);
  const std::vector<rig::CampaignItem> items = rig::calibration_items(asked.valve, campaign);
  Recordings recordings;
  std::mutex mutex;  // guards recordings
  constexpr double measuring_share = 0.7;
  rig::run_campaign(items, {.store =
                                [&](const rig::CampaignItem& item, const rig::BenchRun&, const rig::Simulation& run) {
                                  const std::lock_guard lock(mutex);
                                  recordings[item.file] = run.recording;
                                  recordings[item.file].file = item.file;  // for messages
                                },
                            .progress = [&](double share) { progress(measuring_share * share); },
                            .workers = workers});
  std::map<std::string, std::vector<const recording::Recording*>> by_protocol;
  for (const rig::CampaignItem& item : items) by_protocol[item.protocol].push_back(&recordings[item.file]);
  for (const char* protocol : {"spring", "solenoid_force_map", "axial_force_map"}) {
    if (by_protocol[protocol].empty()) throw std::logic_error(std::string("the virtual campaign has no ") + protocol);
  }
  const rig::ValveUnderTest& valve = asked.valve;
  calibration::AxialForceMaps axial_force_maps;
  axial_force_maps.joined = by_protocol["axial_force_map"];
  model::Model out = calibration::calibrate_valve(
      {.spring = *by_protocol["spring"].front(),
       .solenoid_force_map = *by_protocol["solenoid_force_map"].front(),
       .solenoid_dynamic = by_protocol["solenoid_dynamic"],
       .axial_force_maps = axial_force_maps,
       .operation = by_protocol["operation"]},
      {valve.name, units::m3_per_s_from_L_per_min(valve.rating.flow_L_per_min), valve.plant.spool.stroke_m, "b"},
      [&](const std::string&, double share) { progress(measuring_share + (1 - measuring_share) * share); });
  const rig::Oil& oil = valve.plant.oil;
  out.fluid = {valve.fluid, oil.density_15C_kg_per_m3, oil.viscosity_40C_m2_per_s, oil.viscosity_100C_m2_per_s};
  return out;
}

namespace {

using recording::Channel;
using recording::Recording;

/// The minute and the judging runs of one unit.
struct Measured {
  Recording strokes, minute;
  std::vector<rig::Simulation> judging;
};

Measured measured(const SeriesPlan& plan, const rig::ValveAndCampaign& unit) {
  const rig::ValveUnderTest valve = rig::as_built(unit.valve);
  std::vector<rig::ValveUnderTest> valves{valve};
  std::vector<rig::BenchRun> runs{rig::plan(plan.minute, valve, plan.seed)};
  runs.front().valve_dithers = false;  // it would hide the forces
  for (std::size_t run = 0; run < series_runs; ++run) {
    const bool dithers = series_run_names[run] == std::string_view("dithered_duty");
    valves.push_back(dithers ? rig::dithered(valve, unit.campaign) : valve);
    runs.push_back(rig::plan(plan.judging[run], valves.back(), plan.seed));
  }
  std::vector<std::uint64_t> seeds;
  for (std::size_t run = 0; run < runs.size(); ++run) seeds.push_back(valve.seed + run);
  std::vector<rig::Simulation> done = rig::simulate_together(valves, runs, seeds, {.with_truth = true});
  const rig::BenchRun strokes = rig::plan(rig::protocol_named("unpressurised_strokes"), valve, plan.seed);
  Measured out{
      rig::simulate(valve, strokes, valve.seed + runs.size()).recording, std::move(done.front().recording), {}};
  for (std::size_t run = 0; run < series_runs; ++run) out.judging.push_back(std::move(done[1 + run]));
  return out;
}

/// The sensor over one run, against the true flow of the plant.
SeriesFigures figures(const model::Model& model, const rig::Simulation& run) {
  const std::vector<double>& flow_L_min = run.truth["flow_L_min"];
  const estimation::Columns columns = estimation::sensor_columns(run.recording);
  constexpr double finding_s = 0.5;  // until then nothing moves and nothing is known
  const double rated_m3_per_s = model.valve.rated_flow_m3_per_s;
  validation::ComparedSamples samples(rated_m3_per_s);
  estimation::RunningSensor sensor = estimation::running_sensor(model, estimation::Estimator::observer);
  estimation::run(sensor, columns, [&](std::size_t k, const sensor::Estimate<double>& estimate) {
    if (columns.time_s[k] < finding_s) return;
    samples.add({estimate.flow_m3_per_s, estimate.flow_lower_m3_per_s, estimate.flow_upper_m3_per_s,
                 units::m3_per_s_from_L_per_min(flow_L_min[k]), false, false, false});
  });
  const validation::GroupFigures all = samples.metrics().all;
  return {all.error.p95 / rated_m3_per_s, all.error.largest / rated_m3_per_s, all.band_coverage,
          all.band_mean_width_m3_per_s / rated_m3_per_s};
}

/// As its recorder would have left them out.
Recording without_instruments(Recording recording) {
  for (const Channel channel : {Channel::flow_reference, Channel::pressure_difference})
    recording.column(channel).clear();
  return recording;
}

std::vector<calibration::UnitRun> unit_runs(const Recording& strokes, const Recording& minute) {
  return {{&strokes, recording::Protocol::unpressurised_strokes}, {&minute, recording::Protocol::operation}};
}

}  // namespace

const char* name(KnownBy by) {
  static constexpr std::array names{"type", "strokes", "minute", "campaign"};
  return names[static_cast<std::size_t>(by)];
}

SeriesStudyUnit judged_unit(const SeriesPlan& plan, const rig::ValveAndCampaign& unit) {
  const Measured recordings = measured(plan, unit);
  const Recording bare_minute = without_instruments(recordings.minute);
  const auto model_by = [&](KnownBy by) {
    const auto of_type = [&](std::vector<calibration::UnitRun> runs) {
      return calibration::unit_of_type(plan.type, plan.type_file, {unit.valve.name, unit.valve.name, std::move(runs)})
          .model;
    };
    switch (by) {
      case KnownBy::type:
        return plan.type;
      case KnownBy::strokes:
        return of_type(unit_runs(recordings.strokes, bare_minute));
      case KnownBy::minute:
        return of_type({{&recordings.minute, recording::Protocol::operation}});
      case KnownBy::campaign:
        break;
    }
    return virtual_model(unit, 1, [](double) {});
  };
  SeriesStudyUnit out{unit.valve.spread_seed, {}};
  for (const KnownBy by : all_known_by) {
    SeriesJudged& judged = out.by[static_cast<std::size_t>(by)];
    try {
      const model::Model model = model_by(by);
      for (std::size_t run = 0; run < series_runs; ++run) judged.runs[run] = figures(model, recordings.judging[run]);
    } catch (const calibration::CalibrationError& error) {
      judged.refusal = error.what();
    }
  }
  return out;
}

}  // namespace spoolflow::analysis
