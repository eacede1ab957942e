/// `spoolflow monitor`: the condition of a valve from recordings of its operation.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <numeric>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/elsewhere.hpp"
#include "spoolflow/apps/terminal/input_kind.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/apps/work/corrected_model.hpp"
#include "spoolflow/apps/work/monitored_recording.hpp"
#include "spoolflow/apps/work/notes.hpp"
#include "spoolflow/monitor/adaptation.hpp"
#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/report/monitor/monitor_report.hpp"

namespace spoolflow::apps {
namespace {

void go_on(monitor::Monitor& watch, const Watched& from) {
  if (!watch.set_state(from.state)) throw std::runtime_error("the state of a watch is of another version");
}

void write_corrected(std::ostream& out, const MonitorArguments& arguments, Monitored from,
                     const monitor::Monitor& watch) {
  from.model_sha256 = model::sha256_of_file(arguments.model);
  from.recordings.assign(arguments.recordings.begin(), arguments.recordings.end());
  from.tool_version = std::string(tool_version());
  model::write_model(out, corrected_model(from, watch));
}

void print_condition(const monitor::Monitor& watch, const model::Model& model) {
  print("NE 107: {}\n", monitor::name(watch.condition()));
  for (const monitor::Cause& cause : watch.causes())
    print("{:<20} odds {:.3g} to 1\n", monitor::name(cause.fault), cause.odds);
  print("\n{:<32} {:>12} {:>12} {:>12} {:<4} {}\n", "indicator", "value", "+- 95 %", "baseline", "unit", "state");
  for (const monitor::Indicator& each : watch.indicators()) {
    print("{:<32} {:>12.5g} {:>12.3g} {:>12.5g} {:<4} {}\n", each.name, each.value, each.uncertainty_95, each.baseline,
          each.unit, monitor::name(each.state));
  }
  for (const std::string& drift : monitor::drift_texts(model)) print("\ndrift {}\n", drift);
}

/// What is said of recordings beside the condition.
struct Remarks {
  std::vector<std::string> as_read, doubts;

  void add(const std::string& recording, const WatchedRecording& watched) {
    if (!watched.as_read.empty()) as_read.push_back(fmt::format("{}: {}", recording, watched.as_read));
    for (const plausibility::Finding& finding : watched.findings) doubts.push_back(doubt_text(finding));
  }
};

/// "good" of a valve of which nothing was judged says only that no status speaks against it.
void say_what_was_not_judged(const monitor::Monitor& watch) {
  if (watch.judged_windows() > 0) return;
  say("spoolflow: note: friction, edges, springs, turns and position zero were not judged: {:.3g} s of operation "
      "hold no cycle of break-aways or of sliding below 3 mm/s, both ways, between 3 and 90 % of the stroke; give "
      "longer or slower recordings\n",
      watch.usage().driven_s);
}

void say_remarks(const Remarks& remarks, const monitor::Monitor& watch) {
  for (const std::string& note : remarks.as_read) say("{}\n", note);
  for (const std::string& doubt : remarks.doubts) say_line(doubt);
  say_what_was_not_judged(watch);
}

void refuse_unusable(const MonitorArguments& arguments) {
  if (!arguments.adapt.empty() && std::ranges::count(arguments.recordings, "-") > 0)
    throw model::ModelError("-: a corrected model names its recordings by their checksums; --adapt needs files");
  refuse_other_kinds("monitor", arguments.model, arguments.recordings);
  refuse_given_twice(arguments.recordings);
}

}  // namespace

void monitor_recordings(const MonitorArguments& arguments) {
  refuse_unusable(arguments);
  const model::Model model = model::read_model(arguments.model);
  if (!arguments.quiet) say_note(type_note(model, arguments.model));
  std::vector<std::filesystem::path> inputs(arguments.recordings.begin(), arguments.recordings.end());
  inputs.insert(inputs.end(), {arguments.model, arguments.channels, arguments.baseline});
  const recording::ChannelMap channels = channels_from(arguments.channels);
  monitor::Monitor watch(model, {arguments.false_alarms_per_year}, read_baseline(arguments.baseline));
  const report::ReaderUnits units(arguments.units);
  Outputs outputs(inputs);
  OutputFile* const page = outputs.open_if_named(arguments.report);
  OutputFile* const json = outputs.open_if_named(arguments.json);
  OutputFile* const corrected = outputs.open_if_named(arguments.adapt);
  std::function<Watched(const std::string&)> watched_elsewhere;
  if (!arguments.fleet.empty()) watched_elsewhere = elsewhere().monitor(arguments);
  std::vector<std::uint64_t> samples;
  std::vector<report::MonitoredRun> runs;
  std::vector<report::TrendPoint> trend;
  BandWatch band;
  Remarks remarks;
  const auto total = static_cast<double>(arguments.recordings.size());
  {
    Progress progress("monitoring", arguments.quiet);
    for (const std::string& recording : arguments.recordings) {
      const auto before = static_cast<double>(runs.size());
      if (watched_elsewhere) {
        Watched watched = watched_elsewhere(recording);
        go_on(watch, watched);
        trend = std::move(watched.trend);
        band = BandWatch(watched.band);
        progress.update((before + 1) / total);
      } else {
        const auto show = [&](std::optional<double> share) {
          if (share) progress.update((before + *share) / total);
        };
        remarks.add(recording, monitor_recording(model, recording, channels, watch, trend, band, show));
      }
      runs.push_back(
          {std::filesystem::path(recording).stem().string(), watch.condition(), watch.causes(), watch.indicators()});
      samples.push_back(watch.usage().samples - std::accumulate(samples.begin(), samples.end(), std::uint64_t{0}));
    }
  }
  say_remarks(remarks, watch);
  if (corrected != nullptr) write_corrected(corrected->stream(), arguments, {model, {}, {}, samples, {}}, watch);
  if (page != nullptr) report::write_monitor_report(page->stream(), model, watch, runs, trend, units);
  if (json != nullptr) report::write_monitor_json(json->stream(), model, watch, runs, band.figures());
  outputs.commit();
  if (arguments.json != "-" && arguments.report != "-" && arguments.adapt != "-") print_condition(watch, model);
}

void add_monitor_command(CLI::App& program) {
  auto arguments = std::make_shared<MonitorArguments>();
  CLI::App* command = add_command(
      program,
      {"monitor",
       "judge the condition of a valve from recordings of its operation",
       "MODEL.json with an observer, and recordings in the order in which they were made, with time, current and "
       "position, better also voltage and oil temperature",
       "indicators, causes and the sign of NE 107 as JSON, which is a baseline for later runs, too; a summary on "
       "standard output",
       {"spoolflow monitor valve_a.json monday.csv tuesday.csv --json condition.json",
        "spoolflow monitor valve_a.json friday.csv --baseline condition.json --json friday.json",
        "spoolflow monitor valve_a.json week*.csv --adapt valve_a_as_worn.json"}});
  command->add_option("model", arguments->model, "model file")->required();
  command->add_option("recordings", arguments->recordings, "recordings of the valve at work, oldest first")->required();
  command
      ->add_option("--baseline", arguments->baseline,
                   "what --json wrote of healthy runs; else the model is the reference")
      ->type_name("BASE.json");
  command->add_option("--report", arguments->report, "HTML report to write")->type_name("REPORT.html");
  command->add_option("--json", arguments->json, "condition to write as JSON; - for standard output")
      ->type_name("OUT.json");
  command->add_option("--adapt", arguments->adapt, "corrected model to write: what is raised as it was found")
      ->type_name("MODEL2.json");
  add_channels_option(*command, arguments->channels);
  command
      ->add_option("--false-alarms-per-year", arguments->false_alarms_per_year,
                   "wanted at most over all indicators, of a valve at work day and night")
      ->check(between(1e-6, 1e4))
      ->capture_default_str();
  add_fleet_option(*command, arguments->fleet, "file by file");
  add_units(*command, arguments->units);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { monitor_recordings(*arguments); });
}

}  // namespace spoolflow::apps
