/// `spoolflow calibrate`: from a campaign's bench recordings to a model file.
#include <exception>
#include <functional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/calibrate_units.hpp"
#include "spoolflow/apps/calibrate_work.hpp"
#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/elsewhere.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/work/readable_model.hpp"
#include "spoolflow/calibration/type/series.hpp"
#include "spoolflow/calibration/type/type_model.hpp"

namespace spoolflow::apps {
namespace {

MadeModel calibrate_here(const CalibrateArguments& arguments, const CalibrationTask& task,
                         const recording::Campaign& campaign) {
  Progress progress("calibrating", arguments.quiet);
  MadeModel out{calibrated(campaign, arguments.despite_doubts,
                           [&](const std::string& step, double share) { progress.update(step, share); }),
                {}};
  if (arguments.as_type) {
    out.model = calibration::type_model(std::move(out.model), calibration::tolerances_from(campaign.tolerances));
  }
  out.text = readable_text(out.model, task.model);
  return out;
}

/// Of several campaigns FOLDER/NAME.json, NAME that of the campaign's own folder. Throws OutputError where two would be
/// the same.
std::vector<CalibrationTask> tasks_of(const CalibrateArguments& arguments) {
  if (arguments.campaigns.size() == 1) return {{arguments.campaigns.front(), arguments.model, arguments.report}};
  std::vector<CalibrationTask> out;
  const std::string pages = arguments.type.empty() ? arguments.report : "";  // of units there is one of them all
  const auto in = [](const std::string& folder, const std::filesystem::path& name, const char* ending) {
    return folder.empty() ? folder : (std::filesystem::path(folder) / name).concat(ending).string();
  };
  for (const std::string& campaign : arguments.campaigns) {
    const std::filesystem::path name = std::filesystem::absolute(campaign).lexically_normal().parent_path().filename();
    out.push_back({campaign, in(arguments.model, name, ".json"), in(pages, name, ".html")});
    for (std::size_t k = 0; k + 1 < out.size(); ++k) {
      if (out[k].model != out.back().model) continue;
      throw OutputError(fmt::format("the models of {} and {} would both be {}; calibrate them into different folders",
                                    out[k].campaign, campaign, out[k].model));
    }
  }
  for (const std::string& folder : {arguments.model, pages}) {
    if (folder == "-") throw OutputError("models of several campaigns are written to a folder, not to -");
    if (!folder.empty()) make_output_folder(folder);
  }
  return out;
}

void refuse_contradictions(const CalibrateArguments& arguments) {
  if (arguments.as_type && !arguments.type.empty())
    throw std::invalid_argument("--as-type makes a type's model, --type one of its units: give one of them");
  if (arguments.as_type && arguments.campaigns.size() == 2)
    throw std::invalid_argument(
        "--as-type makes a type of one campaign or of three and more, and 2 are given: two do not show how far the "
        "next unit lies; give that of the unit nearest to the middle, and how units differ as its [tolerances]");
  if (arguments.as_type && arguments.campaigns.size() > 1 && !arguments.report.empty())
    throw std::invalid_argument("--report shows one campaign's fits: leave it out with --as-type of several");
  if ((arguments.as_type || !arguments.type.empty()) && !arguments.fleet.empty())
    throw std::invalid_argument("types and units are calibrated on this machine: leave out --fleet");
  if (arguments.type.empty() && !arguments.updated_type.empty())
    throw std::invalid_argument("--update-type is of the units of a type: give their type by --type");
  const bool of_series = !arguments.type.empty() && !(arguments.report.empty() && arguments.updated_type.empty());
  if (of_series && arguments.campaigns.size() < calibration::least_in_series)
    throw std::invalid_argument(
        fmt::format("with --type, --report and --update-type are of a series of {} units and more, and {} are given",
                    calibration::least_in_series, arguments.campaigns.size()));
}

}  // namespace

void calibrate(const CalibrateArguments& arguments) {
  refuse_contradictions(arguments);
  if (arguments.as_type && arguments.campaigns.size() > 1) return calibrate_type(arguments);
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
  if (!arguments.type.empty()) {
    calibrate_units(arguments, tasks, attempt);
  } else if (arguments.fleet.empty()) {
    for (const CalibrationTask& task : tasks) {
      attempt([&] {
        calibrate_one(arguments, task,
                      [&](const recording::Campaign& campaign) { return calibrate_here(arguments, task, campaign); });
      });
    }
  } else {
    elsewhere().calibrate(arguments, tasks, attempt);
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
       "DIR/NAME.json each, NAME that of the campaign's folder; with --as-type one model of all",
       {"spoolflow calibrate valve_a/campaign.toml -o valve_a.json",
        "spoolflow calibrate valve_*/campaign.toml -o models --fleet fleet.toml",
        "spoolflow calibrate valve_a/campaign.toml --as-type -o type_a.json",
        "spoolflow calibrate valves/*/campaign.toml --as-type -o type_a.json",
        "spoolflow calibrate unit_17/unit.toml --type type_a.json -o unit_17.json",
        "spoolflow calibrate units/*/unit.toml --type type_a.json -o models --report series.html"}});
  command->add_option("campaign", arguments->campaigns, "one or several campaign files (TOML)")->required();
  command
      ->add_option("-o,--output", arguments->model,
                   "model file to write, - for standard output; a folder for several campaigns")
      ->type_name("MODEL.json")
      ->required();
  command
      ->add_option("--report", arguments->report, "HTML page to write; a folder for several; with --type of the series")
      ->type_name("PAGE.html");
  command->add_flag("--allow-outside", arguments->allow_outside,
                    "read recordings that the campaign names outside its own folder, too");
  command->add_flag("--despite-doubts", arguments->despite_doubts,
                    "make a model of recordings that contradict each other or physics, too");
  command->add_flag("--as-type", arguments->as_type,
                    "the model is of every unit of the valve's type:\nits band holds units within [tolerances], "
                    "or,\nof three campaigns and more, as these differ");
  command
      ->add_option("--type", arguments->type,
                   "model of the type of which the campaigns are units,\neach known by strokes without pressure "
                   "and\nwhat operation was recorded")
      ->type_name("TYPE.json");
  command
      ->add_option("--update-type", arguments->updated_type,
                   "with --type, of three units and more: the type as\nthese units are, to write")
      ->type_name("TYPE.json");
  add_fleet_option(*command, arguments->fleet, "on the campaigns");
  add_units(*command, arguments->units);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { calibrate(*arguments); });
}

}  // namespace spoolflow::apps
