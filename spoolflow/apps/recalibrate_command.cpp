/// `spoolflow recalibrate`: a unit's model moved on by what its machine knows of the oil that passed it.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal/input_kind.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/apps/work/readable_model.hpp"
#include "spoolflow/apps/work/recalibration.hpp"
#include "spoolflow/monitor/adaptation.hpp"
#include "spoolflow/recording/references.hpp"

namespace spoolflow::apps {
namespace {

/// What was done, and the states that the model can go back to.
void print_findings(const calibration::RecalibratedValve& valve) {
  constexpr double percent = 100, um_per_m = 1e6;
  for (const std::string& finding : valve.findings) say("{}\n", finding);
  say("\n{:>5} {:>12} {:>10} {:>15}\n", "state", "edge width", "friction", "position zero");
  const auto row = [&](std::size_t number, const model::WearState& state, const std::string& direction) {
    const std::string of = direction.empty() ? "" : fmt::format("   {}", model::flow_of(direction));
    say("{:>5} {:>+10.1f} % {:>+8.0f} % {:>+12.1f} um{}\n", number, percent * state.edge_width,
        percent * (state.friction_ratio - 1), um_per_m * state.position_zero_m, of);
  };
  row(0, {}, "");
  std::size_t number = 0;
  for (const model::Adaptation& each : valve.model.provenance.adaptations)
    if (each.wear) row(++number, *each.wear, each.direction);
  for (const std::string& drift : monitor::drift_texts(valve.model)) say("\ndrift {}\n", drift);
}

model::Adaptation how_from(const RecalibrateArguments& arguments) {
  return {std::string(tool_version()), model::creation_time(), model::sha256_of_file(arguments.model), {}, {}};
}

calibration::RecalibratedValve moved_on(const RecalibrateArguments& arguments, const model::Model& model,
                                        std::vector<recording::Reference> references) {
  const MachineOil from{{arguments.recordings.begin(), arguments.recordings.end()},
                        channels_from(arguments.channels),
                        std::move(references)};
  Progress progress("recalibrating", arguments.quiet);
  return recalibrated(model, from, how_from(arguments));
}

/// All files that are read.
std::vector<std::filesystem::path> inputs_of(const RecalibrateArguments& arguments,
                                             const std::vector<recording::Reference>& references) {
  std::vector<std::filesystem::path> out{arguments.model, arguments.channels, arguments.references};
  out.insert(out.end(), arguments.recordings.begin(), arguments.recordings.end());
  for (const recording::Reference& each : references) out.push_back(each.marks_file);
  return out;
}

void require_one_way(const RecalibrateArguments& arguments) {
  const bool back = arguments.back_to.has_value();
  if (back && (!arguments.references.empty() || !arguments.recordings.empty()))
    throw std::invalid_argument("recalibrate --back-to takes the model alone; leave out recordings and --references");
  if (!back && (arguments.references.empty() || arguments.recordings.empty())) {
    throw std::invalid_argument(
        "recalibrate needs recordings and --references REF.toml, or --back-to STATE to go back to an earlier state");
  }
}

}  // namespace

void recalibrate_model(const RecalibrateArguments& arguments) {
  require_one_way(arguments);
  std::vector<Input> settings;
  if (!arguments.references.empty()) settings.push_back({arguments.references, FileKind::settings, "--references "});
  refuse_other_kinds("recalibrate", arguments.model, arguments.recordings, settings);
  const model::Model model = model::read_model(arguments.model);
  calibration::require_movable(model);
  std::vector<recording::Reference> references;
  if (!arguments.back_to) references = recording::read_references(arguments.references);
  Outputs outputs(inputs_of(arguments, references));
  OutputFile& output = outputs.open(arguments.output);
  const calibration::RecalibratedValve valve =
      arguments.back_to ? calibration::gone_back(model, *arguments.back_to, how_from(arguments))
                        : moved_on(arguments, model, std::move(references));
  output.stream() << readable_text(valve.model, arguments.output);
  outputs.commit();
  for (const std::string& doubt : valve.doubts) say("spoolflow: doubt: {}\n", doubt);
  if (!arguments.quiet) print_findings(valve);
}

void add_recalibrate_command(CLI::App& program) {
  auto arguments = std::make_shared<RecalibrateArguments>();
  CLI::App* command = add_command(
      program,
      {"recalibrate",
       "move a valve's model on by what its machine knows of the oil that passed",
       "MODEL.json with an observer; recordings of the valve at work with time, position and current, of a whole valve "
       "both coils', better also voltage and oil temperature; and a file of [[reference]]: strokes of a cylinder, a "
       "pump, a flow meter, the closed valve",
       "the model as JSON, moved where the evidence pays for it, with what changed, by how much and why in its "
       "provenance; the same on standard error",
       {"spoolflow recalibrate valve_a.json monday.csv --references boom.toml -o valve_a_monday.json",
        "spoolflow recalibrate valve_a_monday.json --back-to 0 -o valve_a.json"}});
  command->add_option("model", arguments->model, "model file")->required();
  command->add_option("recordings", arguments->recordings, "recordings of the valve at work, oldest first");
  command->add_option("--references", arguments->references, "what the machine knows of its oil: tables [[reference]]")
      ->type_name("REF.toml");
  command->add_option("--back-to", arguments->back_to, "earlier state of the model, 0 for as calibrated")
      ->type_name("STATE")
      ->check(whole_number_from(0));
  command->add_option("-o,--output", arguments->output, "model file to write, - for standard output")
      ->type_name("MODEL2.json")
      ->required();
  add_channels_option(*command, arguments->channels);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { recalibrate_model(*arguments); });
}

}  // namespace spoolflow::apps
