/// `spoolflow calibrate`: from a campaign's bench recordings to a model file.
#include <algorithm>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/output_file.hpp"
#include "spoolflow/apps/progress.hpp"
#include "spoolflow/apps/suggestion.hpp"
#include "spoolflow/apps/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/calibration/calibrate.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/report/calibration/calibration_summary.hpp"
#include "spoolflow/report/validation/validation_report.hpp"
#include "spoolflow/sensor/band.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::apps {
namespace {

std::vector<std::filesystem::path> files_of(const recording::Campaign& campaign) {
  std::vector<std::filesystem::path> files{campaign.file};
  for (const recording::CampaignRecording& recording : campaign.recordings) files.push_back(recording.file);
  return files;
}

void print_summary(const model::Model& model) {
  if (model.whole()) {
    for (const char* direction : {"b", "a"}) {
      say("flow P to {}\n", *direction == 'a' ? "A" : "B");
      print_summary(model::of_direction(model, direction));
    }
    return;
  }
  const model::Condensed& condensed = model.condensed;
  say("{}: currents to {:.3g} A, positions to {:.3g} mm, pressure differences {:.3g} to {:.3g} bar\n", model.valve.name,
      condensed.current_A.upper, units::mm_from_m(condensed.position_m.upper),
      units::bar_from_Pa(condensed.pressure_difference_Pa.lower),
      units::bar_from_Pa(condensed.pressure_difference_Pa.upper));
  for (const report::SummaryLine& line : report::calibration_summary(model)) {
    say("  {:<40} {:>9} {:<6} usually {}{}\n", line.of, line.value, line.unit, line.usually,
        line.usual ? "" : "  <- UNUSUAL");
  }
  const model::Uniqueness& uniqueness = model.evidence.uniqueness;
  say("  flow force tells the flow above {:.3g} mm of opening{}\n", units::mm_from_m(uniqueness.blind_below_m),
      uniqueness.ambiguous_at_m.empty() ? ""
                                        : fmt::format(", but is ambiguous at {} positions (see the model's evidence)",
                                                      uniqueness.ambiguous_at_m.size()));
  if (model.observer && std::ranges::count(model.observer->defaults, model::each_edge_alone) > 0) {
    fmt::print(stderr,
               "  A and B were joined, and the load passes unequal flows over both edges: they are taken as alike, and "
               "the band is {:.2g} L/min wider to either side; measure one edge at a time to know\n",
               units::litre_per_minute_per_m3_per_s * sensor::flow_residual_factor *
                   model.observer->parameters.band.flow_residual_m3_per_s);
  }
}
/// Never a file that no command would read.
void write_readable(std::ostream& out, const model::Model& model, const std::string& file) {
  std::ostringstream text;
  model::write_model(text, model);
  try {
    (void)model::parse_model(text.str(), file);
  } catch (const model::ModelError& error) {
    throw calibration::CalibrationError(fmt::format(
        "the recordings make a model that cannot be ({}); nothing was written; look at their channels, signs "
        "and units",
        error.what()));
  }
  out << text.str();
}

}  // namespace

void calibrate(const CalibrateArguments& arguments) {
  refuse_other_kinds("calibrate", {{arguments.campaign, FileKind::settings}});
  const recording::Campaign campaign =
      recording::read_campaign(arguments.campaign, arguments.allow_outside ? recording::OutsideFiles::allowed
                                                                           : recording::OutsideFiles::refused);
  const report::ReaderUnits units(arguments.units);
  std::vector<std::filesystem::path> inputs = files_of(campaign);
  OutputFile output(arguments.model, inputs);
  std::optional<OutputFile> page;
  inputs.emplace_back(arguments.model);
  if (!arguments.report.empty()) page.emplace(arguments.report, inputs);
  model::Model model;
  {
    Progress progress("calibrating", arguments.quiet);
    model = calibration::calibrate(
        campaign, std::string(tool_version()),
        [&](const std::string& step, double share) {
          progress.task(step);
          progress.update(share);
        },
        arguments.despite_doubts ? calibration::Contradictions::noted : calibration::Contradictions::refused);
  }
  for (const std::string& doubt : model.provenance.doubts) say("spoolflow: doubt: {}\n", doubt);
  write_readable(output.stream(), model, arguments.model);
  if (page) report::write_calibration_report(page->stream(), model, units);
  commit_together({&output, page ? &*page : nullptr});
  if (!arguments.quiet) print_summary(model);
}

void add_calibrate_command(CLI::App& program) {
  auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command = add_command(
      program,
      {"calibrate",
       "make a valve's model from the bench recordings of a campaign",
       "CAMPAIGN.toml, which names the valve, the oil and the recordings with their protocols: one `spring`, one "
       "`solenoid_force_map`, `axial_force_map` at one or several oil temperatures; of a whole valve all of them in "
       "each direction, with A and B joined or one edge at a time",
       "the model as JSON: maps, their ranges and residuals, and where they came from",
       {"spoolflow calibrate valve_a/campaign.toml -o valve_a.json"}});
  command->add_option("campaign", arguments->campaign, "campaign file (TOML)")->required();
  command->add_option("-o,--output", arguments->model, "model file to write; - for standard output")
      ->type_name("MODEL.json")
      ->required();
  command->add_option("--report", arguments->report, "HTML page to write about the calibration")
      ->type_name("PAGE.html");
  command->add_flag("--allow-outside", arguments->allow_outside,
                    "read recordings that the campaign names outside its own folder, too");
  command->add_flag("--despite-doubts", arguments->despite_doubts,
                    "make a model of recordings that contradict each other or physics, too");
  add_units(*command, arguments->units);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { calibrate(*arguments); });
}

}  // namespace spoolflow::apps
