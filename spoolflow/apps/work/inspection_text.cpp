#include "spoolflow/apps/work/inspection_text.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

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
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

/// Columns that the map does not name.
std::vector<std::string> columns_left_out(const recording::ChannelMap& map, const recording::Inspection& found) {
  std::vector<std::string> out;
  for (const std::string& column : found.contents.columns) {
    const auto names_it = [&](const auto& entry) { return entry.second.column == column; };
    if (std::none_of(map.sources.begin(), map.sources.end(), names_it)) out.push_back(column);
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

void add_text(std::string& out, const InspectedFile& inspected) {
  const recording::Inspection& found = inspected.found;
  add(out, "{}: {}, {} columns: {}\n", inspected.file, found.contents.format, found.contents.columns.size(),
      joined(found.contents.columns));
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
}

void add_names_json(std::string& out, const char* key, const std::vector<recording::Channel>& channels) {
  add(out, " \"{}\": [", key);
  for (const recording::Channel& channel : channels)
    add(out, "{}\"{}\"", &channel == channels.data() ? "" : ", ", recording::name(channel));
  add(out, "],\n");
}

void add_column_json(std::string& out, const recording::Inspection& found) {
  add(out, " \"raw_columns\": [");
  for (const recording::InspectedColumn& column : found.columns) {
    add(out,
        "{}\n  {{\"column\": {}, \"unit\": {}, \"lowest\": {}, \"highest\": {}, \"channel\": {}, \"guessed\": {}, "
        "\"why\": {}}}",
        &column == found.columns.data() ? "" : ",", json_text(column.name), json_text(column.unit),
        json_number(column.lowest), json_number(column.highest),
        column.channel ? json_text(std::string(recording::name(*column.channel))) : "null", column.guessed,
        json_text(column.why));
  }
  add(out, "\n ],\n");
  add(out, " \"infinite\": [");
  for (const auto& [column, infinite] : found.infinite) {
    add(out, "{}\n  {{\"column\": {}, \"count\": {}, \"first_sample\": {}, \"negative\": {}}}",
        column == found.infinite.begin()->first ? "" : ",", json_text(column), infinite.count, infinite.first,
        infinite.value < 0);
  }
  add(out, "\n ],\n");
  add_names_json(out, "missing", found.missing);
  add_names_json(out, "helpful", found.helpful);
}

void add_clocks_json(std::string& out, const recording::Inspection& found) {
  add(out, " \"times\": [");
  for (const recording::InspectedClock& clock : found.clocks) {
    add(out,
        "{}\n  {{\"column\": {}, \"samples\": {}, \"rate_Hz\": {}, \"begin_s\": {}, \"end_s\": {}, \"leads\": {}, "
        "\"fault\": {}, \"columns\": [",
        &clock == found.clocks.data() ? "" : ",", json_text(clock.time), clock.samples, json_number(clock.rate_Hz),
        json_number(clock.begin_s), json_number(clock.end_s), clock.leads, json_text(clock.fault));
    for (const std::string& column : clock.columns)
      add(out, "{}{}", &column == clock.columns.data() ? "" : ", ", json_text(column));
    add(out, "]}}");
  }
  add(out, "\n ],\n \"resampled\": {},\n", json_text(found.resampled));
}

/// The proposal as values; the same as TOML stands in proposed_channel_map.
void add_map_json(std::string& out, const recording::ChannelMap& map) {
  add(out, " \"proposed_map\": {{");
  bool first = true;
  for (const auto& [channel, source] : map.sources) {
    add(out, "{}\n  {}: {{\"column\": {}, \"unit\": {}", std::exchange(first, false) ? "" : ",",
        json_text(recording::name(channel)), json_text(source.column), json_text(source.unit));
    if (source.scale != 1.0) add(out, ", \"scale\": {}", json_number(source.scale));
    if (source.offset != 0.0) add(out, ", \"offset\": {}", json_number(source.offset));
    if (source.to) add(out, ", \"to\": {}", json_text(*source.to));
    add(out, "}}");
  }
  add(out, "\n }},\n");
}

void add_json(std::string& out, const recording::Inspection& found, const std::string& more) {
  add(out, "{{\n \"format\": {},\n \"columns\": [", json_text(found.contents.format));
  for (const std::string& column : found.contents.columns) {
    add(out, "{}{}", &column == found.contents.columns.data() ? "" : ", ", json_text(column));
  }
  add(out, "],\n \"unread\": [");
  for (const std::string& what : found.contents.unread) {
    add(out, "{}{}", &what == found.contents.unread.data() ? "" : ", ", json_text(what));
  }
  add(out, "],\n \"samples\": {},\n \"begin_s\": {},\n \"end_s\": {},\n \"rate_Hz\": {},\n \"time_step_jitter\": {},\n",
      found.samples, json_number(found.begin_s), json_number(found.end_s), json_number(found.rate_Hz),
      json_number(found.jitter));
  add(out, " \"duplicate_times\": {},\n \"gap_count\": {},\n \"gaps_s\": [", found.duplicate_times, found.gap_count);
  for (const recording::Gap& gap : found.gaps) {
    add(out, "{}[{}, {}]", &gap == found.gaps.data() ? "" : ", ", json_number(gap.from_s), json_number(gap.to_s));
  }
  add(out, "],\n \"channels\": [");
  for (const recording::ChannelSummary& summary : found.channels) {
    const units::Unit unit = recording::usual_unit(summary.channel);
    const auto shown = [&](double value) { return json_number(in_unit(unit, value)); };
    add(out,
        "{}\n  {{\"channel\": \"{}\", \"unit\": \"{}\", \"lowest\": {}, \"mean\": {}, \"highest\": {}, \"missing\": "
        "{}, "
        "\"clipped_share\": {}}}",
        &summary == found.channels.data() ? "" : ",", recording::name(summary.channel), unit.name,
        shown(summary.lowest), shown(summary.mean), shown(summary.highest), summary.missing,
        json_number(summary.clipped));
  }
  add(out, "\n ],\n");
  add_clocks_json(out, found);
  add_column_json(out, found);
  add_map_json(out, found.proposal);
  out += more;
  add(out, " \"proposed_channel_map\": {}\n}}\n",
      json_text(recording::written(found.proposal, found.remarks, found.missing)));
}

}  // namespace

std::string inspection_text(const InspectedFile& inspected) {
  std::string out;
  add_text(out, inspected);
  return out;
}

std::string inspection_json(const recording::Inspection& found, const std::string& more) {
  std::string out;
  add_json(out, found, more);
  return out;
}

}  // namespace spoolflow::apps
