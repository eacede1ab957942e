#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/apps/work/harmless_text.hpp"
#include "spoolflow/apps/work/inspection_text.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::apps {
namespace {

using Need = calibration::ProtocolChannel::Need;

std::string_view words(Need need) {
  static constexpr std::array words{"needed", "one of these", "helpful"};
  return words.at(static_cast<std::size_t>(need));
}

/// The entries of the proposed map that can be read: a position may be a share of the stroke.
recording::ChannelMap readable(recording::ChannelMap map) {
  std::erase_if(map.sources, [](const auto& entry) {
    const auto unit = units::unit_named(entry.second.unit);
    const bool share = unit && unit->dimension == units::Dimension::ratio;
    return !unit || (unit->dimension != recording::dimension(entry.first) &&
                     !(share && entry.first == recording::Channel::position));
  });
  return map;
}

/// Why the numbers of that column are of no use; empty where they are.
std::string fault_of(const std::string& column, const recording::Inspection& found) {
  if (const auto infinite = found.infinite.find(column); infinite != found.infinite.end()) {
    return fmt::format(
        "column '{}' holds {} infinite values, the first at sample {}; write NaN where a sample is missing", column,
        infinite->second.count, infinite->second.first);
  }
  const auto seen = std::ranges::find(found.columns, column, &recording::InspectedColumn::name);
  if (seen == found.columns.end() || !std::isnan(seen->lowest)) return {};
  return fmt::format("column '{}' cannot serve ({}); record it as numbers", column, seen->why);
}

}  // namespace

calibration::ProtocolFit fit_of_inspected(const std::string& file, const recording::ReadOptions& options,
                                          const recording::Inspection& found, recording::Protocol protocol) {
  constexpr double any_stroke_m = 1e-3;  // a campaign has one, and what a channel is does not depend on it
  recording::ReadOptions read = options;
  if (read.channels.sources.empty()) read.channels = readable(found.proposal);
  if (!read.stroke_m) read.stroke_m = any_stroke_m;
  const auto table = recording::open_sample_table(file).table;
  calibration::ProtocolFit out = calibration::fit_for_protocol(*table, read, protocol, file);
  for (calibration::ProtocolChannel& channel : out.channels) {
    if (channel.column.empty() && channel.need == Need::needed) {
      const auto proposed = found.proposal.sources.find(channel.channel);
      if (proposed == found.proposal.sources.end() || !options.channels.sources.empty()) continue;
      out.missing.push_back(
          fmt::format("{}: column '{}' could be channel {}, whose unit the file does not state; fill "
                      "it in in the proposed channel map",
                      file, proposed->second.column, recording::name(channel.channel)));
    } else if (const std::string fault = fault_of(channel.column, found); !fault.empty()) {
      out.missing.push_back(fmt::format("{}: channel {}: {}", file, recording::name(channel.channel), fault));
    }
  }
  return out;
}

std::string protocol_text(const calibration::ProtocolFit& fit) {
  std::string out =
      fmt::format("\nProtocol {} ({}): the file {}\n", recording::name(fit.protocol),
                  calibration::how_recorded(fit.protocol), fit.missing.empty() ? "serves it" : "does not serve it");
  out += fmt::format("{:<24} {:<14} {}\n", "channel", "", "column");
  for (const calibration::ProtocolChannel& channel : fit.channels) {
    out += fmt::format("{:<24} {:<14} {}\n", recording::name(channel.channel), words(channel.need),
                       channel.column.empty() ? "not found" : terminal_text(channel.column));
  }
  for (const std::string& missing : fit.missing) out += fmt::format("Missing: {}\n", terminal_text(missing));
  return out;
}

nlohmann::ordered_json protocol_json(const calibration::ProtocolFit& fit) {
  using Json = nlohmann::ordered_json;
  Json channels = Json::array();
  for (const calibration::ProtocolChannel& channel : fit.channels) {
    channels.push_back({{"channel", recording::name(channel.channel)},
                        {"need", words(channel.need)},
                        {"column", channel.column.empty() ? Json(nullptr) : Json(channel.column)}});
  }
  return {{"name", recording::name(fit.protocol)},
          {"serves", fit.missing.empty()},
          {"channels", channels},
          {"missing", fit.missing}};
}

}  // namespace spoolflow::apps
