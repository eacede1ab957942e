#include "spoolflow/calibration/calibrate.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "spoolflow/calibration/condensed.hpp"
#include "spoolflow/calibration/edges/metering_edge_fit.hpp"
#include "spoolflow/calibration/edges_in_operation.hpp"
#include "spoolflow/calibration/environment.hpp"
#include "spoolflow/calibration/fits/bench_dither.hpp"
#include "spoolflow/calibration/flow_bench/contradictions.hpp"
#include "spoolflow/calibration/known_quantities.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/observer.hpp"
#include "spoolflow/calibration/operation/operation_uncertainty.hpp"
#include "spoolflow/calibration/unpressurised_strokes.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/monitor/contradiction.hpp"
#include "spoolflow/plausibility/campaign_findings.hpp"
#include "spoolflow/plausibility/channel_findings.hpp"
#include "spoolflow/plausibility/motion_delay.hpp"
#include "spoolflow/plausibility/run_findings.hpp"
#include "spoolflow/plausibility/run_relations.hpp"
#include "spoolflow/plausibility/zero_findings.hpp"

namespace spoolflow::calibration {
namespace {

constexpr double usual_density_kg_per_m3 = 870;  // of mineral oil, where the campaign gives none

void add_runs(std::vector<OperatingRun>& to, const Recordings& recordings, RunOf of,
              sensor::ObserverParameters<double>* other) {
  for (const recording::Recording* recording : recordings)
    to.push_back({.recording = recording, .of = of, .other = other});
}

/// Condensed sensor, and the observer as the benches determine it.
model::Direction calibrate_benches(const CampaignRecordings& recordings, const model::Valve& valve) {
  for (const recording::Recording* recording : recordings.solenoid_dynamic) require_resolved_dither(*recording);
  const recording::Recording force_map = without_dither(recordings.solenoid_force_map);
  const CampaignRecordings benches{.spring = recordings.spring,
                                   .solenoid_force_map = force_map,
                                   .solenoid_dynamic = recordings.solenoid_dynamic,
                                   .axial_force_maps = recordings.axial_force_maps,
                                   .flow_bench = recordings.flow_bench,
                                   .fluid = recordings.fluid};
  CondensedCalibration condensed = calibrate_condensed(benches, valve);
  model::Direction out{std::move(condensed.condensed), std::nullopt, std::move(condensed.evidence)};
  ObserverCalibration full = calibrate_on_bench(benches, valve, out.condensed.parameters.closed_below_m);
  out.observer = std::move(full.observer);
  out.evidence.bench = std::move(full.bench);
  return out;
}

/// The ratio of edges that were measured together, from runs.
void narrow_edges(CampaignRecordings& benches, const std::vector<RunsOfPath>& operation, const model::Valve& valve) {
  AxialForceMaps& maps = benches.axial_force_maps;
  if (maps.edges_are_unknown()) maps.edge_ratio = edge_ratio_in_operation(benches, operation, valve);
}

/// Benches of one path, and what its runs of one direction have to do with them.
plausibility::Benches benches_of(const CampaignRecordings& of, const Recordings& maps, const Recordings& operation,
                                 const recording::Campaign& campaign) {
  return {.spring = &of.spring,
          .solenoid_force_map = &of.solenoid_force_map,
          .solenoid_dynamic = of.solenoid_dynamic,
          .axial_force_maps = maps,
          .operation = operation,
          .rated_flow_m3_per_s = campaign.valve.rated_flow_m3_per_s,
          .stroke_m = campaign.valve.stroke_m,
          .density_kg_per_m3 = campaign.fluid.density_15C_kg_per_m3.value_or(usual_density_kg_per_m3)};
}

plausibility::Finding without_force_map(const recording::Recording& dynamic) {
  return {false, fmt::format("{}: nothing but the coil's largest voltage is taken of solenoid_dynamic, for without "
                             "solenoid_force_map the flow bench shows the solenoid's force; add that recording, or "
                             "leave this one out",
                             dynamic.file.filename().string())};
}

/// Recordings of one protocol and edge of which others of the same oil leave some aside.
std::vector<std::string> left_aside(const ReadCampaign& recordings, const std::string& direction) {
  const CampaignRecordings of = recordings.of(direction);
  const FlowBenchRecordings metered = recordings.on_flow_bench(direction);
  const AxialForceMaps& maps = of.axial_force_maps;
  std::vector<Recordings> alike{metered.metering, metered.metering_outlet};
  if (of.flow_bench == nullptr) alike = {maps.joined, maps.inlet, maps.outlet};
  std::vector<std::string> out;
  for (const Recordings& each : alike) std::ranges::move(maps_left_aside(each), std::back_inserter(out));
  return out;
}

/// What force benches recorded over the whole stroke.
Recordings whole_strokes(const ReadCampaign& recordings) {
  Recordings out;
  for (const std::string& direction : recordings.directions()) {
    const CampaignRecordings of = recordings.of(direction);
    if (of.flow_bench != nullptr) continue;
    out.push_back(&of.spring);
    for (const Recordings* maps :
         {&of.axial_force_maps.joined, &of.axial_force_maps.inlet, &of.axial_force_maps.outlet})
      out.insert(out.end(), maps->begin(), maps->end());
  }
  return out;
}

/// Throws CalibrationError where `refused` names anything.
void refuse(const recording::Campaign& campaign, const std::string& refused) {
  if (refused.empty()) return;
  throw CalibrationError(fmt::format(
      "{}: {}; nothing was corrected: mend the recording, its channel map or the campaign, or calibrate all "
      "the same with --despite-doubts",
      campaign.file.string(), refused));
}

/// Of each direction's recordings, and of runs through the centre where the path was measured as a whole. Throws
/// CalibrationError where one cannot be and that is refused.
std::vector<std::string> findings_about(const ReadCampaign& recordings, const recording::Campaign& campaign,
                                        Contradictions contradictions) {
  std::vector<std::string> out;
  std::string refused;
  const auto keep = [&](const std::vector<plausibility::Finding>& findings) {
    for (const plausibility::Finding& finding : findings) {
      if (std::ranges::count(out, finding.text) > 0) continue;
      out.push_back(finding.text);
      if (finding.cannot_be) refused += (refused.empty() ? "" : "; also ") + finding.text;
    }
  };
  const bool equal_flows = campaign.load.area_ratio == 1;  // else the joined path is not the working one
  const Recordings runs = equal_flows ? recordings.through_centre() : Recordings{};
  std::vector<plausibility::KnownValve> paths;
  keep(plausibility::channel_findings(recordings.all()));
  if (const auto stroke = plausibility::stroke_finding(whole_strokes(recordings), campaign.valve.stroke_m))
    keep({*stroke});
  const std::vector<std::string> directions = refused.empty() ? recordings.directions() : std::vector<std::string>{};
  for (const std::string& direction : directions) {
    for (const recording::Recording* unused : recordings.unused(direction)) keep({without_force_map(*unused)});
    const CampaignRecordings of = recordings.of(direction);
    const AxialForceMaps& maps = of.axial_force_maps;
    for (std::string& each : left_aside(recordings, direction)) keep({{false, std::move(each)}});
    if (!maps.joined.empty()) {
      const plausibility::Benches path = benches_of(of, maps.joined, of.operation, campaign);
      keep(plausibility::campaign_findings(path));
      paths.push_back(plausibility::known_valve(path));
      continue;
    }
    for (const Recordings* edge : {&maps.inlet, &maps.outlet}) {
      if (!edge->empty()) keep(plausibility::campaign_findings(benches_of(of, *edge, {}, campaign)));
    }
  }
  if (runs.empty() && paths.size() > 1) {
    const auto centre =
        plausibility::centre_finding(paths.front().opening, paths.back().opening, campaign.valve.stroke_m);
    if (centre) keep({*centre});
  }
  if (refused.empty() && paths.size() > 1) {
    for (const recording::Recording* run : runs)
      keep(plausibility::run_findings(paths, plausibility::RunMeans(*run), run->file));
  }
  if (contradictions == Contradictions::refused) refuse(campaign, refused);
  return out;
}

/// Of each direction's recordings on the flow bench. Throws CalibrationError where there are any and that is refused.
std::vector<std::string> flow_bench_contradictions(const ReadCampaign& recordings, const recording::Campaign& campaign,
                                                   Contradictions contradictions) {
  std::vector<std::string> out;
  for (const std::string& direction : recordings.directions()) {
    const FlowBenchRecordings of = recordings.on_flow_bench(direction);
    if (of.metering.empty() && !campaign.of(recording::Protocol::spring).empty()) continue;  // strokes are left aside
    for (const recording::Recording* strokes : of.unpressurised) {
      std::string why = not_unpressurised(*strokes, campaign.valve.rated_flow_m3_per_s, campaign.valve.stroke_m);
      if (!why.empty()) out.push_back(std::move(why));
    }
    for (std::string& each : contradictions_of(of, {campaign.valve.rated_flow_m3_per_s, campaign.valve.stroke_m}))
      out.push_back(std::move(each));
  }
  if (contradictions == Contradictions::refused) refuse(campaign, fmt::format("{}", fmt::join(out, "; also ")));
  return out;
}

/// What coil and forces of runs say against the benches, by the model that these make.
std::vector<std::string> contradictions_in_operation(const model::Model& model, const Recordings& runs) {
  std::vector<std::string> out;
  const plausibility::KnownValve known = plausibility::known_valve(model).front();
  for (const recording::Recording* run : runs) {
    const std::string name = run->file.filename().string();
    const plausibility::RunMeans means(*run);
    const auto add = [&](const std::string& text) {
      if (!text.empty()) out.push_back(fmt::format("{}: {}", name, text));
    };
    add(plausibility::induced_delay(known.coil, means, model.valve.stroke_m));
    if (!model.whole()) add(plausibility::undeclared_open_stop(known, means.means(run->file)));
    estimation::RunningSensor sensor = estimation::running_sensor(model, estimation::Estimator::observer);
    monitor::Monitor watch(model);
    const estimation::Columns columns = operating_columns(*run);
    for (std::size_t k = 0; k < columns.size(); ++k) watch.take(columns[k], sensor.step(columns[k]));
    const std::string found = monitor::contradiction(watch);
    if (found.empty()) continue;
    out.push_back(fmt::format(
        "{}: forces in operation contradict the benches; beside them {}; or a load cell on a bench that reads wrong: "
        "check scale and zero of load cells and ammeters, and that all recordings are of one valve",
        name, found));
  }
  return out;
}

InOperation in_operation(const model::Valve& valve, const CampaignRecordings& recordings) {
  const EquivalentBenches* flow_bench = recordings.flow_bench;
  const double least_ratio =
      recordings.strokes_as_operation ? least_stroke_force_error_ratio : least_inferred_force_error_ratio;
  return {valve.rated_flow_m3_per_s, flow_bench != nullptr ? least_ratio : 0,
          flow_bench != nullptr && !flow_bench->axial_force_was_measured, valve.moving_mass_kg.has_value()};
}

}  // namespace

model::Model calibrate_valve(CampaignRecordings recordings, const model::Valve& valve,
                             const CalibrationProgress& progress) {
  progress("condensed model and benches", 0);
  narrow_edges(recordings, {{recordings.operation, 1}}, valve);
  model::Direction fitted = calibrate_benches(recordings, valve);
  constexpr double bench_share = 0.3;
  std::vector<OperatingRun> runs;
  add_runs(runs, recordings.operation, RunOf::one, nullptr);
  calibrate_in_operation(*fitted.observer, runs, in_operation(valve, recordings), [&](double share) {
    progress("full sensor in operation", bench_share + (1 - bench_share) * share);
  });
  model::Model out;
  out.valve = valve;
  out.condensed = std::move(fitted.condensed);
  out.observer = std::move(fitted.observer);
  out.evidence = std::move(fitted.evidence);
  return out;
}

model::Model calibrate_whole_valve(CampaignRecordings p_to_b, CampaignRecordings p_to_a,
                                   const Recordings& through_centre, const model::Valve& valve,
                                   const CalibrationProgress& progress) {
  progress("benches of flow P to B", 0);
  narrow_edges(p_to_b, {{p_to_b.operation, 1}, {through_centre, 1}}, valve);
  narrow_edges(p_to_a, {{p_to_a.operation, 1}, {through_centre, -1}}, valve);
  model::Direction b = calibrate_benches(p_to_b, valve);
  constexpr double bench_share = 0.15;
  progress("benches of flow P to A", bench_share);
  model::Direction a = calibrate_benches(p_to_a, valve);
  std::vector<OperatingRun> runs;
  sensor::ObserverParameters<double>* other = &a.observer->parameters;
  add_runs(runs, p_to_b.operation, RunOf::one, other);
  add_runs(runs, p_to_a.operation, RunOf::other, other);
  add_runs(runs, through_centre, RunOf::both, other);
  calibrate_in_operation(*b.observer, runs, in_operation(valve, p_to_b), [&](double share) {
    progress("full sensor in operation", 2 * bench_share + (1 - 2 * bench_share) * share);
  });
  take_over_operation(*b.observer, *a.observer);
  model::Model out;
  out.valve = valve;
  out.valve.direction = "both";
  out.condensed = std::move(b.condensed);
  out.observer = std::move(b.observer);
  out.evidence = std::move(b.evidence);
  out.p_to_a = std::move(a);
  return out;
}

model::Model calibrate(const recording::Campaign& campaign, const std::string& tool_version,
                       const CalibrationProgress& progress, Contradictions contradictions) {
  model::Provenance provenance{tool_version, model::creation_time(), {}};
  provenance.inputs.push_back({"campaign", campaign.file.filename().string(), model::sha256_of_file(campaign.file), 0});
  ReadCampaign recordings(campaign);
  constexpr double reading_share = 0.35;
  for (std::size_t k = 0; k < campaign.recordings.size(); ++k) {
    const recording::CampaignRecording& entry = campaign.recordings[k];
    progress(fmt::format("reading {}", entry.file.filename().string()),
             reading_share * static_cast<double>(k) / static_cast<double>(campaign.recordings.size()));
    const recording::Recording& read = recordings.read_next();
    provenance.inputs.push_back({std::string(recording::name(entry.protocol)), entry.file.filename().string(),
                                 model::sha256_of_file(entry.file), read.size(), read.resampled});
  }
  const CalibrationProgress fitting = [&](const std::string& step, double share) {
    progress(step, reading_share + (1 - reading_share) * share);
  };
  const bool whole = recordings.directions().size() > 1;
  const std::string direction =
      recordings.directions().empty() ? campaign.valve.direction : recordings.directions().front();
  const std::vector<std::string> on_flow_bench = flow_bench_contradictions(recordings, campaign, contradictions);
  progress("forces from the flow bench", reading_share);
  for (const std::string& each : recordings.directions()) recordings.infer_benches(each);
  progress("what physics says of the recordings", reading_share);
  provenance.simulated = campaign.valve.simulated;
  provenance.doubts = findings_about(recordings, campaign, contradictions);
  provenance.doubts.insert(provenance.doubts.begin(), on_flow_bench.begin(), on_flow_bench.end());
  model::Valve valve{.name = campaign.valve.name,
                     .rated_flow_m3_per_s = campaign.valve.rated_flow_m3_per_s,
                     .stroke_m = campaign.valve.stroke_m,
                     .direction = direction,
                     .open_stop_m = campaign.valve.open_stop_m,
                     .moving_mass_kg = campaign.valve.moving_mass_kg};
  if (campaign.load.area_ratio != 1) valve.load_area_ratio = campaign.load.area_ratio;
  model::Model out =
      whole ? calibrate_whole_valve(recordings.of("b"), recordings.of("a"), recordings.through_centre(), valve, fitting)
            : calibrate_valve(recordings.of(direction), valve, fitting);
  out.fluid = fluid_of(campaign);
  const recording::CampaignInstruments& instruments = campaign.instruments;
  out.instruments = {instruments.position_uncertainty_m, instruments.current_uncertainty_A,
                     instruments.force_uncertainty_N, instruments.pressure_uncertainty_Pa,
                     instruments.temperature_uncertainty_K};
  limit_currents(out);
  apply(campaign.environment.value_or(recording::Environment{}), out);
  out.provenance = std::move(provenance);
  for (const std::string& each : recordings.directions()) {
    const CampaignRecordings of = recordings.of(each);
    std::ranges::move(known_quantities(of, model::of_direction(out, each)),
                      std::back_inserter(out.provenance.quantities));
    if (of.flow_bench == nullptr) continue;
    std::string scale = doubtful_scale(force_over_jet(*of.flow_bench));
    if (!scale.empty()) out.provenance.doubts.push_back(std::move(scale));
  }
  const Recordings runs = whole ? recordings.through_centre() : recordings.of(direction).operation;
  std::ranges::move(contradictions_in_operation(out, runs), std::back_inserter(out.provenance.doubts));
  progress("done", 1.0);
  return out;
}

}  // namespace spoolflow::calibration
