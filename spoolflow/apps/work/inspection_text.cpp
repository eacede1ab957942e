#include "spoolflow/apps/work/inspection_text.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "spoolflow/apps/work/harmless_text.hpp"
#include "spoolflow/apps/work/notes.hpp"
#include "spoolflow/recording/channels/channel_unit.hpp"
#include "spoolflow/recording/proposal.hpp"

namespace spoolflow::apps {
namespace {

/// Every text among the values is made harmless.
template <class... Values>
void add(std::string& out, fmt::format_string<detail::Harmless<Values>...> format, const Values&... values) {
  out += fmt::format(format, detail::harmless(values)...);
}

double in_unit(const units::Unit& unit, double value_SI) {
  return (value_SI - unit.offset) * (1 / unit.factor);
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Columns that the map does not name.
std::vector<std::string> columns_left_out(const recording::ChannelMap& map, const recording::Inspection& found) {
  std::vector<std::string> out;
  for (const std::string& column : found.contents.names()) {
    const auto names_it = [&](const auto& entry) { return entry.second.column == column; };
    if (std::ranges::none_of(map.sources, names_it)) out.push_back(column);
  }
  return out;
}

std::string names_of(const std::vector<recording::Channel>& channels) {
  std::vector<std::string> names;
  for (const recording::Channel channel : channels) names.emplace_back(recording::name(channel));
  return joined(names);
}

/// Every column with its raw range and what it is taken for, where a name is not the program's own.
void add_columns(std::string& out, const recording::Inspection& found) {
  const auto own = [](const recording::InspectedColumn& column) { return column.why == "its own name"; };
  if (std::ranges::all_of(found.columns, own)) return;
  add(out, "{:<24} {:<8} {:>12} {:>12}  {}\n", "column", "unit", "lowest", "highest", "taken as");
  for (const recording::InspectedColumn& column : found.columns) {
    const std::string_view channel = column.channel ? recording::name(*column.channel) : "";
    const std::string taken = column.channel
                                  ? fmt::format("{}{}: {}", channel, column.guessed ? ", a guess" : "", column.why)
                              : column.times_others ? column.why
                              : column.why.empty()  ? "not used"
                                                    : "not used; " + column.why;
    add(out, "{:<24} {:<8} {:>12.5g} {:>12.5g}  {}\n", column.name, column.unit.empty() ? "?" : column.unit,
        column.lowest, column.highest, taken);
  }
  add(out, "\n");
}

/// Samples that no estimate takes, in whatever column.
void add_infinite(std::string& out, const recording::Inspection& found) {
  for (const auto& [column, infinite] : found.infinite) {
    add(out,
        "'{}' holds {} infinite {}, the first one ({}) at sample {}; write NaN where a sample is missing before the "
        "column is used\n",
        column, infinite.count, infinite.count == 1 ? "value" : "values", infinite.value, infinite.first);
  }
  if (!found.infinite.empty()) add(out, "\n");
}

void add_missing(std::string& out, const recording::Inspection& found) {
  if (!found.missing.empty()) add(out, "Needed and not found: {}\n", names_of(found.missing));
  if (!found.helpful.empty()) {
    add(out, "Not found, and helpful: {} (voltage and oil temperature narrow the band; validate needs a flow)\n",
        names_of(found.helpful));
  }
  std::vector<std::string> unused;
  for (const recording::InspectedColumn& column : found.columns) {
    if (!column.channel && !column.times_others) unused.push_back(column.name);
  }
  if (!unused.empty()) add(out, "Columns that are not used: {}\n", joined(unused));
  if (!found.missing.empty() || !found.helpful.empty() || !unused.empty()) add(out, "\n");
}

void add_proposal(std::string& out, const recording::Inspection& found) {
  add_columns(out, found);
  add_missing(out, found);
  if (found.proposal.sources.empty()) {
    add(out,
        "No column is known by its name or its numbers; write a channel map by hand (see docs/formats/channels.md).\n");
    return;
  }
  const std::string map = recording::written(found.proposal, found.remarks, found.missing);
  const bool asks = map.find("\"?\"") != std::string::npos || !found.remarks.empty();
  out += (fmt::format("Proposed channel map ({}, then give it with --channels MAP.toml):\n\n{}",
                      asks ? "fill in each \"?\" and check what is called a guess" : "check it", terminal_lines(map)));
}

/// What else the file holds, of which nobody should think that it was seen.
void add_unread(std::string& out, const recording::Inspection& found) {
  constexpr std::size_t most = 10;
  const std::vector<std::string>& unread = found.contents.unread;
  for (std::size_t k = 0; k < std::min(unread.size(), most); ++k) add(out, "Not read: {}\n", unread[k]);
  if (unread.size() > most) add(out, "Not read: {} more\n", unread.size() - most);
  if (!unread.empty()) add(out, "\n");
}

void add_notes(std::string& out, const recording::Inspection& found) {
  if (!found.resampled.empty()) add(out, "{}\n", found.resampled);
}

/// The times of a file whose columns are of several, and what becomes of them.
void add_clocks(std::string& out, const recording::Inspection& found) {
  if (found.clocks.empty()) return add_notes(out, found);
  add(out, "\n{:<24} {:>10} {:>10} {:>12} {:>12}  {}\n", "time", "samples", "Hz", "from s", "to s", "columns");
  for (const recording::InspectedClock& clock : found.clocks) {
    add(out, "{:<24} {:>10} {:>10.4g} {:>12.6g} {:>12.6g}  {}\n", clock.time.empty() ? "(even steps)" : clock.time,
        clock.samples, clock.rate_Hz, clock.begin_s, clock.end_s,
        joined(clock.columns) + (clock.leads ? " (the others are brought onto this time)" : ""));
    if (!clock.fault.empty()) add(out, "  cannot be used: {}\n", clock.fault);
  }
  add_notes(out, found);
}

using Json = nlohmann::ordered_json;  // writes null for what is no number

Json names_json(const std::vector<recording::Channel>& channels) {
  Json out = Json::array();
  for (const recording::Channel channel : channels) out.push_back(recording::name(channel));
  return out;
}

Json gaps_json(const recording::Inspection& found) {
  Json out = Json::array();
  for (const recording::Gap& gap : found.gaps) out.push_back({gap.from_s, gap.to_s});
  return out;
}

Json channels_json(const recording::Inspection& found) {
  Json out = Json::array();
  for (const recording::ChannelSummary& summary : found.channels) {
    const units::Unit unit = recording::usual_unit(summary.channel);
    out.push_back({{"channel", recording::name(summary.channel)},
                   {"unit", unit.name},
                   {"lowest", in_unit(unit, summary.lowest)},
                   {"mean", in_unit(unit, summary.mean)},
                   {"highest", in_unit(unit, summary.highest)},
                   {"missing", summary.missing},
                   {"clipped_share", summary.clipped}});
  }
  return out;
}

Json clocks_json(const recording::Inspection& found) {
  Json out = Json::array();
  for (const recording::InspectedClock& clock : found.clocks) {
    out.push_back({{"column", clock.time},
                   {"samples", clock.samples},
                   {"rate_Hz", clock.rate_Hz},
                   {"begin_s", clock.begin_s},
                   {"end_s", clock.end_s},
                   {"leads", clock.leads},
                   {"fault", clock.fault},
                   {"columns", clock.columns}});
  }
  return out;
}

Json columns_json(const recording::Inspection& found) {
  Json out = Json::array();
  for (const recording::InspectedColumn& column : found.columns) {
    out.push_back({{"column", column.name},
                   {"unit", column.unit},
                   {"lowest", column.lowest},
                   {"highest", column.highest},
                   {"channel", column.channel ? Json(recording::name(*column.channel)) : Json(nullptr)},
                   {"guessed", column.guessed},
                   {"why", column.why}});
  }
  return out;
}

Json infinite_json(const recording::Inspection& found) {
  Json out = Json::array();
  for (const auto& [column, infinite] : found.infinite) {
    out.push_back({{"column", column},
                   {"count", infinite.count},
                   {"first_sample", infinite.first},
                   {"negative", infinite.value < 0}});
  }
  return out;
}

/// The proposal as values; the same as TOML stands in proposed_channel_map.
Json map_json(const recording::ChannelMap& map) {
  Json out = Json::object();
  for (const auto& [channel, source] : map.sources) {
    Json& entry = out[std::string(recording::name(channel))] = {{"column", source.column}, {"unit", source.unit}};
    if (source.scale != 1.0) entry["scale"] = source.scale;
    if (source.offset != 0.0) entry["offset"] = source.offset;
    if (source.to) entry["to"] = *source.to;
  }
  return out;
}

}  // namespace

std::string inspection_text(const InspectedFile& inspected) {
  std::string out;
  const recording::Inspection& found = inspected.found;
  add(out, "{}: {}, {} columns: {}\n", inspected.file, found.contents.format, found.contents.columns.size(),
      joined(found.contents.names()));
  add_clocks(out, found);
  if (!found.channels.empty()) {
    add(out, "{} samples from {:.6g} to {:.6g} s ({:.6g} s), {:.6g} Hz", found.samples, found.begin_s, found.end_s,
        found.end_s - found.begin_s, found.rate_Hz);
    if (found.jitter > 0.01) add(out, ", time steps vary by up to {:.0f} %", 100 * found.jitter);
    add(out, "\n");
    if (found.duplicate_times > 0) add(out, "{}\n", repeated_times_text(found.duplicate_times, found.samples));
    if (found.gap_count > 0) {
      add(out, "{} gaps in time", found.gap_count);
      for (const recording::Gap& gap : found.gaps)
        add(out, "{} {:.6g} to {:.6g} s", &gap == found.gaps.data() ? ":" : ",", gap.from_s, gap.to_s);
      add(out, "{}\n", found.gap_count > found.gaps.size() ? ", …" : "");
    }
    add(out, "\n{:<24} {:<8} {:>12} {:>12} {:>12} {:>9} {:>9}\n", "channel", "unit", "lowest", "mean", "highest",
        "missing", "clipped");
    for (const recording::ChannelSummary& summary : found.channels) {
      const units::Unit unit = recording::usual_unit(summary.channel);
      const auto shown = [&](double value) { return in_unit(unit, value); };
      add(out, "{:<24} {:<8} {:>12.5g} {:>12.5g} {:>12.5g} {:>9} {:>8.2f}%\n", recording::name(summary.channel),
          unit.name, shown(summary.lowest), shown(summary.mean), shown(summary.highest), summary.missing,
          100 * summary.clipped);
    }
    add(out, "\n");
  }
  add_unread(out, found);
  add_infinite(out, found);
  if (inspected.map_file.empty()) {
    add_proposal(out, found);
  } else if (const std::vector<std::string> columns = columns_left_out(inspected.map, found); columns.empty()) {
    add(out, "Read with {}, which names every column.\n", inspected.map_file);
  } else {
    add(out, "Read with {}; columns that it does not name: {}\n", inspected.map_file, joined(columns));
  }
  return out;
}

std::string inspection_json(const recording::Inspection& found, const calibration::ProtocolFit* fit) {
  Json out{{"format", found.contents.format},
           {"columns", found.contents.names()},
           {"unread", found.contents.unread},
           {"samples", found.samples},
           {"begin_s", found.begin_s},
           {"end_s", found.end_s},
           {"rate_Hz", found.rate_Hz},
           {"time_step_jitter", found.jitter},
           {"duplicate_times", found.duplicate_times},
           {"gap_count", found.gap_count},
           {"gaps_s", gaps_json(found)},
           {"channels", channels_json(found)},
           {"times", clocks_json(found)},
           {"resampled", found.resampled},
           {"raw_columns", columns_json(found)},
           {"infinite", infinite_json(found)},
           {"missing", names_json(found.missing)},
           {"helpful", names_json(found.helpful)},
           {"proposed_map", map_json(found.proposal)}};
  if (fit != nullptr) out["protocol"] = protocol_json(*fit);
  out["proposed_channel_map"] = recording::written(found.proposal, found.remarks, found.missing);
  return json_text(out);
}

}  // namespace spoolflow::apps
