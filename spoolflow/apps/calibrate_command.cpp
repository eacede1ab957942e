/// `spoolflow calibrate`: from a campaign's bench recordings to a model file.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <functional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/output_file.hpp"
#include "addons/fleet/pieces/fleet_work.hpp"
#include "addons/fleet/pieces/piece_kinds.hpp"
#include "spoolflow/apps/progress.hpp"
#include "spoolflow/apps/suggestion.hpp"
#include "spoolflow/apps/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/apps/work/readable_model.hpp"
#include "spoolflow/calibration/calibrate.hpp"
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

/// One campaign, and what is made of it.
struct CalibrationTask {
  std::string campaign;
  std::string model;   ///< to write
  std::string report;  ///< likewise; empty: none
};

recording::Campaign read_campaign(const CalibrateArguments& arguments, const std::string& file) {
  refuse_other_kinds("calibrate", {{file, FileKind::settings}});
  return recording::read_campaign(
      file, arguments.allow_outside ? recording::OutsideFiles::allowed : recording::OutsideFiles::refused);
}

model::Model calibrated(const recording::Campaign& campaign, bool despite_doubts,
                        const calibration::CalibrationProgress& progress) {
  return calibration::calibrate(
      campaign, std::string(tool_version()), progress,
      despite_doubts ? calibration::Contradictions::noted : calibration::Contradictions::refused);
}

/// A model and the text of its file; read and written again, its axes may differ in their last digits.
struct MadeModel {
  model::Model model;
  std::string text;
};

void calibrate_one(const CalibrateArguments& arguments, const CalibrationTask& task,
                   const std::function<MadeModel(const recording::Campaign&)>& make) {
  const recording::Campaign campaign = read_campaign(arguments, task.campaign);
  const report::ReaderUnits units(arguments.units);
  std::vector<std::filesystem::path> inputs = files_of(campaign);
  OutputFile output(task.model, inputs);
  std::optional<OutputFile> page;
  inputs.emplace_back(task.model);
  if (!task.report.empty()) page.emplace(task.report, inputs);
  const auto [model, text] = make(campaign);
  for (const model::InputFile& input : model.provenance.inputs) {
    if (!input.resampled.empty()) say("{}: {}\n", input.file, input.resampled);
  }
  for (const std::string& doubt : model.provenance.doubts) say("spoolflow: doubt: {}\n", doubt);
  output.stream() << text;
  if (page) report::write_calibration_report(page->stream(), model, units);
  commit_together({&output, page ? &*page : nullptr});
  if (!arguments.quiet) print_summary(model);
}

MadeModel calibrate_here(const CalibrateArguments& arguments, const CalibrationTask& task,
                         const recording::Campaign& campaign) {
  Progress progress("calibrating", arguments.quiet);
  MadeModel out{calibrated(campaign, arguments.despite_doubts,
                           [&](const std::string& step, double share) {
                             progress.task(step);
                             progress.update(share);
                           }),
                {}};
  out.text = readable_text(out.model, task.model);
  return out;
}

/// What calibration has to do with the machine's clock: SOURCE_DATE_EPOCH, where it is set here.
constexpr const char* clock_variable = "SOURCE_DATE_EPOCH";

/// The campaign's folder as far as the campaign needs it.
SentPiece sent_campaign(FleetWork& fleet, const CalibrateArguments& arguments, const recording::Campaign& campaign) {
  const char* const clock = std::getenv(clock_variable);
  SentPiece piece{{.kind = "calibrate",
                   .arguments = fmt::format("{:d} {}", arguments.despite_doubts, clock == nullptr ? "" : clock)}};
  const std::filesystem::path folder = std::filesystem::canonical(campaign.file).parent_path();
  for (const std::filesystem::path& file : files_of(campaign)) {
    const std::string inside =
        file == campaign.file
            ? file.filename().string()
            : std::filesystem::absolute(file)
                  .lexically_normal()
                  .lexically_relative(std::filesystem::absolute(campaign.file).lexically_normal().parent_path())
                  .generic_string();
    if (inside.empty() || inside.starts_with("..")) {
      throw std::invalid_argument(fmt::format(
          "{}: stands outside the campaign's folder {}; --fleet sends what is in it, so copy the file there",
          file.string(), folder.string()));
    }
    fleet.add(piece, file.string(), inside);
  }
  return piece;
}

/// One campaign on a worker.
fleet::Outcome do_calibrate_piece(const fleet::Piece& piece) {
  const std::size_t gap = piece.arguments.find(' ');
  const bool despite_doubts = piece.arguments.substr(0, gap) == "1";
  const std::string clock = gap == std::string::npos ? "" : piece.arguments.substr(gap + 1);
  if (!clock.empty()) ::setenv(clock_variable, clock.c_str(), 1);
  const model::Model model =
      calibrated(recording::read_campaign(path_of(piece, 0)), despite_doubts, [](const std::string&, double) {});
  constexpr const char* output = "model.json";
  write_piece_file(output, readable_text(model, output));
  return {.files = {{output}}};
}

/// All of them at once; the models as they come.
void calibrate_by_fleet(const CalibrateArguments& arguments, const std::vector<CalibrationTask>& tasks,
                        const std::function<void(const std::function<void()>&)>& attempt) {
  FleetWork fleet(arguments.fleet, tool_version(), say_line);
  std::vector<std::size_t> task_of;
  Progress progress("calibrating by the fleet", arguments.quiet);
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    attempt([&] {
      fleet.ask(sent_campaign(fleet, arguments, read_campaign(arguments, tasks[k].campaign)));
      task_of.push_back(k);
    });
  }
  double finished = 0;
  fleet.wait([&](std::size_t number, const fleet::Outcome& outcome) {
    attempt([&] {
      throw_failure(outcome);
      const std::string text = fleet.content(outcome.files.at(0));
      calibrate_one(arguments, tasks[task_of[number]], [&](const recording::Campaign&) {
        return MadeModel{model::parse_model(text, "the fleet's model"), text};
      });
    });
    progress.update(++finished / static_cast<double>(task_of.size()));
  });
}

/// Of several campaigns FOLDER/NAME.json, NAME that of the campaign's own folder. Throws OutputError where two would be
/// the same.
std::vector<CalibrationTask> tasks_of(const CalibrateArguments& arguments) {
  if (arguments.campaigns.size() == 1) return {{arguments.campaigns.front(), arguments.model, arguments.report}};
  std::vector<CalibrationTask> out;
  const auto in = [](const std::string& folder, const std::filesystem::path& name, const char* ending) {
    return folder.empty() ? folder : (std::filesystem::path(folder) / name).concat(ending).string();
  };
  for (const std::string& campaign : arguments.campaigns) {
    const std::filesystem::path name = std::filesystem::absolute(campaign).lexically_normal().parent_path().filename();
    out.push_back({campaign, in(arguments.model, name, ".json"), in(arguments.report, name, ".html")});
    for (std::size_t k = 0; k + 1 < out.size(); ++k) {
      if (out[k].model != out.back().model) continue;
      throw OutputError(fmt::format("the models of {} and {} would both be {}; calibrate them into different folders",
                                    out[k].campaign, campaign, out[k].model));
    }
  }
  for (const std::string& folder : {arguments.model, arguments.report}) {
    if (folder == "-") throw OutputError("models of several campaigns are written to a folder, not to -");
    if (!folder.empty()) make_output_folder(folder);
  }
  return out;
}

}  // namespace

void calibrate(const CalibrateArguments& arguments) {
  const std::vector<CalibrationTask> tasks = tasks_of(arguments);
  std::vector<std::exception_ptr> failures;
  const auto attempt = [&](const std::function<void()>& work) {
    try {
      work();
    } catch (const ReaderGone&) {
      throw;
    } catch (...) {
      failures.push_back(std::current_exception());
    }
  };
  if (arguments.fleet.empty()) {
    for (const CalibrationTask& task : tasks) {
      attempt([&] {
        calibrate_one(arguments, task,
                      [&](const recording::Campaign& campaign) { return calibrate_here(arguments, task, campaign); });
      });
    }
  } else {
    calibrate_by_fleet(arguments, tasks, attempt);
  }
  if (!failures.empty()) throw_together(failures);
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
       "the model as JSON: maps, their ranges and residuals, and where they came from; of several campaigns "
       "DIR/NAME.json each, NAME that of the campaign's folder",
       {"spoolflow calibrate valve_a/campaign.toml -o valve_a.json",
        "spoolflow calibrate valve_*/campaign.toml -o models --fleet fleet.toml"}});
  command->add_option("campaign", arguments->campaigns, "one or several campaign files (TOML)")->required();
  command
      ->add_option("-o,--output", arguments->model,
                   "model file to write, - for standard output; a folder for several campaigns")
      ->type_name("MODEL.json")
      ->required();
  command
      ->add_option("--report", arguments->report,
                   "HTML page to write about the calibration; a folder for several campaigns")
      ->type_name("PAGE.html");
  command->add_flag("--allow-outside", arguments->allow_outside,
                    "read recordings that the campaign names outside its own folder, too");
  command->add_flag("--despite-doubts", arguments->despite_doubts,
                    "make a model of recordings that contradict each other or physics, too");
  add_fleet_option(*command, arguments->fleet, "on the campaigns");
  add_piece_kind("calibrate", do_calibrate_piece);
  add_units(*command, arguments->units);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { calibrate(*arguments); });
}

}  // namespace spoolflow::apps
