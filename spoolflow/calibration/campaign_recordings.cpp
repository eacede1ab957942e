#include "spoolflow/calibration/campaign_recordings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/calibration/completeness.hpp"
#include "spoolflow/calibration/fits/position_sensor.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/recording/coil_channels.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Protocol;

/// Whether an operating run is of the whole valve.
bool goes_through_centre(const recording::Recording& recording, const recording::CampaignRecording& entry, bool whole) {
  if (entry.protocol != Protocol::operation) return false;
  const bool both = recording::has_both_coils(recording);
  if (both && !whole) {
    throw CalibrationError(
        fmt::format("{}: {} is a run of the whole valve (current_a, current_b), which needs bench recordings of both "
                    "directions; give direction = \"a\" or \"b\" with each, or leave the run out",
                    entry.place, recording.file.filename().string()));
  }
  return both;
}

}  // namespace

model::Fluid fluid_of(const recording::Campaign& campaign) {
  return {campaign.fluid.name, campaign.fluid.density_15C_kg_per_m3, campaign.fluid.viscosity_40C_m2_per_s,
          campaign.fluid.viscosity_100C_m2_per_s};
}

ReadCampaign::ReadCampaign(const recording::Campaign& campaign)
    : campaign_(campaign), options_(complete_read_options(campaign)), directions_(bench_directions(campaign)) {}

const recording::Recording& ReadCampaign::read_next() {
  const recording::CampaignRecording& entry = campaign_.recordings.at(loaded_.size());
  recording::Recording read = recording::read_recording(entry.file, options_.at(loaded_.size()));
  const bool through_centre = goes_through_centre(read, entry, directions_.size() > 1);
  loaded_.push_back({entry, std::move(read), through_centre});
  return loaded_.back().recording;
}

Recordings ReadCampaign::of(Protocol protocol, const std::string& direction) const {
  Recordings out;
  for (const Loaded& loaded : loaded_) {
    if (loaded.entry.protocol == protocol && loaded.entry.direction == direction && !loaded.through_centre)
      out.push_back(&loaded.recording);
  }
  return out;
}

Recordings ReadCampaign::through_centre() const {
  Recordings out;
  for (const Loaded& loaded : loaded_) {
    if (loaded.through_centre) out.push_back(&loaded.recording);
  }
  return out;
}

Recordings ReadCampaign::all() const {
  Recordings out;
  for (const Loaded& loaded : loaded_) out.push_back(&loaded.recording);
  return out;
}

AxialForceMaps ReadCampaign::axial_force_maps(const std::string& direction) const {
  AxialForceMaps out;
  const recording::PathEdges edges = recording::edges_of(direction);
  for (const Loaded& loaded : loaded_) {
    if (loaded.entry.protocol != Protocol::axial_force_map || loaded.entry.direction != direction) continue;
    Recordings& of_edge = loaded.entry.edge == edges.inlet    ? out.inlet
                          : loaded.entry.edge == edges.outlet ? out.outlet
                                                              : out.joined;
    of_edge.push_back(&loaded.recording);
  }
  if (const EquivalentBenches* equivalent = flow_bench(direction)) {
    if (has_inferred_actuator(direction)) out.joined.clear();
    const bool apart = !equivalent->outlet_force_maps.empty();
    for (const recording::Recording& map : equivalent->axial_force_maps)
      (apart ? out.inlet : out.joined).push_back(&map);
    for (const recording::Recording& map : equivalent->outlet_force_maps) out.outlet.push_back(&map);
  }
  const double area_ratio = campaign_.load.area_ratio;  // what B takes leaves A in this proportion
  out.outlet_flow_ratio = direction == "a" ? 1 / area_ratio : area_ratio;
  return out;
}

Recordings ReadCampaign::unused(const std::string& direction) const {
  return of(Protocol::solenoid_force_map, direction).empty() ? of(Protocol::solenoid_dynamic, direction) : Recordings{};
}

bool ReadCampaign::has_inferred_actuator(const std::string& direction) const {
  return flow_bench(direction) != nullptr && of(Protocol::solenoid_force_map, direction).empty();
}

const EquivalentBenches* ReadCampaign::flow_bench(const std::string& direction) const {
  const auto found = flow_benches_.find(direction);
  return found == flow_benches_.end() ? nullptr : &found->second;
}

FlowBenchRecordings ReadCampaign::on_flow_bench(const std::string& direction) const {
  FlowBenchRecordings out{of(Protocol::unpressurised_strokes, direction), {}, of(Protocol::operation, direction)};
  for (const Loaded& loaded : loaded_) {
    if (loaded.entry.protocol != Protocol::metering || loaded.entry.direction != direction) continue;
    const bool outlet = loaded.entry.edge == recording::edges_of(direction).outlet;
    (outlet ? out.metering_outlet : out.metering).push_back(&loaded.recording);
  }
  return out;
}

void ReadCampaign::infer_benches(const std::string& direction) {
  const FlowBenchRecordings recorded = on_flow_bench(direction);
  const bool spring_is_known = !of(Protocol::spring, direction).empty() || recorded.unpressurised.empty();
  if (recorded.metering.empty() && spring_is_known) return;
  const double stroke_m = campaign_.valve.stroke_m;
  MeasuredForces measured;
  for (const recording::Recording* map : of(Protocol::solenoid_force_map, direction)) {
    const double closed_m = closed_reading_m((*map)[recording::Channel::position], stroke_m);
    const recording::Recording force_map = shifted(*map, closed_m);
    std::optional<recording::Recording> dynamic;
    for (const recording::Recording* each : of(Protocol::solenoid_dynamic, direction))
      dynamic = shifted(*each, closed_m);
    measured.actuator =
        fit_actuator({force_map, dynamic ? &*dynamic : nullptr}, fit_magnetic_force(force_map, stroke_m), stroke_m);
  }
  for (const recording::Recording* strokes : of(Protocol::spring, direction))
    measured.spring = fit_spring(without_zero_offset(*strokes, stroke_m), stroke_m);
  for (const recording::Recording* map : axial_force_maps(direction).joined)
    measured.axial.push_back(fit_axial_force(without_zero_offset(*map, stroke_m), stroke_m));
  flow_benches_.emplace(direction, equivalent_benches(recorded, measured, stroke_m));
}

CampaignRecordings ReadCampaign::of(const std::string& direction) const {
  const EquivalentBenches* equivalent = flow_bench(direction);
  const auto only = [&](Protocol protocol, recording::Recording EquivalentBenches::*inferred) -> const auto& {
    const Recordings recorded = of(protocol, direction);
    return equivalent != nullptr && (recorded.empty() || has_inferred_actuator(direction)) ? equivalent->*inferred
                                                                                           : *recorded.at(0);
  };
  Recordings operation = of(Protocol::operation, direction);
  // Strokes at held pressure differences are operation, too: slow, by the valve's own solenoid.
  const bool strokes = operation.empty() && directions_.size() < 2;
  if (strokes) operation = of(Protocol::metering, direction);
  return {only(Protocol::spring, &EquivalentBenches::spring),
          only(Protocol::solenoid_force_map, &EquivalentBenches::solenoid_force_map),
          of(Protocol::solenoid_dynamic, direction),
          axial_force_maps(direction),
          operation,
          equivalent,
          fluid_of(campaign_),
          strokes};
}

}  // namespace spoolflow::calibration
