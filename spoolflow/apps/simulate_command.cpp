#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/recording/written_tables/table_format.hpp"
#include "spoolflow/rig/bench/recording_file.hpp"
#include "spoolflow/rig/bench/scenario.hpp"

namespace spoolflow::apps {
void simulate(const SimulateArguments& arguments) {
  const rig::Scenario scenario = rig::read_scenario(arguments.scenario);
  Outputs outputs({arguments.scenario, scenario.valve_file});
  OutputFile& recording = outputs.open(arguments.recording);
  OutputFile* const truth = outputs.open_if_named(arguments.truth);
  for (const std::string& output : {arguments.recording, arguments.truth}) recording::refuse_other_than_csv(output);
  const rig::PlannedScenario planned = rig::plan(scenario);
  rig::Simulation simulation;
  {
    Progress progress("simulating", arguments.quiet);
    simulation =
        rig::simulate(planned.valve, planned.run, planned.valve.seed,
                      {.with_truth = truth != nullptr, .progress = [&](double share) { progress.update(share); }});
  }
  rig::write_recording(recording.stream(), simulation.recording, planned.run);
  if (truth != nullptr) rig::write_truth(truth->stream(), simulation.truth);
  outputs.commit();
}

void add_simulate_command(CLI::App& program) {
  CLI::App* command = add_command(
      program, {.name = "simulate",
                .purpose = "make one recording on the virtual test rig",
                .reads = "a scenario (TOML): the protocol, the valve, and what differs from them",
                .writes = "the recording as the rig's instruments show it (CSV), and the ground truth beside it",
                .examples = {"spoolflow simulate examples/scenarios/ramp.toml -o ramp.csv --truth ramp_truth.csv"}});
  auto arguments = std::make_shared<SimulateArguments>();
  command->add_option("scenario", arguments->scenario, "scenario file")->type_name("SCENARIO.toml")->required();
  command->add_option("-o,--output", arguments->recording, "where the recording goes; - is standard output")
      ->type_name("RECORDING.csv")
      ->required();
  command->add_option("--truth", arguments->truth, "where flow, pressure and each force go, free of any instrument")
      ->type_name("TRUTH.csv");
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { simulate(*arguments); });
}

}  // namespace spoolflow::apps
