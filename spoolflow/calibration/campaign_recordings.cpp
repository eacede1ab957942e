#include "spoolflow/calibration/campaign_recordings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/coil_channels.hpp"
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
              {Channel::time, Channel::position},
              {Channel::current, Channel::current_a, Channel::current_b, Channel::voltage, Channel::voltage_a,
               Channel::voltage_b, Channel::oil_temperature, Channel::position_set, Channel::pressure_difference,
               Channel::flow_reference},
              {}};
  }
  return {};
}

/// Whether an operating run is of the whole valve; its channels must suffice.
bool goes_through_centre(const recording::Recording& recording, const recording::CampaignRecording& entry, bool whole) {
  if (entry.protocol != Protocol::operation) return false;
  const bool both = recording::has_both_coils(recording);
  if (!both && !recording.has(Channel::current)) {
    throw recording::RecordingError(
        fmt::format("{}: has no coil current; give \"current\", or \"current_a\" and \"current_b\" of a whole valve, "
                    "in the file or in a channel map",
                    recording.file.string()));
  }
  if (both && !whole) {
    throw CalibrationError(
        fmt::format("{}: {} is a run of the whole valve (current_a, current_b), which needs bench recordings of both "
                    "directions; give direction = \"a\" or \"b\" with each, or leave the run out",
                    entry.place, recording.file.filename().string()));
  }
  return both;
}

}  // namespace

ReadCampaign::ReadCampaign(const recording::Campaign& campaign) : campaign_(campaign) {
  for (const char* direction : {"b", "a"}) {
    if (std::ranges::any_of(campaign.recordings, [&](const recording::CampaignRecording& entry) {
          return entry.protocol != Protocol::operation && entry.direction == direction;
        })) {
      directions_.emplace_back(direction);
    }
  }
}

const recording::Recording& ReadCampaign::read_next() {
  const recording::CampaignRecording& entry = campaign_.recordings.at(loaded_.size());
  recording::ReadOptions options = channels_of(entry.protocol);
  options.channels = entry.channels;
  options.stroke_m = campaign_.valve.stroke_m;
  recording::Recording read = recording::read_recording(entry.file, options);
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
  const double area_ratio = campaign_.load.area_ratio;  // what B takes leaves A in this proportion
  out.outlet_flow_ratio = direction == "a" ? 1 / area_ratio : area_ratio;
  return out;
}

CampaignRecordings ReadCampaign::of(const std::string& direction) const {
  const std::string of_direction = directions_.size() > 1 ? fmt::format(" and direction \"{}\"", direction) : "";
  const auto only = [&](Protocol protocol) -> const recording::Recording& {
    const Recordings found = of(protocol, direction);
    if (found.size() != 1) {
      throw CalibrationError(
          fmt::format("{}: names {} recordings with protocol \"{}\"{}, calibration needs exactly one; edit its "
                      "[[recording]] tables",
                      campaign_.file.string(), found.size(), recording::name(protocol), of_direction));
    }
    return *found.front();
  };
  if (of(Protocol::axial_force_map, direction).empty()) {
    throw CalibrationError(
        fmt::format("{}: names no recording with protocol \"axial_force_map\"{}, calibration needs at least "
                    "one; edit its [[recording]] tables",
                    campaign_.file.string(), of_direction));
  }
  return {only(Protocol::spring), only(Protocol::solenoid_force_map), of(Protocol::solenoid_dynamic, direction),
          axial_force_maps(direction), of(Protocol::operation, direction)};
}

}  // namespace spoolflow::calibration
