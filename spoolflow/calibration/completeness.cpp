#include "spoolflow/calibration/completeness.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/protocol_channels.hpp"
#include "spoolflow/recording/channel_binding.hpp"
#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/open_table.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

using recording::Protocol;

/// A bench test without which no model is made.
struct BenchTest {
  Protocol protocol;
  bool only_one;
  Protocol instead;  ///< which does in its place on a flow bench
};
constexpr std::array bench_tests{BenchTest{Protocol::spring, true, Protocol::unpressurised_strokes},
                                 BenchTest{Protocol::solenoid_force_map, true, Protocol::metering},
                                 BenchTest{Protocol::axial_force_map, false, Protocol::metering}};

/// Every test of every direction that is missing, or that stands twice.
void add_tests(std::vector<std::string>& to, const recording::Campaign& campaign) {
  std::vector<std::string> directions = bench_directions(campaign);
  if (directions.empty()) directions.push_back(campaign.valve.direction);
  for (const std::string& direction : directions) {
    const std::string of = directions.size() > 1 ? fmt::format(" and direction \"{}\"", direction) : "";
    const auto count_of = [&](Protocol protocol) {
      return std::ranges::count_if(campaign.recordings, [&](const recording::CampaignRecording& recording) {
        return recording.protocol == protocol && recording.direction == direction;
      });
    };
    const bool on_flow_bench = count_of(Protocol::metering) > 0;
    for (const BenchTest& test : bench_tests) {
      const auto count = count_of(test.protocol);
      if (count == 0 && count_of(test.instead) > 0) continue;
      const Protocol missing = on_flow_bench ? test.instead : test.protocol;
      const std::string_view protocol = recording::name(missing);
      if (count == 0) {
        to.push_back(fmt::format("names no recording with protocol \"{}\"{}: {}, and add its [[recording]] table",
                                 protocol, of, how_recorded(missing)));
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

/// What each recording is read with; why one cannot serve goes to `missing`. Nothing of directions is asked.
/// `one_direction`, unless empty, says why no recording can be of both, and what to do with one that is.
std::vector<recording::ReadOptions> options_of(const recording::Campaign& campaign, std::string_view one_direction,
                                               std::vector<std::string>& missing) {
  std::vector<recording::ReadOptions> out;
  std::set<std::string> columns;
  bool all_open = true;
  for (const recording::CampaignRecording& entry : campaign.recordings) {
    const ProtocolChannels wanted = channels_of(entry.protocol);
    recording::ReadOptions options{entry.channels, wanted.required, wanted.optional, campaign.valve.stroke_m};
    try {
      const recording::OpenTable open = recording::open_sample_table(entry.file);
      options.channels = joined_map(entry.channels, campaign.channels, open.table->columns());
      for (const recording::FileColumn& column : open.table->columns()) columns.insert(column.name);
      for (std::string& text : missing_channels(*open.table, options, entry.protocol, entry.file.string())) {
        if (std::ranges::count(missing, text) == 0) missing.push_back(std::move(text));
      }
      if (entry.protocol == Protocol::operation && !one_direction.empty() &&
          has_both_coils(*open.table, options, entry.file.string())) {
        missing.push_back(
            fmt::format("{}: has the currents of both coils, but {}", entry.file.string(), one_direction));
      }
    } catch (const recording::RecordingError& error) {
      missing.emplace_back(error.what());
      all_open = false;
    }
    out.push_back(std::move(options));
  }
  if (all_open) add_unused_entries(missing, campaign.channels, columns);
  return out;
}

}  // namespace

std::vector<std::string> bench_directions(const recording::Campaign& campaign) {
  std::vector<std::string> out;
  for (const char* direction : {"b", "a"}) {
    if (std::ranges::any_of(campaign.recordings, [&](const recording::CampaignRecording& entry) {
          const bool of_bench = entry.protocol == Protocol::metering || !recording::by_own_solenoid(entry.protocol);
          return of_bench && entry.direction == direction;
        })) {
      out.emplace_back(direction);
    }
  }
  return out;
}

std::vector<recording::ReadOptions> complete_read_options(const recording::Campaign& campaign) {
  std::vector<std::string> tests, missing;
  add_tests(tests, campaign);
  std::vector<recording::ReadOptions> out =
      options_of(campaign,
                 bench_directions(campaign).size() > 1 ? ""
                                                       : "the campaign has bench recordings of one direction; record "
                                                         "the bench tests in both directions, or leave this "
                                                         "run out",
                 missing);
  if (tests.empty() && missing.empty()) return out;
  std::string text = tests.empty() ? "" : fmt::format("{}: {}", campaign.file.string(), fmt::join(tests, "; "));
  for (const std::string& each : missing) text += (text.empty() ? "" : "; also ") + each;
  throw CalibrationError(text);
}

std::vector<recording::ReadOptions> unit_read_options(const recording::Campaign& unit, bool whole) {
  std::vector<std::string> missing;
  for (const recording::CampaignRecording& entry : unit.recordings) {
    if (entry.protocol == Protocol::unpressurised_strokes || entry.protocol == Protocol::operation) continue;
    missing.push_back(
        fmt::format("{}: protocol \"{}\" is of a bench; a unit of a type is calibrated from unpressurised_strokes "
                    "and operation: leave the recording out, or calibrate the campaign without --type",
                    entry.place, recording::name(entry.protocol)));
  }
  std::vector<recording::ReadOptions> out = options_of(
      unit, whole ? "" : "the type is of one direction of flow; give the whole valve's type, or leave this run out",
      missing);
  if (missing.empty()) return out;
  throw CalibrationError(fmt::format("{}", fmt::join(missing, "; also ")));
}

}  // namespace spoolflow::calibration
