#include "spoolflow/calibration/protocol_channels.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/recording/channel_binding.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::calibration {

using recording::Channel;
using recording::Protocol;

namespace {

/// The column of the channel; empty where the table has none.
std::string column_of(const recording::SampleTable& table, recording::ReadOptions options, Channel channel,
                      const std::string& file) {
  options.required = {};
  options.optional = {channel};
  try {
    for (const recording::BoundColumn& column : bind_channels(table, options, file)) {
      if (column.channel == channel) return column.name;
    }
  } catch (const recording::RecordingError&) {  // missing_channels() says why
  }
  return {};
}

}  // namespace

ProtocolChannels channels_of(Protocol protocol) {
  const Alternative pressure_difference{
      {{Channel::pressure_difference}, {Channel::pressure_upstream, Channel::pressure_downstream}},
      "has no pressure difference; give \"pressure_difference\", or both \"pressure_upstream\" and "
      "\"pressure_downstream\", in the file or in a channel map"};
  switch (protocol) {
    case Protocol::spring:
      return {{Channel::time, Channel::position, Channel::axial_force}, {Channel::oil_temperature}};
    case Protocol::solenoid_force_map:
      return {{Channel::time, Channel::position, Channel::current, Channel::force},
              {Channel::current_set, Channel::voltage, Channel::oil_temperature}};
    case Protocol::solenoid_dynamic:
      return {{Channel::time, Channel::position, Channel::current, Channel::force},
              {Channel::voltage, Channel::test, Channel::oil_temperature}};
    case Protocol::axial_force_map:
      return {{Channel::time, Channel::position, Channel::axial_force},
              {Channel::pressure_difference_set, Channel::pressure_difference, Channel::pressure_upstream,
               Channel::pressure_downstream, Channel::oil_temperature, Channel::flow, Channel::flow_reference},
              {{{{Channel::flow}, {Channel::flow_reference}},
                "has no flow; give \"flow_reference\" in the file or in a channel map"},
               pressure_difference}};
    case Protocol::unpressurised_strokes:
      return {{Channel::time, Channel::position, Channel::current},
              {Channel::voltage, Channel::oil_temperature, Channel::position_set, Channel::pressure_difference,
               Channel::flow_reference}};
    case Protocol::metering:
      return {{Channel::time, Channel::position, Channel::current, Channel::flow_reference},
              {Channel::voltage, Channel::oil_temperature, Channel::position_set, Channel::pressure_difference_set,
               Channel::pressure_difference, Channel::pressure_upstream, Channel::pressure_downstream},
              {pressure_difference}};
    case Protocol::operation:
      return {{Channel::time, Channel::position},
              {Channel::current, Channel::current_a, Channel::current_b, Channel::voltage, Channel::voltage_a,
               Channel::voltage_b, Channel::oil_temperature, Channel::position_set, Channel::pressure_difference,
               Channel::flow_reference},
              {{{{Channel::current}, {Channel::current_a, Channel::current_b}},
                "has no coil current; give \"current\", or \"current_a\" and \"current_b\" of a whole valve, in the "
                "file or in a channel map"}}};
  }
  return {};
}

std::string_view how_recorded(Protocol protocol) {
  switch (protocol) {
    case Protocol::spring:
      return "stroke the spool both ways on the axial-force rig without pressure, with position and axial_force";
    case Protocol::solenoid_force_map:
      return "sweep the position of the solenoid alone both ways at four held currents or more, with current, position "
             "and force";
    case Protocol::solenoid_dynamic:
      return "move the current of the solenoid alone both ways at held positions, with current, voltage, position and "
             "force";
    case Protocol::axial_force_map:
      return "sweep the position both ways at three held pressure differences or more, with position, axial_force, "
             "flow_reference and pressure_difference";
    case Protocol::unpressurised_strokes:
      return "stroke the valve slowly both ways by its own solenoid with the pump off, with current, voltage and "
             "position";
    case Protocol::metering:
      return "stroke the valve slowly both ways by its own solenoid at three held pressure differences or more, with "
             "current, voltage, position, pressure_difference and flow_reference";
    case Protocol::operation:
      return "let the valve work beside its reference meter, with current, voltage, position and flow_reference";
  }
  return {};
}

std::vector<std::string> missing_channels(const recording::SampleTable& table, const recording::ReadOptions& options,
                                          Protocol protocol, const std::string& file) {
  std::vector<std::string> out;
  const ProtocolChannels wanted = channels_of(protocol);
  std::vector<recording::BoundColumn> bound;
  for (const Channel channel : wanted.required) {
    recording::ReadOptions some = options;
    some.required = {channel};
    some.optional = wanted.optional;
    try {
      bound = bind_channels(table, some, file);
    } catch (const recording::RecordingError& error) {
      if (std::ranges::count(out, error.what()) == 0) out.emplace_back(error.what());
    }
  }
  if (!out.empty() && bound.empty()) return out;  // no channel of it can be had
  for (const Alternative& alternative : wanted.alternatives) {
    const bool suffices = std::ranges::any_of(alternative.sets, [&](const std::vector<Channel>& set) {
      return std::ranges::all_of(set, [&](Channel channel) {
        return std::ranges::count(bound, channel, &recording::BoundColumn::channel) > 0;
      });
    });
    if (!suffices) out.push_back(fmt::format("{}: {}", file, alternative.missing));
  }
  return out;
}

ProtocolFit fit_for_protocol(const recording::SampleTable& table, const recording::ReadOptions& options,
                             Protocol protocol, const std::string& file) {
  using Need = ProtocolChannel::Need;
  ProtocolFit out{protocol, {}, missing_channels(table, options, protocol, file)};
  const ProtocolChannels wanted = channels_of(protocol);
  const auto add = [&](Channel channel, Need need) {
    if (std::ranges::count(out.channels, channel, &ProtocolChannel::channel) > 0) return;
    out.channels.push_back({channel, need, column_of(table, options, channel, file)});
  };
  for (const Channel channel : wanted.required) add(channel, Need::needed);
  if (protocol == Protocol::operation) {  // a run without it is passed over by calibrate rather than refused
    add(Channel::flow_reference, Need::needed);
    if (out.channels.back().column.empty()) {
      out.missing.push_back(
          fmt::format("{}: has no flow of a reference meter, without which calibrate passes over the run; give "
                      "\"flow_reference\" in the file or in a channel map",
                      file));
    }
  }
  for (const Alternative& alternative : wanted.alternatives) {
    for (const std::vector<Channel>& set : alternative.sets) {
      for (const Channel channel : set) add(channel, Need::one_of);
    }
  }
  for (const Channel channel : wanted.optional) add(channel, Need::helpful);
  return out;
}

}  // namespace spoolflow::calibration
