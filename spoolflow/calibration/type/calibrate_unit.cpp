#include "spoolflow/calibration/type/calibrate_unit.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include <fmt/format.h>

#include "spoolflow/calibration/completeness.hpp"
#include "spoolflow/calibration/environment.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/observer.hpp"
#include "spoolflow/calibration/type/one_side.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/calibration/type/unit_agreement.hpp"
#include "spoolflow/calibration/type/unit_parameters.hpp"
#include "spoolflow/calibration/unpressurised_strokes.hpp"
#include "spoolflow/plausibility/channel_findings.hpp"
#include "spoolflow/plausibility/known_valve.hpp"
#include "spoolflow/plausibility/run_findings.hpp"
#include "spoolflow/plausibility/run_means.hpp"
#include "spoolflow/plausibility/run_relations.hpp"
#include "spoolflow/recording/coil_channels.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::calibration {
namespace {

/// The direction of a run of the whole valve.
constexpr const char* through_centre = "both";

/// Each direction beside the type: how far the fit moved, over how far units of the type lie.
std::vector<UnitParameter> compared(const UnitFit& fit, const KnownDeviations& type, const Deviations& tolerances) {
  std::vector<UnitParameter> out;
  for (std::size_t k = 0; k < variations; ++k) {
    const VariationAbout& about = all_variations()[k];
    const double prior2 = type.covariance(k, k), left2 = fit.known.covariance(k, k);
    const double moved = fit.known.mean(k) - type.mean(k);
    const bool seen = left2 < unseen_share * unseen_share * prior2;
    const double deviations = moved / std::sqrt(prior2);
    out.push_back({std::string(about.name), std::string(about.unit), tolerances[k], fit.known.mean(k), std::sqrt(left2),
                   deviations, seen, std::abs(deviations) > marginal_deviations});
  }
  return out;
}

std::string written(const UnitParameter& parameter) {
  return fmt::format("{} {} ({:.1f} standard deviations)", parameter.name,
                     written_deviation(parameter.unit, parameter.value), std::abs(parameter.deviations));
}

/// The worst first, up to four.
std::string worst_of(std::vector<UnitParameter> parameters) {
  std::ranges::sort(parameters,
                    [](const auto& a, const auto& b) { return std::abs(a.deviations) > std::abs(b.deviations); });
  std::string out;
  constexpr std::size_t named = 4;
  for (std::size_t k = 0; k < std::min(named, parameters.size()); ++k) {
    if (k > 0 && std::abs(parameters[k].deviations) < 2) break;
    out += (k > 0 ? ", " : "") + written(parameters[k]);
  }
  return out;
}

/// Why the unit is not of the type; empty: it is.
std::string refusal_of(const UnitCalibration& unit, const std::string& file, const std::string& type) {
  const bool far = std::ranges::any_of(unit.parameters, [](const UnitParameter& parameter) {
    return std::abs(parameter.deviations) > foreign_deviations;
  });
  if (far || unit.chi_square > foreign_chi_square) {
    const std::string bound =
        far ? fmt::format("a unit of the type lies within {:g} standard deviations in each", foreign_deviations)
            : fmt::format(
                  "each lies within {:g} standard deviations, but the squares of all directions add up to "
                  "{:.0f}, and of a unit of the type to {:g} at most",
                  foreign_deviations, unit.chi_square, foreign_chi_square);
    return fmt::format(
        "{}: the unit is not of the type {}: {}; {}; check that recordings and type belong together, or give the type "
        "wider [tolerances] where such units are made",
        file, type, worst_of(unit.parameters), bound);
  }
  if (unit.misfit <= largest_misfit) return {};
  return fmt::format(
      "{}: no unit of the type {} explains the recordings: their forces and flows are off by {:.1f} times what is "
      "expected, at most {:g}; nearest is {}; check signs, units and instruments of the recordings, or calibrate the "
      "unit by a campaign of its own",
      file, type, unit.misfit, largest_misfit, worst_of(unit.parameters));
}

void require_evidence(const UnitEvidence& evidence, const std::string& file, const model::Model& type) {
  if (evidence.any(EvidenceOf::force) || evidence.any(EvidenceOf::unpressurised_force) ||
      evidence.any(EvidenceOf::breakaway) || evidence.any(EvidenceOf::flow))
    return;
  throw CalibrationError(fmt::format(
      "{}: the recordings show no forces and no flow of the unit; record unpressurised_strokes, or operation with "
      "pressure_difference, in which the spool moves over its stroke with the dither off, under "
      "{:.0f} bar at most, up to which the type was calibrated",
      file, 1e-5 * type.observer->parameters.edge.highest_pressure_difference_Pa()));
}

Deviations tolerances_of(const model::Model& type) {
  Deviations out{};
  for (std::size_t k = 0; k < variations; ++k) out[k] = type.type->deviations[k].tolerance;
  return out;
}

/// From the unit's recordings of that direction, whether it is of the type or not.
UnitCalibration of_direction(const model::Model& type, const std::string& type_file, const UnitRecordings& unit) {
  const KnownDeviations prior = known_of_type(type, type_file);
  const UnitEvidence evidence(type, unit.runs);
  require_evidence(evidence, unit.file, type);
  const UnitFit fit = most_likely_unit(evidence, prior);
  const Deviations tolerances = tolerances_of(type);
  UnitCalibration out{type, compared(fit, prior, tolerances), 0, fit.misfit, fit.known, {}, evidence.shown_by()};
  for (const UnitParameter& parameter : out.parameters) out.chi_square += parameter.deviations * parameter.deviations;
  out.refusal = refusal_of(out, unit.file, type.type->name);
  if (!out.refusal.empty()) return out;
  const Deviations deviations = fit.known.mean;
  out.model.observer->parameters = unit_parameters(type.observer->parameters, deviations);
  out.model.condensed.parameters = unit_parameters(type.condensed.parameters, deviations);
  out.model.type = type_section(type.type->name, true, tolerances, fit.known, type.type->environment);
  set_spread(out.model, type.type->environment, fit.known);
  return out;
}

/// What is known of a direction without recordings: the type's tables and band.
UnitCalibration unseen_unit(const model::Model& type, const std::string& type_file) {
  const KnownDeviations prior = known_of_type(type, type_file);
  UnitCalibration out{type, compared({prior, 0, {}, 0}, prior, tolerances_of(type)), 0, 0, prior, {}, {}};
  out.model.type->unit = true;
  return out;
}

/// What speaks against a run of a valve of the type, in that direction where it is of one. Strokes without pressure are
/// asked for an open stop alone.
void add_doubts(std::vector<std::string>& to, const model::Model& type, const recording::Recording& run,
                recording::Protocol protocol, const std::string& direction) {
  const bool of_one = type.whole() && direction != through_centre;
  const std::vector<plausibility::KnownValve> known =
      plausibility::known_valve(of_one ? model::of_direction(type, direction) : type);
  if (protocol == recording::Protocol::unpressurised_strokes) {
    const std::string stop =
        plausibility::undeclared_open_stop(known.front(), plausibility::RunMeans(run).means(run.file));
    if (!stop.empty()) to.push_back(fmt::format("{}: {}", run.file.filename().string(), stop));
    return;
  }
  for (plausibility::Finding& finding : plausibility::run_findings(known, plausibility::RunMeans(run), run.file))
    to.push_back(std::move(finding.text));
}

/// Directions in which the unit lies at its type's edge.
void add_edges(std::vector<std::string>& to, const CalibratedUnit& unit) {
  for (const UnitCalibration& direction : unit.directions) {
    for (const UnitParameter& parameter : direction.parameters) {
      if (parameter.marginal) to.push_back("the unit lies at the edge of its type: " + written(parameter));
    }
  }
}

/// Recordings that ought to show what the unit deviates by and do not.
void add_silent(std::vector<std::string>& to, const model::Model& type, const CalibratedUnit& unit,
                const std::vector<UnitRun>& runs) {
  for (const UnitRun& run : runs) {
    const bool shown = std::ranges::any_of(unit.directions, [&](const UnitCalibration& direction) {
      return std::ranges::count(direction.shown_by, run.recording->file) > 0;
    });
    const bool expected = run.protocol == recording::Protocol::unpressurised_strokes ||
                          run.recording->has(recording::Channel::pressure_difference);
    if (expected && !shown) to.push_back(why_it_shows_nothing(run, type));
  }
}

/// The same as unit_of_type(); a refusal says what speaks against the recordings, too.
CalibratedUnit unit_despite(const std::vector<std::string>& doubts, const model::Model& type,
                            const std::string& type_file, const UnitRecordings& unit) {
  try {
    return unit_of_type(type, type_file, unit);
  } catch (const ForeignUnit& foreign) {
    throw ForeignUnit(with_doubts(foreign.what(), doubts), foreign.directions);
  } catch (const CalibrationError& error) {
    throw CalibrationError(with_doubts(error.what(), doubts));
  }
}

/// The direction of a recording of a unit, or `through_centre`, where the type is of a whole valve; else empty.
std::string direction_of(const recording::CampaignRecording& entry, const recording::Recording& read,
                         const model::Model& type) {
  if (!type.whole()) {
    if (entry.direction == type.valve.direction) return {};
    throw CalibrationError(
        fmt::format("{}: direction = \"{}\", and the type is of \"{}\" alone; leave the recording "
                    "out, or give the whole valve's type",
                    entry.place, entry.direction, type.valve.direction));
  }
  if (recording::has_both_coils(read)) return through_centre;
  if (entry.direction != "both") return entry.direction;
  throw CalibrationError(fmt::format(
      "{}: {} has the current of one coil, and the type is of a whole valve; give direction = \"b\" (flow P "
      "to B) or \"a\" (P to A) with it, or the currents of both coils, current_a and current_b",
      entry.place, read.file.filename().string()));
}

/// The same strokes twice are no more evidence than once.
void require_new(const recording::CampaignRecording& entry, const std::string& sha256,
                 const std::vector<model::InputFile>& before) {
  const auto same = std::ranges::find(before, sha256, &model::InputFile::sha256);
  if (same == before.end()) return;
  throw CalibrationError(
      fmt::format("{}: {} holds the same as {}, which counts once; name the recording that belongs there, or take it "
                  "out",
                  entry.place, entry.file.filename().string(), same->file));
}

/// As the unit's own position sensor shows it.
void set_open_stop(double open_stop_m, model::Model& unit) {
  unit.valve.open_stop_m = open_stop_m;
  unit.observer->parameters.stopped_above_m = stopped_above_m(open_stop_m);
  if (unit.p_to_a) unit.p_to_a->observer->parameters.stopped_above_m = stopped_above_m(open_stop_m);
}

/// Those that show a direction, of runs through the centre its part, which is put into `parts`.
std::vector<UnitRun> runs_of(const model::Model& type, const std::string& direction, const std::vector<UnitRun>& runs,
                             std::deque<recording::Recording>& parts) {
  std::vector<UnitRun> out;
  for (const UnitRun& run : runs) {
    if (type.whole() && run.direction == through_centre) {
      parts.push_back(one_side(*run.recording, direction, type.valve.stroke_m).run);
      out.push_back({&parts.back(), run.protocol, direction, run.meter_gain_deviation});
    } else if (!type.whole() || run.direction == direction) {
      out.push_back(run);
    }
  }
  return out;
}

/// One standard deviation of the unit's flow meter, as a share of the reading.
double meter_gain_deviation_of(const recording::Campaign& unit) {
  constexpr double deviations_at_95 = 2;
  const std::optional<double>& stated = unit.instruments.flow_uncertainty_share;
  return stated ? *stated / deviations_at_95 : meter_gain_uncertainty;
}

/// A unit is measured in the oil that its type's tables are of.
void require_oil_of_type(const recording::CampaignFluid& fluid, const model::Model& type, const std::string& file) {
  const auto require = [&](const char* key, std::optional<double> of_unit, std::optional<double> of_type,
                           double scale) {
    constexpr double alike = 1e-3;
    if (!of_unit || (of_type && std::abs(*of_unit - *of_type) <= alike * *of_type)) return;
    throw CalibrationError(fmt::format(
        "{}: {} = {:g} in [fluid], and the type's campaign has {}; the tables are of the type's oil: leave [fluid] out "
        "where the unit was measured in it, or calibrate a type in this oil",
        file, key, *of_unit * scale, of_type ? fmt::format("{:g}", *of_type * scale) : "none"));
  };
  constexpr double mm2_per_m2 = 1e6;
  require("density_15C_kg_per_m3", fluid.density_15C_kg_per_m3, type.fluid.density_15C_kg_per_m3, 1);
  require("viscosity_40C_mm2_per_s", fluid.viscosity_40C_m2_per_s, type.fluid.viscosity_40C_m2_per_s, mm2_per_m2);
  require("viscosity_100C_mm2_per_s", fluid.viscosity_100C_m2_per_s, type.fluid.viscosity_100C_m2_per_s, mm2_per_m2);
}

/// Recordings that contradict each other.
void add_disagreements(std::vector<std::string>& to, const model::Model& type, const std::string& type_file,
                       const std::vector<UnitRun>& runs) {
  for (const std::string& direction : model::directions(type)) {
    const model::Model of_one = model::of_direction(type, direction);
    std::deque<recording::Recording> parts;
    std::string found =
        disagreeing_runs(of_one, known_of_type(of_one, type_file), runs_of(type, direction, runs, parts));
    if (!found.empty()) to.push_back(std::move(found));
  }
}

}  // namespace

recording::CampaignValve valve_of_type(const model::Model& type) {
  return {type.valve.name, type.valve.rated_flow_m3_per_s, type.valve.stroke_m, type.valve.direction};
}

CalibratedUnit unit_of_type(const model::Model& type, const std::string& type_file, const UnitRecordings& unit) {
  CalibratedUnit out{type, {}};
  out.model.valve.name = unit.name;
  std::string refusals;
  for (const std::string& direction : model::directions(type)) {
    const model::Model of_one = model::of_direction(type, direction);
    std::deque<recording::Recording> parts;
    UnitRecordings its{unit.name, unit.file, runs_of(type, direction, unit.runs, parts)};
    if (type.whole()) its.file += fmt::format(", {}", model::flow_of(direction));
    UnitCalibration found = its.runs.empty() && type.whole() && !unit.runs.empty()
                                ? unseen_unit(of_one, type_file)
                                : of_direction(of_one, type_file, its);
    found.model.valve.name = unit.name;
    if (!found.refusal.empty()) refusals += (refusals.empty() ? "" : "; also ") + found.refusal;
    model::put_direction(out.model, direction, found.model);
    out.directions.push_back(std::move(found));
  }
  if (!refusals.empty()) throw ForeignUnit(refusals, std::move(out.directions));
  return out;
}

CalibratedUnit calibrate_unit(const model::Model& type, const std::string& type_file, const recording::Campaign& unit,
                              const std::string& tool_version, const CalibrationProgress& progress) {
  static_cast<void>(known_of_type(model::of_direction(type, "b"), type_file));  // is it one
  require_oil_of_type(unit.fluid, type, unit.file.string());
  const std::vector<recording::ReadOptions> options = unit_read_options(unit, type.whole());
  model::Provenance provenance{tool_version, model::creation_time(), {}};
  provenance.inputs.push_back({"campaign", unit.file.filename().string(), model::sha256_of_file(unit.file), 0});
  provenance.inputs.push_back(
      {type_protocol, std::filesystem::path(type_file).filename().string(), model::sha256_of_file(type_file), 0});
  provenance.simulated = unit.valve.simulated || type.provenance.simulated;
  provenance.quantities = type.provenance.quantities;
  std::deque<recording::Recording> recordings;
  std::vector<UnitRun> runs;
  std::vector<const recording::Recording*> strokes;
  model::Model of_unit = type;
  if (unit.valve.open_stop_m) of_unit.valve.open_stop_m = unit.valve.open_stop_m;
  for (std::size_t k = 0; k < unit.recordings.size(); ++k) {
    const recording::CampaignRecording& entry = unit.recordings[k];
    progress(fmt::format("reading {}", entry.file.filename().string()), 0);
    std::string sha256 = model::sha256_of_file(entry.file);
    require_new(entry, sha256, provenance.inputs);
    const recording::Recording& read = recordings.emplace_back(recording::read_recording(entry.file, options[k]));
    if (entry.protocol == recording::Protocol::unpressurised_strokes) {
      const std::string why = not_unpressurised(read, type.valve.rated_flow_m3_per_s, type.valve.stroke_m);
      if (!why.empty()) throw CalibrationError(why);
      strokes.push_back(&read);
    }
    provenance.inputs.push_back({std::string(recording::name(entry.protocol)), entry.file.filename().string(),
                                 std::move(sha256), read.size(), read.resampled});
    const std::string direction = direction_of(entry, read, type);
    add_doubts(provenance.doubts, of_unit, read, entry.protocol, direction);
    runs.push_back({&read, entry.protocol, direction, meter_gain_deviation_of(unit)});
  }
  for (plausibility::Finding& finding : plausibility::channel_findings(strokes))
    provenance.doubts.push_back(std::move(finding.text));
  constexpr double reading_share = 0.3;
  progress("the unit against its type", reading_share);
  add_disagreements(provenance.doubts, type, type_file, runs);
  CalibratedUnit out = unit_despite(provenance.doubts, type, type_file, {unit.valve.name, unit.file.string(), runs});
  add_silent(provenance.doubts, type, out, runs);
  add_edges(provenance.doubts, out);
  if (unit.environment) apply(*unit.environment, out.model);
  if (unit.valve.open_stop_m) set_open_stop(*unit.valve.open_stop_m, out.model);
  out.model.provenance = std::move(provenance);
  progress("done", 1.0);
  return out;
}

}  // namespace spoolflow::calibration
