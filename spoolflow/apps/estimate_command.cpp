/// `spoolflow estimate`: the flow rate of a recording, sample by sample, from what the sensor may read.
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/elsewhere.hpp"
#include "spoolflow/apps/estimate_work.hpp"
#include "spoolflow/apps/terminal/input_kind.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/work/notes.hpp"
#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/report/json/results_json.hpp"

namespace spoolflow::apps {
namespace {

void report(const recording::ReadNotes& notes, const std::string& file) {
  for (const std::string& line : notes_text(notes, file)) say("{}\n", line);
}

/// FOLDER/NAME.csv for each recording NAME.*, or with the format's suffix. Throws OutputError where two would be the
/// same, and where the folder has the name of a table and is not there.
std::vector<std::filesystem::path> targets_in(const std::filesystem::path& folder,
                                              const std::vector<std::string>& recordings,
                                              std::optional<recording::TableFormat> format) {
  const std::string extension = fmt::format(".{}", suffix(format.value_or(recording::TableFormat::csv)));
  const std::string named = folder.extension().string();
  if (!named.empty() && recording::table_format(named.substr(1)) && !std::filesystem::is_directory(folder)) {
    throw OutputError(
        fmt::format("the estimates of several recordings are files in a folder, and {} is named as one "
                    "file; name a folder, or estimate one recording",
                    folder.string()));
  }
  std::map<std::filesystem::path, std::string> made_from;
  std::vector<std::filesystem::path> targets;
  for (const std::string& recording : recordings) {
    if (recording == "-" || folder == "-") {
      throw OutputError("several recordings are read from files and their estimates written to a folder, not to -");
    }
    targets.push_back(folder / std::filesystem::path(recording).stem().concat(extension));
    const auto [other, is_new] = made_from.emplace(targets.back(), recording);
    if (!is_new) {
      throw OutputError(fmt::format("the estimates of {} and {} would both be {}; estimate them into different folders",
                                    other->second, recording, targets.back().string()));
    }
  }
  return targets;
}

/// All recordings, as many at a time as the machine has cores. Failures are thrown when the others are done.
std::vector<validation::EstimateSummary> estimate_all(const EstimateTask& task,
                                                      const std::vector<std::string>& recordings,
                                                      const std::vector<std::filesystem::path>& targets) {
  std::vector<std::exception_ptr> failures(recordings.size());
  std::vector<validation::EstimateSummary> out(recordings.size());
  const auto fork_server = recording::fork_server_for({recordings.begin(), recordings.end()});
  parallel::for_each(recordings.size(), parallel::cores(), [&](std::size_t k) {
    try {
      out[k] = estimate_recording(task, recordings[k], targets[k], false);
    } catch (...) {
      failures[k] = std::current_exception();
    }
  });
  std::erase(failures, nullptr);
  if (!failures.empty()) throw_together(failures);
  return out;
}

/// What the user should know of the recordings; with --strict a fault or a doubt fails.
void report(const std::vector<validation::EstimateSummary>& summaries, const EstimateTask& task,
            const EstimateArguments& arguments) {
  bool sound = true;
  for (const validation::EstimateSummary& summary : summaries) {
    report(summary.notes, summary.file);
    if (!arguments.quiet) say("{}\n", summary.sentence(task.model.valve.rated_flow_m3_per_s));
    for (const std::string& doubt : summary.doubts) say("spoolflow: doubt: {}\n", doubt);
    sound = sound && summary.doubts.empty() && summary.with_fault == 0;
  }
  const bool declared = !arguments.environment.empty() || task.estimator == estimation::Estimator::condensed;
  if (!declared && !arguments.quiet) say_note(bench_note(task.model));
  if (arguments.strict && !sound)
    throw std::runtime_error(
        "the estimate is written, but it has faults, or the recording has plausibility findings (--strict)");
}

}  // namespace

void estimate(const EstimateArguments& arguments) {
  refuse_other_kinds("estimate", arguments.model, arguments.recordings);
  EstimateTask task = estimate_task(arguments);
  if (!arguments.quiet) say_note(type_note(task.model, arguments.model));
  std::vector<validation::EstimateSummary> summaries;
  const bool one = arguments.recordings.size() == 1;
  const auto targets = one ? std::vector<std::filesystem::path>{arguments.output}
                           : targets_in(arguments.output, arguments.recordings, task.format);
  std::vector<std::filesystem::path> used = task.inputs;
  used.insert(used.end(), targets.begin(), targets.end());
  Outputs outputs(used);
  OutputFile* const summary_file = outputs.open_if_named(arguments.json);
  if (!one) make_output_folder(arguments.output);
  if (!arguments.fleet.empty()) {
    summaries = elsewhere().estimate(task, arguments, targets);
  } else if (one) {
    const bool beside = parallel::cores() > 1;
    summaries.push_back(estimate_recording(task, arguments.recordings.front(), arguments.output, beside));
  } else {
    task.quiet = true;  // one line cannot report on many
    summaries = estimate_all(task, arguments.recordings, targets);
  }
  if (summary_file != nullptr) report::write_estimate_summary(summary_file->stream(), summaries);
  outputs.commit();
  report(summaries, task, arguments);
}

void add_estimate_command(CLI::App& program) {
  auto arguments = std::make_shared<EstimateArguments>();
  CLI::App* command = add_command(
      program,
      {"estimate",
       "estimate the flow rate of a recording, with its 95 % band",
       "MODEL.json from `spoolflow calibrate`, and a recording (CSV, MATLAB, HDF5, TDMS, MDF 4, Excel; - for CSV from "
       "standard input) "
       "with time, current and position, better also voltage and oil temperature; nothing else of it is read",
       "one row a sample: time, flow with its band, pressure difference, forces, status; CSV, Parquet, HDF5 or "
       "MATLAB by the suffix; of several recordings DIR/NAME.csv each, in parallel",
       {"spoolflow estimate valve_a.json run.csv -o estimate.csv",
        "spoolflow estimate valve_a.json run.mat --channels map.toml -o - | head",
        "spoolflow estimate valve_a.json run.csv -o estimate.parquet",
        "spoolflow estimate valve_a.json monday.csv tuesday.csv -o estimates"}});
  command->add_option("model", arguments->model, "model file")->required();
  command->add_option("recording", arguments->recordings, "one or several recordings")->required();
  command->add_option("-o,--output", arguments->output, "a .csv, .parquet, .h5 or .mat file, - for standard output")
      ->type_name("ESTIMATE.csv")
      ->required();
  command
      ->add_option("--format", arguments->format, "the format whatever the suffix, also of several recordings and of -")
      ->type_name("NAME")
      ->check(CLI::IsMember({"csv", "parquet", "h5", "mat"}));
  command
      ->add_option("--estimator", arguments->estimator, "condensed or observer; the observer where the model has one")
      ->type_name("NAME")
      ->check(CLI::IsMember({"condensed", "observer"}));
  add_channels_option(*command, arguments->channels);
  add_environment_option(*command, arguments->environment);
  command->add_option("--json", arguments->json, "summary to write: mean flow and band, share of each status, findings")
      ->type_name("SUMMARY.json");
  command->add_flag("--strict", arguments->strict, "exit status 1 where a sample has a fault or a recording a finding");
  add_fleet_option(*command, arguments->fleet, "on the recordings");
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { estimate(*arguments); });
}

}  // namespace spoolflow::apps
