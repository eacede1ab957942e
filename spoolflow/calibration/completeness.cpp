#include "spoolflow/calibration/completeness.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/recording/channel_binding.hpp"
#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/open_table.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using recording::Protocol;

/// Channels of which one set suffices.
struct Alternative {
  std::vector<std::vector<Channel>> sets;
  std::string_view missing;
};

/// What a protocol's file is read for.
struct ProtocolChannels {
  std::vector<Channel> required, optional;
  std::vector<Alternative> alternatives{};
};

ProtocolChannels channels_of(Protocol protocol) {
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
               {{{Channel::pressure_difference}, {Channel::pressure_upstream, Channel::pressure_downstream}},
                "has no pressure difference; give \"pressure_difference\", or both \"pressure_upstream\" and "
                "\"pressure_downstream\", in the file or in a channel map"}}};
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

/// A bench test without which no model is made, and how it is recorded.
struct BenchTest {
  Protocol protocol;
  bool only_one;
  std::string_view record;
};
constexpr std::array bench_tests{
    BenchTest{Protocol::spring, true,
              "stroke the spool both ways on the axial-force rig without pressure, with position and axial_force"},
    BenchTest{
        Protocol::solenoid_force_map, true,
        "sweep the position of the solenoid alone both ways at four held currents or more, with current, position "
        "and force"},
    BenchTest{Protocol::axial_force_map, false,
              "sweep the position both ways at three held pressure differences or more, with position, axial_force, "
              "flow_reference and pressure_difference"}};

/// Every test of every direction that is missing, or that stands twice.
void add_tests(std::vector<std::string>& to, const recording::Campaign& campaign) {
  std::vector<std::string> directions = bench_directions(campaign);
  if (directions.empty()) directions.push_back(campaign.valve.direction);
  for (const std::string& direction : directions) {
    const std::string of = directions.size() > 1 ? fmt::format(" and direction \"{}\"", direction) : "";
    for (const BenchTest& test : bench_tests) {
      const auto count = std::ranges::count_if(campaign.recordings, [&](const recording::CampaignRecording& recording) {
        return recording.protocol == test.protocol && recording.direction == direction;
      });
      const std::string_view protocol = recording::name(test.protocol);
      if (count == 0) {
        to.push_back(fmt::format("names no recording with protocol \"{}\"{}: {}, and add its [[recording]] table",
                                 protocol, of, test.record));
      } else if (count > 1 && test.only_one) {
        to.push_back(
            fmt::format("names {} recordings with protocol \"{}\"{}, calibration needs exactly one: take out "
                        "the [[recording]] tables of the others",
                        count, protocol, of));
      }
    }
  }
}

/// The recording's own channel map, and of the campaign's what the file has.
recording::ChannelMap joined_map(const recording::ChannelMap& own, const recording::ChannelMap& campaigns,
                                 const std::vector<recording::FileColumn>& columns) {
  recording::ChannelMap out = own;
  for (const auto& [channel, source] : campaigns.sources) {
    if (std::ranges::count(columns, source.column, &recording::FileColumn::name) > 0)
      out.sources.emplace(channel, source);
  }
  if (out.place.empty()) out.place = campaigns.place;
  return out;
}

/// Every required channel that an open file lacks, as the reader says it.
void add_channels(std::vector<std::string>& to, const recording::SampleTable& table,
                  const recording::ReadOptions& options, Protocol protocol, const std::string& file) {
  const ProtocolChannels wanted = channels_of(protocol);
  std::vector<recording::BoundColumn> bound;
  const auto bind = [&](const std::vector<Channel>& required) {
    recording::ReadOptions some = options;
    some.required = required;
    try {
      bound = bind_channels(table, some, file);
    } catch (const recording::RecordingError& error) {
      if (std::ranges::count(to, error.what()) == 0) to.emplace_back(error.what());
    }
  };
  const std::size_t before = to.size();
  for (const Channel channel : wanted.required) bind({channel});
  if (to.size() > before && bound.empty()) return;  // no channel of it can be had
  for (const Alternative& alternative : wanted.alternatives) {
    const bool suffices = std::ranges::any_of(alternative.sets, [&](const std::vector<Channel>& set) {
      return std::ranges::all_of(set, [&](Channel channel) {
        return std::ranges::count(bound, channel, &recording::BoundColumn::channel) > 0;
      });
    });
    if (!suffices) to.push_back(fmt::format("{}: {}", file, alternative.missing));
  }
}

/// Whether a run has the currents of both coils, which makes it one of a whole valve.
bool has_both_coils(const recording::SampleTable& table, recording::ReadOptions options, const std::string& file) {
  options.required = {Channel::current_a, Channel::current_b};
  options.optional = {};
  try {
    return !bind_channels(table, options, file).empty();
  } catch (const recording::RecordingError&) {
    return false;
  }
}

/// Entries of the campaign's channel map that no file has.
void add_unused_entries(std::vector<std::string>& to, const recording::ChannelMap& map,
                        const std::set<std::string>& columns) {
  for (const auto& [channel, source] : map.sources) {
    if (columns.contains(source.column)) continue;
    to.push_back(fmt::format(
        "{}: channel {} is mapped to column '{}', which no recording of the campaign has{}; correct or leave out the "
        "entry",
        map.place, recording::name(channel), source.column,
        recording::did_you_mean(source.column, std::vector<std::string>(columns.begin(), columns.end()))));
  }
}

}  // namespace

std::vector<std::string> bench_directions(const recording::Campaign& campaign) {
  std::vector<std::string> out;
  for (const char* direction : {"b", "a"}) {
    if (std::ranges::any_of(campaign.recordings, [&](const recording::CampaignRecording& entry) {
          return entry.protocol != Protocol::operation && entry.direction == direction;
        })) {
      out.emplace_back(direction);
    }
  }
  return out;
}

std::vector<recording::ReadOptions> complete_read_options(const recording::Campaign& campaign) {
  std::vector<recording::ReadOptions> out;
  std::vector<std::string> tests, missing;
  std::set<std::string> columns;
  add_tests(tests, campaign);
  bool all_open = true;
  const bool one_direction = bench_directions(campaign).size() == 1;
  for (const recording::CampaignRecording& entry : campaign.recordings) {
    const ProtocolChannels wanted = channels_of(entry.protocol);
    recording::ReadOptions options{entry.channels, wanted.required, wanted.optional, campaign.valve.stroke_m};
    try {
      const recording::OpenTable open = recording::open_sample_table(entry.file);
      options.channels = joined_map(entry.channels, campaign.channels, open.table->columns());
      for (const recording::FileColumn& column : open.table->columns()) columns.insert(column.name);
      add_channels(missing, *open.table, options, entry.protocol, entry.file.string());
      if (entry.protocol == Protocol::operation && one_direction &&
          has_both_coils(*open.table, options, entry.file.string())) {
        missing.push_back(fmt::format(
            "{}: has the currents of both coils, but the campaign has bench recordings of one direction; record the "
            "bench tests in both directions, or leave this run out",
            entry.file.string()));
      }
    } catch (const recording::RecordingError& error) {
      missing.emplace_back(error.what());
      all_open = false;
    }
    out.push_back(std::move(options));
  }
  if (all_open) add_unused_entries(missing, campaign.channels, columns);
  if (tests.empty() && missing.empty()) return out;
  std::string text = tests.empty() ? "" : fmt::format("{}: {}", campaign.file.string(), fmt::join(tests, "; "));
  for (const std::string& each : missing) text += (text.empty() ? "" : "; also ") + each;
  throw CalibrationError(text);
}

}  // namespace spoolflow::calibration
