/// `spoolflow inspect`: what a recording holds, and a channel map for foreign column names.
#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/progress.hpp"
#include "spoolflow/apps/suggestion.hpp"
#include "spoolflow/apps/terminal_text.hpp"
#include "spoolflow/recording/inspection.hpp"
#include "spoolflow/recording/proposal.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::apps {
namespace {

struct InspectArguments {
  std::string file;
  std::string channels;
  double stroke_mm = 0;
  bool json = false;
  bool quiet = false;
};

/// The unit that people read a channel in.
struct ShownUnit {
  const char* name;
  double per_SI;
  double offset;
};

ShownUnit shown_unit(recording::Channel channel) {
  using units::Dimension;
  switch (recording::dimension(channel)) {
    case Dimension::time:
      return {"s", 1, 0};
    case Dimension::current:
      return {"A", 1, 0};
    case Dimension::voltage:
      return {"V", 1, 0};
    case Dimension::length:
      return {"mm", units::millimetre_per_metre, 0};
    case Dimension::ratio:
      if (channel == recording::Channel::test) return {"", 1, 0};
      return {"percent", 100, 0};
    case Dimension::force:
      return {"N", 1, 0};
    case Dimension::pressure:
      return {"bar", 1 / units::pascal_per_bar, 0};
    case Dimension::temperature:
      return {"C", 1, -units::kelvin_at_0_degC};
    case Dimension::volume_flow:
      return {"L/min", units::litre_per_minute_per_m3_per_s, 0};
    default:
      break;
  }
  return {"", 1, 0};
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
void print_columns(const recording::Inspection& found) {
  const auto own = [](const recording::InspectedColumn& column) { return column.why == "its own name"; };
  if (std::ranges::all_of(found.columns, own)) return;
  print("{:<24} {:<8} {:>12} {:>12}  {}\n", "column", "unit", "lowest", "highest", "taken as");
  for (const recording::InspectedColumn& column : found.columns) {
    const std::string_view channel = column.channel ? recording::name(*column.channel) : "";
    const std::string taken = column.channel
                                  ? fmt::format("{}{}: {}", channel, column.guessed ? ", a guess" : "", column.why)
                              : column.times_others ? column.why
                              : column.why.empty()  ? "not used"
                                                    : "not used; " + column.why;
    print("{:<24} {:<8} {:>12.5g} {:>12.5g}  {}\n", column.name, column.unit.empty() ? "?" : column.unit, column.lowest,
          column.highest, taken);
  }
  print("\n");
}

void print_missing(const recording::Inspection& found) {
  if (!found.missing.empty()) print("Needed and not found: {}\n", names_of(found.missing));
  if (!found.helpful.empty()) {
    print("Not found, and helpful: {} (voltage and oil temperature narrow the band; validate needs a flow)\n",
          names_of(found.helpful));
  }
  std::vector<std::string> unused;
  for (const recording::InspectedColumn& column : found.columns) {
    if (!column.channel && !column.times_others) unused.push_back(column.name);
  }
  if (!unused.empty()) print("Columns that are not used: {}\n", joined(unused));
  if (!found.missing.empty() || !found.helpful.empty() || !unused.empty()) print("\n");
}

void print_proposal(const recording::Inspection& found) {
  print_columns(found);
  print_missing(found);
  if (found.proposal.sources.empty()) {
    print(
        "No column is known by its name or its numbers; write a channel map by hand (see docs/formats/channels.md).\n");
    return;
  }
  const std::string map = recording::written(found.proposal, found.remarks, found.missing);
  const bool asks = map.find("\"?\"") != std::string::npos || !found.remarks.empty();
  print_text(fmt::format("Proposed channel map ({}, then give it with --channels MAP.toml):\n\n{}",
                         asks ? "fill in each \"?\" and check what is called a guess" : "check it",
                         terminal_lines(map)));
}

/// The times of a file whose columns are of several, and what becomes of them.
void print_clocks(const recording::Inspection& found) {
  if (found.clocks.empty()) return;
  print("\n{:<24} {:>10} {:>10} {:>12} {:>12}  {}\n", "time", "samples", "Hz", "from s", "to s", "columns");
  for (const recording::InspectedClock& clock : found.clocks) {
    print("{:<24} {:>10} {:>10.4g} {:>12.6g} {:>12.6g}  {}\n", clock.time.empty() ? "(even steps)" : clock.time,
          clock.samples, clock.rate_Hz, clock.begin_s, clock.end_s,
          joined(clock.columns) + (clock.leads ? " (the others are brought onto this time)" : ""));
    if (!clock.fault.empty()) print("  cannot be used: {}\n", clock.fault);
  }
  if (!found.resampled.empty()) print("{}\n", found.resampled);
}

/// `map`: the one that the file was read with; null: none.
void print_text(const InspectArguments& arguments, const recording::ChannelMap* map,
                const recording::Inspection& found) {
  print("{}: {}, {} columns: {}\n", arguments.file == "-" ? "standard input" : arguments.file, found.contents.format,
        found.contents.columns.size(), joined(found.contents.columns));
  print_clocks(found);
  if (!found.channels.empty()) {
    print("{} samples from {:.6g} to {:.6g} s ({:.6g} s), {:.6g} Hz", found.samples, found.begin_s, found.end_s,
          found.end_s - found.begin_s, found.rate_Hz);
    if (found.jitter > 0.01) print(", time steps vary by up to {:.0f} %", 100 * found.jitter);
    print("\n");
    if (found.duplicate_times > 0) print("{} samples repeat the time stamp before them\n", found.duplicate_times);
    if (found.gap_count > 0) {
      print("{} gaps in time", found.gap_count);
      for (const recording::Gap& gap : found.gaps)
        print("{} {:.6g} to {:.6g} s", &gap == found.gaps.data() ? ":" : ",", gap.from_s, gap.to_s);
      print("{}\n", found.gap_count > found.gaps.size() ? ", …" : "");
    }
    print("\n{:<24} {:<8} {:>12} {:>12} {:>12} {:>9} {:>9}\n", "channel", "unit", "lowest", "mean", "highest",
          "missing", "clipped");
    for (const recording::ChannelSummary& summary : found.channels) {
      const ShownUnit unit = shown_unit(summary.channel);
      const auto shown = [&](double value) { return value * unit.per_SI + unit.offset; };
      print("{:<24} {:<8} {:>12.5g} {:>12.5g} {:>12.5g} {:>9} {:>8.2f}%\n", recording::name(summary.channel), unit.name,
            shown(summary.lowest), shown(summary.mean), shown(summary.highest), summary.missing, 100 * summary.clipped);
    }
    print("\n");
  }
  if (map == nullptr) {
    print_proposal(found);
  } else if (const std::vector<std::string> columns = columns_left_out(*map, found); columns.empty()) {
    print("Read with {}, which names every column.\n", arguments.channels);
  } else {
    print("Read with {}; columns that it does not name: {}\n", arguments.channels, joined(columns));
  }
}

void print_names_json(const char* key, const std::vector<recording::Channel>& channels) {
  print(" \"{}\": [", key);
  for (const recording::Channel& channel : channels)
    print("{}\"{}\"", &channel == channels.data() ? "" : ", ", recording::name(channel));
  print("],\n");
}

void print_column_json(const recording::Inspection& found) {
  print(" \"raw_columns\": [");
  for (const recording::InspectedColumn& column : found.columns) {
    print(
        "{}\n  {{\"column\": {}, \"unit\": {}, \"lowest\": {}, \"highest\": {}, \"channel\": {}, \"guessed\": {}, "
        "\"why\": {}}}",
        &column == found.columns.data() ? "" : ",", json_text(column.name), json_text(column.unit),
        json_number(column.lowest), json_number(column.highest),
        column.channel ? json_text(std::string(recording::name(*column.channel))) : "null", column.guessed,
        json_text(column.why));
  }
  print("\n ],\n");
  print_names_json("missing", found.missing);
  print_names_json("helpful", found.helpful);
}

void print_clocks_json(const recording::Inspection& found) {
  print(" \"times\": [");
  for (const recording::InspectedClock& clock : found.clocks) {
    print(
        "{}\n  {{\"column\": {}, \"samples\": {}, \"rate_Hz\": {}, \"begin_s\": {}, \"end_s\": {}, \"leads\": {}, "
        "\"fault\": {}, \"columns\": [",
        &clock == found.clocks.data() ? "" : ",", json_text(clock.time), clock.samples, json_number(clock.rate_Hz),
        json_number(clock.begin_s), json_number(clock.end_s), clock.leads, json_text(clock.fault));
    for (const std::string& column : clock.columns)
      print("{}{}", &column == clock.columns.data() ? "" : ", ", json_text(column));
    print("]}}");
  }
  print("\n ],\n \"resampled\": {},\n", json_text(found.resampled));
}

void print_json(const recording::Inspection& found) {
  print("{{\n \"format\": {},\n \"columns\": [", json_text(found.contents.format));
  for (const std::string& column : found.contents.columns) {
    print("{}{}", &column == found.contents.columns.data() ? "" : ", ", json_text(column));
  }
  print("],\n \"samples\": {},\n \"begin_s\": {},\n \"end_s\": {},\n \"rate_Hz\": {},\n \"time_step_jitter\": {},\n",
        found.samples, json_number(found.begin_s), json_number(found.end_s), json_number(found.rate_Hz),
        json_number(found.jitter));
  print(" \"duplicate_times\": {},\n \"gap_count\": {},\n \"gaps_s\": [", found.duplicate_times, found.gap_count);
  for (const recording::Gap& gap : found.gaps) {
    print("{}[{}, {}]", &gap == found.gaps.data() ? "" : ", ", json_number(gap.from_s), json_number(gap.to_s));
  }
  print("],\n \"channels\": [");
  for (const recording::ChannelSummary& summary : found.channels) {
    const ShownUnit unit = shown_unit(summary.channel);
    const auto shown = [&](double value) { return json_number(value * unit.per_SI + unit.offset); };
    print(
        "{}\n  {{\"channel\": \"{}\", \"unit\": \"{}\", \"lowest\": {}, \"mean\": {}, \"highest\": {}, \"missing\": "
        "{}, "
        "\"clipped_share\": {}}}",
        &summary == found.channels.data() ? "" : ",", recording::name(summary.channel), unit.name,
        shown(summary.lowest), shown(summary.mean), shown(summary.highest), summary.missing,
        json_number(summary.clipped));
  }
  print("\n ],\n");
  print_clocks_json(found);
  print_column_json(found);
  print(" \"proposed_channel_map\": {}\n}}\n",
        json_text(recording::written(found.proposal, found.remarks, found.missing)));
}

void inspect(const InspectArguments& arguments) {
  if (inspect_image(arguments.file, arguments.json)) return;
  refuse_other_kinds("inspect", {{arguments.file, FileKind::recording}});
  recording::ReadOptions options;
  if (!arguments.channels.empty()) options.channels = recording::read_channel_map(arguments.channels);
  if (arguments.stroke_mm > 0) options.stroke_m = units::m_from_mm(arguments.stroke_mm);
  recording::Inspection found;
  {
    Progress progress("inspecting", arguments.quiet);
    found = recording::inspect(arguments.file, options,
                               [&](std::optional<double> share, std::uint64_t rows) { progress.update(share, rows); });
  }
  if (arguments.json) {
    print_json(found);
  } else {
    print_text(arguments, arguments.channels.empty() ? nullptr : &options.channels, found);
  }
}

}  // namespace

void add_inspect_command(CLI::App& program) {
  auto arguments = std::make_shared<InspectArguments>();
  CLI::App* command = add_command(
      program,
      {"inspect",
       "show what a recording, or a flash page of parameters, holds",
       "a recording: CSV (comma, semicolon or tab; decimal comma; - for CSV from standard input), MATLAB v5 or v7.3, "
       "HDF5, TDMS, MDF 4; or parameters from `spoolflow export parameters`",
       "on standard output: channels, units, rate, gaps, clipping, what each column could be by its name and its "
       "numbers, what is missing, and a channel map to paste. Of parameters: valve, model, versions, tables, whether "
       "the "
       "sensor takes them; where it does not, the exit status is 2",
       {"spoolflow inspect run.csv", "spoolflow inspect rig.mat --channels map.toml", "spoolflow inspect valve.bin"}});
  command->add_option("file", arguments->file, "recording, or parameters")->required();
  command
      ->add_option("--channels", arguments->channels, "channel map (TOML) for files with other column names or units")
      ->type_name("MAP.toml");
  command->add_option("--stroke-mm", arguments->stroke_mm, "the valve's stroke, for positions in percent")
      ->type_name("MM")
      ->check(CLI::Range(0.01, 50.0));
  command->add_flag("--json", arguments->json, "print JSON instead of text");
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { inspect(*arguments); });
}

}  // namespace spoolflow::apps
