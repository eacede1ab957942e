#include "spoolflow/calibration/calibrate.hpp"

#include <deque>

#include <fmt/format.h>

#include "spoolflow/calibration/condensed.hpp"
#include "spoolflow/calibration/fits/bench_dither.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/observer.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using recording::Protocol;

/// The channels that a protocol cannot do without, and those that it uses where they are.
recording::ReadOptions channels_of(Protocol protocol) {
  switch (protocol) {
    case Protocol::spring:
      return {{}, {Channel::time, Channel::position, Channel::axial_force}, {Channel::oil_temperature}, {}};
    case Protocol::solenoid_force_map:
      return {{},
              {Channel::time, Channel::position, Channel::current, Channel::force},
              {Channel::current_set, Channel::voltage, Channel::oil_temperature},
              {}};
    case Protocol::solenoid_dynamic:
      return {{},
              {Channel::time, Channel::position, Channel::current, Channel::force},
              {Channel::voltage, Channel::test, Channel::oil_temperature},
              {}};
    case Protocol::axial_force_map:
      return {{},
              {Channel::time, Channel::position, Channel::axial_force},
              {Channel::pressure_difference_set, Channel::pressure_difference, Channel::pressure_upstream,
               Channel::pressure_downstream, Channel::oil_temperature, Channel::flow, Channel::flow_reference},
              {}};
    case Protocol::operation:
      return {{},
              {Channel::time, Channel::position, Channel::current},
              {Channel::voltage, Channel::oil_temperature, Channel::position_set, Channel::pressure_difference,
               Channel::flow_reference},
              {}};
  }
  return {};
}

/// A campaign's recordings, read; addresses stay valid while more are read.
struct Loaded {
  Protocol protocol;
  recording::Recording recording;
};

std::vector<const recording::Recording*> of(const std::deque<Loaded>& all, Protocol protocol) {
  std::vector<const recording::Recording*> out;
  for (const Loaded& loaded : all) {
    if (loaded.protocol == protocol) out.push_back(&loaded.recording);
  }
  return out;
}

const recording::Recording& only(const std::deque<Loaded>& all, Protocol protocol,
                                 const recording::Campaign& campaign) {
  const std::vector<const recording::Recording*> found = of(all, protocol);
  if (found.size() != 1) {
    throw CalibrationError(
        fmt::format("{}: names {} recordings with protocol \"{}\", calibration needs exactly one; edit its "
                    "[[recording]] tables",
                    campaign.file.string(), found.size(), recording::name(protocol)));
  }
  return *found.front();
}

}  // namespace

model::Model calibrate_valve(const CampaignRecordings& recordings, const model::Valve& valve,
                             const CalibrationProgress& progress) {
  model::Model out;
  out.valve = valve;
  progress("condensed model", 0);
  for (const recording::Recording* recording : recordings.solenoid_dynamic) require_resolved_dither(*recording);
  const recording::Recording force_map = without_dither(recordings.solenoid_force_map);
  CondensedCalibration condensed =
      calibrate_condensed({recordings.spring, force_map, recordings.axial_force_maps}, valve);
  out.condensed = std::move(condensed.condensed);
  out.evidence = std::move(condensed.evidence);
  constexpr double condensed_share = 0.15;
  progress("full sensor", condensed_share);
  ObserverCalibration full = calibrate_observer(
      {recordings.spring, force_map, recordings.solenoid_dynamic, recordings.axial_force_maps, recordings.operation},
      valve, out.condensed.parameters.closed_below_m,
      [&](double share) { progress("full sensor in operation", condensed_share + (1 - condensed_share) * share); });
  out.observer = std::move(full.observer);
  out.evidence.bench = std::move(full.bench);
  return out;
}

model::Model calibrate(const recording::Campaign& campaign, const std::string& tool_version,
                       const CalibrationProgress& progress) {
  model::Model out;
  out.valve = {campaign.valve.name, campaign.valve.rated_flow_m3_per_s, campaign.valve.stroke_m,
               campaign.valve.direction};
  out.fluid = {campaign.fluid.name, campaign.fluid.density_15C_kg_per_m3, campaign.fluid.viscosity_40C_m2_per_s,
               campaign.fluid.viscosity_100C_m2_per_s};
  const recording::CampaignInstruments& instruments = campaign.instruments;
  out.instruments = {instruments.position_uncertainty_m, instruments.current_uncertainty_A,
                     instruments.force_uncertainty_N, instruments.pressure_uncertainty_Pa,
                     instruments.temperature_uncertainty_K};
  out.provenance = {tool_version, model::creation_time(), {}};
  out.provenance.inputs.push_back(
      {"campaign", campaign.file.filename().string(), model::sha256_of_file(campaign.file), 0});

  std::deque<Loaded> loaded;
  constexpr double reading_share = 0.35;
  for (std::size_t k = 0; k < campaign.recordings.size(); ++k) {
    const recording::CampaignRecording& entry = campaign.recordings[k];
    progress(fmt::format("reading {}", entry.file.filename().string()),
             reading_share * static_cast<double>(k) / static_cast<double>(campaign.recordings.size()));
    recording::ReadOptions options = channels_of(entry.protocol);
    options.channels = entry.channels;
    options.stroke_m = campaign.valve.stroke_m;
    loaded.push_back({entry.protocol, recording::read_recording(entry.file, options)});
    out.provenance.inputs.push_back({std::string(recording::name(entry.protocol)), entry.file.filename().string(),
                                     model::sha256_of_file(entry.file), loaded.back().recording.size()});
  }

  const std::vector<const recording::Recording*> axial_force_maps = of(loaded, Protocol::axial_force_map);
  if (axial_force_maps.empty()) {
    throw CalibrationError(
        fmt::format("{}: names no recording with protocol \"axial_force_map\", calibration needs at least "
                    "one; edit its [[recording]] tables",
                    campaign.file.string()));
  }
  model::Model fitted = calibrate_valve({.spring = only(loaded, Protocol::spring, campaign),
                                         .solenoid_force_map = only(loaded, Protocol::solenoid_force_map, campaign),
                                         .solenoid_dynamic = of(loaded, Protocol::solenoid_dynamic),
                                         .axial_force_maps = axial_force_maps,
                                         .operation = of(loaded, Protocol::operation)},
                                        out.valve, [&](const std::string& step, double share) {
                                          progress(step, reading_share + (1 - reading_share) * share);
                                        });
  out.condensed = std::move(fitted.condensed);
  out.observer = std::move(fitted.observer);
  out.evidence = std::move(fitted.evidence);
  progress("done", 1.0);
  return out;
}

}  // namespace spoolflow::calibration
