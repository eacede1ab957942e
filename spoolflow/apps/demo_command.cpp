/// `spoolflow demo`: the whole way from a valve to a report, on the virtual test rig.
#include <algorithm>
#include <array>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/demo_files.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/report/text/reader_units.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::apps {
namespace {

/// The valves that are shown, each with the recording of its campaign that calibration reads as well.
struct Shown {
  const char* valve;
  const char* ramps;
};
constexpr std::array<Shown, 2> shown_valves{
    {{"whole_size_6", "campaign/both_ramps_60bar.csv"}, {"size_6", "campaign/ramp_60bar.csv"}}};

struct DemoArguments {
  std::string valve = shown_valves.front().valve;
  std::string folder = "spoolflow_demo";
  std::vector<std::string> units;
  bool quiet = false;
};

/// An earlier demonstration, which its campaign shows, is replaced, other files are not.
void refuse_to_replace(const std::filesystem::path& folder) {
  if (rig::is_virtual_campaign(folder / "campaign" / "campaign.toml")) return;
  keep_what_is_there(folder,
                     {"valve.toml", "duty_cycle.toml", "duty_cycle.csv", "duty_cycle_truth.csv", "model.json",
                      "calibration.html", "estimate.csv", "report.html", "metrics.json"},
                     "demonstration");
}

void demo(const DemoArguments& arguments) {
  const report::ReaderUnits refused_early(arguments.units);  // before minutes of simulation
  const std::filesystem::path folder = arguments.folder;
  const auto in_folder = [&](const char* name) { return (folder / name).string(); };
  make_output_folder(folder);
  refuse_to_replace(folder);
  const std::string from = arguments.valve + "/";
  for (const EmbeddedFile& file : demo_files()) {
    if (file.name.starts_with(from)) write_file(folder / file.name.substr(from.size()), {}, file.bytes);
  }
  const Shown& valve =
      *std::ranges::find_if(shown_valves, [&](const Shown& each) { return each.valve == arguments.valve; });
  const std::vector<std::string> runs{in_folder(valve.ramps), in_folder("duty_cycle.csv")};
  campaign({.valve = in_folder("valve.toml"),
            .folder = in_folder("campaign"),
            .calibration_only = true,
            .quiet = arguments.quiet});
  simulate({.scenario = in_folder("duty_cycle.toml"),
            .recording = runs.back(),
            .truth = in_folder("duty_cycle_truth.csv"),
            .quiet = arguments.quiet});
  calibrate({.campaigns = {in_folder("campaign/campaign.toml")},
             .model = in_folder("model.json"),
             .report = in_folder("calibration.html"),
             .units = arguments.units,
             .quiet = arguments.quiet});
  estimate({.model = in_folder("model.json"),
            .recordings = {runs.back()},
            .output = in_folder("estimate.csv"),
            .estimator = {},
            .channels = {},
            .quiet = arguments.quiet});
  validate({.model = in_folder("model.json"),
            .recordings = runs,
            .report = in_folder("report.html"),
            .json = in_folder("metrics.json"),
            .channels = {},
            .units = arguments.units,
            .quiet = arguments.quiet});
  print(
      "\nThe recordings are simulated by the virtual test rig; they, the model and the estimate are in {0}. The same "
      "step "
      "by step:\n"
      "  spoolflow campaign {0}/valve.toml -o {0}/campaign --calibration-only\n"
      "  spoolflow simulate {0}/duty_cycle.toml -o {1}\n"
      "  spoolflow calibrate {0}/campaign/campaign.toml -o {0}/model.json\n"
      "  spoolflow estimate {0}/model.json {1} -o {0}/estimate.csv\n"
      "  spoolflow validate {0}/model.json {2} {1} --report {0}/report.html --json {0}/metrics.json\n"
      "Without force sensors, from a flow bench alone, the first step is\n"
      "  spoolflow campaign {0}/valve.toml --bench flow -o {0}/flow_bench --calibration-only\n\n{3}\n",
      folder.string(), runs.back(), runs.front(), in_folder("report.html"));
}

}  // namespace

void add_demo_command(CLI::App& program) {
  auto arguments = std::make_shared<DemoArguments>();
  CLI::App* command =
      add_command(program, {"demo",
                            "from a valve on the virtual test rig to a report, with no input files",
                            "nothing: valves and runs are inside the program",
                            "a folder with valve.toml and its campaign, duty_cycle.csv, model.json, estimate.csv, "
                            "metrics.json, calibration.html and report.html; "
                            "the path of the report comes last on standard output",
                            {"spoolflow demo -o demo", "spoolflow demo size_6 -o one_direction"}});
  std::vector<std::string> valves;
  for (const Shown& each : shown_valves) valves.emplace_back(each.valve);
  command->add_option("valve", arguments->valve, "whole_size_6: both directions of flow; size_6: one")
      ->type_name("VALVE")
      ->check(CLI::IsMember(valves))
      ->capture_default_str();
  command->add_option("-o,--output", arguments->folder, "folder to write")->type_name("DIR")->capture_default_str();
  add_units(*command, arguments->units);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { demo(*arguments); });
}

}  // namespace spoolflow::apps
