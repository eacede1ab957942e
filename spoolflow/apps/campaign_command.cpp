#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/rig/bench/recording_file.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::apps {
namespace {

void store(const std::filesystem::path& folder, const rig::CampaignItem& item, const rig::BenchRun& run,
           const rig::Simulation& simulation) {
  Outputs outputs;
  rig::write_recording(outputs.open(folder / item.file).stream(), simulation.recording, run);
  if (simulation.truth.size() > 0)
    rig::write_truth(outputs.open(folder / "truth" / item.file).stream(), simulation.truth);
  outputs.commit();
}

/// An earlier campaign of the rig is replaced, other files are not.
void refuse_to_replace(const std::filesystem::path& folder, const std::vector<rig::CampaignItem>& items) {
  if (rig::is_virtual_campaign(folder / "campaign.toml")) return;
  std::vector<std::string> names{"campaign.toml"};
  for (const rig::CampaignItem& item : items) {
    names.push_back(item.file);
    names.push_back("truth/" + item.file);
  }
  keep_what_is_there(folder, names, "campaign of the virtual rig");
}

}  // namespace

void campaign(const CampaignArguments& arguments) {
  const std::filesystem::path folder = arguments.folder;
  rig::ValveAndCampaign asked = rig::read_valve_and_campaign(arguments.valve);
  if (!arguments.bench.empty())
    asked.campaign.bench = arguments.bench == "flow" ? rig::CampaignBench::flow : rig::CampaignBench::force;
  const auto items = arguments.calibration_only ? rig::calibration_items(asked.valve, asked.campaign)
                                                : rig::campaign_items(asked.valve, asked.campaign);
  make_output_folder(folder);
  refuse_to_replace(folder, items);
  // First: it says that the recordings beside it may be made again.
  write_file(folder / "campaign.toml", {}, rig::campaign_text(asked.valve, items));
  if (arguments.with_truth) make_output_folder(folder / "truth");
  Progress progress("simulating the campaign", arguments.quiet);
  rig::run_campaign(items, {.store = [&](const auto& item, const auto& run,
                                         const auto& simulation) { store(folder, item, run, simulation); },
                            .progress = [&](double share) { progress.update(share); },
                            .workers = parallel::cores(),
                            .with_truth = arguments.with_truth});
}

void add_campaign_command(CLI::App& program) {
  CLI::App* command = add_command(
      program,
      {.name = "campaign",
       .purpose = "make a whole measuring campaign of a valve on the virtual test rig",
       .reads = "a valve file (TOML), or the name of a built-in valve: size_6, size_10, fast_dither, and with "
                "both directions "
                "whole_size_6, whole_differential",
       .writes = "a folder: bench tests, operating runs and campaign.toml, which spoolflow calibrate reads; an "
                 "earlier campaign of the rig is replaced, other files of these names are refused",
       .examples = {"spoolflow campaign examples/valves/size_6.toml -o campaign",
                    "spoolflow campaign size_10 --bench flow -o flow_bench"}});
  auto arguments = std::make_shared<CampaignArguments>();
  command->add_option("valve", arguments->valve, "valve file or name of a built-in valve")
      ->type_name("VALVE.toml")
      ->required();
  command->add_option("-o,--output", arguments->folder, "folder for the recordings")->type_name("DIR")->required();
  command->add_option("--bench", arguments->bench, "force: solenoid and axial-force rigs; flow: a flow bench alone")
      ->type_name("BENCH")
      ->check(CLI::IsMember({"force", "flow"}));
  command->add_flag("--calibration-only", arguments->calibration_only, "leave out the validation runs");
  command->add_flag("--truth", arguments->with_truth, "write flow, pressure and each force of every run to DIR/truth");
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { campaign(*arguments); });
}

}  // namespace spoolflow::apps
