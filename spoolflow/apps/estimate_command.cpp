/// `spoolflow estimate`: the flow rate of a recording, sample by sample, from what the sensor may read.
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/ahead.hpp"
#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/output_file.hpp"
#include "addons/fleet/pieces/fleet_work.hpp"
#include "addons/fleet/pieces/piece_kinds.hpp"
#include "addons/fleet/pieces/summary_text.hpp"
#include "spoolflow/apps/progress.hpp"
#include "spoolflow/apps/suggestion.hpp"
#include "spoolflow/apps/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/apps/work/estimate_table.hpp"
#include "spoolflow/apps/work/reading_notes.hpp"
#include "spoolflow/consistency/run_doubts.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"
#include "spoolflow/report/json/estimate_json.hpp"
#include "spoolflow/validation/estimate_summary.hpp"
#include "spoolflow/validation/sensor_channels.hpp"

namespace spoolflow::apps {
namespace {

/// Samples as they were read, and how far that is.
struct ReadBlock {
  recording::SampleBlock samples;
  recording::ReadNotes notes;
  std::optional<double> share;
};

/// What became of them.
struct EstimatedBlock {
  std::vector<double> time_s;
  std::vector<sensor::Estimate<double>> estimates;
  recording::ReadNotes notes;
  std::optional<double> share;
};

void tell(const recording::ReadNotes& notes, const std::string& file) {
  for (const std::string& line : notes_text(notes, file)) say("{}\n", line);
}

/// What all recordings of one command have in common.
struct Task {
  model::Model model;
  estimation::Estimator estimator;
  recording::ChannelMap channels;
  std::vector<consistency::KnownValve> known;  ///< what its recordings should be of
  std::vector<std::filesystem::path> inputs;
  std::optional<recording::TableFormat> format;  ///< of the estimates; nothing: as their names say
  bool quiet;
};

Task task_of(const EstimateArguments& arguments) {
  Task task{model::read_model(arguments.model),
            {},
            {},
            {},
            {arguments.model},
            recording::table_format(arguments.format),
            arguments.quiet};
  task.known = consistency::known_valve(task.model);
  task.estimator = estimation::best_estimator(task.model);
  if (arguments.estimator == "condensed") task.estimator = estimation::Estimator::condensed;
  if (arguments.estimator == "observer") task.estimator = estimation::Estimator::observer;
  if (!arguments.channels.empty()) {
    task.channels = recording::read_channel_map(arguments.channels);
    task.inputs.emplace_back(arguments.channels);
  }
  task.inputs.insert(task.inputs.end(), arguments.recordings.begin(), arguments.recordings.end());
  return task;
}

recording::TableFormat format_for(const Task& task, const std::filesystem::path& target) {
  return task.format ? *task.format : recording::table_format_of(target);
}

/// `beside`: whether reading, estimating and writing may have a thread each.
validation::EstimateSummary estimate_one(const Task& task, const std::string& recording,
                                         const std::filesystem::path& target, bool beside) {
  const bool runs_on = recording == "-";
  recording::ReadOptions channels = validation::sensor_channels(task.model, task.channels);
  channels.runs_on = runs_on;
  const auto reader = validation::open_sensor_channels(recording, channels);
  estimation::RunningSensor sensor = estimation::running_sensor(task.model, task.estimator);
  recording::TableHead head = estimate_table(task.model, task.estimator, fmt::format("spoolflow {}", tool_version()));
  OutputFile output(target, task.inputs);  // first, as an input in its place is the worse slip
  const recording::TableFormat format = format_for(task, target);
  validation::EstimateSummary summary{.file = runs_on ? "standard input" : recording};
  consistency::RunMeans means;
  {
    Progress progress("estimating", task.quiet);
    const auto writer = recording::table_writer(format, std::move(head), output);
    Ahead<ReadBlock> reading(
        [&](ReadBlock& block) {
          const bool more = reader->next(block.samples);
          if (more) means.take(block.samples);  // here, as the sensor has most to do
          block.notes = reader->notes();
          block.share = reader->progress();
          return more;
        },
        beside);
    Ahead<EstimatedBlock> estimating(
        [&](EstimatedBlock& block) {
          ReadBlock* const read = reading.next();
          if (read == nullptr) return false;
          block.estimates.resize(read->samples.rows);
          estimation::run(sensor, validation::sensor_columns(read->samples), block.estimates);
          std::swap(block.time_s, read->samples.columns[static_cast<std::size_t>(recording::Channel::time)]);
          block.notes = read->notes;
          block.share = read->share;
          return true;
        },
        beside);
    recording::TableRows rows;
    while (const EstimatedBlock* block = estimating.next()) {
      put_estimates(rows, block->time_s, block->estimates);
      writer->write(rows);
      summary.add(block->estimates);
      if (runs_on) writer->hand_over();  // whoever reads waits for these rows
      summary.notes = block->notes;
      progress.update(block->share, block->notes.rows);
    }
    writer->finish();
  }
  output.commit();
  for (consistency::Doubt& doubt : consistency::doubts_about(task.known, means, recording))
    summary.doubts.push_back(std::move(doubt.text));
  return summary;
}

/// FOLDER/NAME.csv for each recording NAME.*, or with the format's suffix. Throws OutputError where two would be the
/// same.
std::vector<std::filesystem::path> targets_in(const std::filesystem::path& folder,
                                              const std::vector<std::string>& recordings,
                                              std::optional<recording::TableFormat> format) {
  const std::string extension = fmt::format(".{}", suffix(format.value_or(recording::TableFormat::csv)));
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
std::vector<validation::EstimateSummary> estimate_all(const Task& task, const std::vector<std::string>& recordings,
                                                      const std::vector<std::filesystem::path>& targets) {
  std::vector<std::exception_ptr> failures(recordings.size());
  std::vector<validation::EstimateSummary> out(recordings.size());
  const auto nursery = recording::nursery_for({recordings.begin(), recordings.end()});
  parallel::for_each(recordings.size(), parallel::cores(), [&](std::size_t k) {
    try {
      out[k] = estimate_one(task, recordings[k], targets[k], false);
    } catch (...) {
      failures[k] = std::current_exception();
    }
  });
  std::erase(failures, nullptr);
  if (!failures.empty()) throw_together(failures);
  return out;
}

/// The same by workers of a fleet, a piece a recording.
std::vector<validation::EstimateSummary> estimate_by_fleet(const Task& task, const EstimateArguments& arguments,
                                                           const std::vector<std::filesystem::path>& targets) {
  FleetWork fleet(arguments.fleet, tool_version(), say_line);
  const std::size_t count = arguments.recordings.size();
  std::vector<std::exception_ptr> failures(count);
  std::vector<validation::EstimateSummary> out(count);
  std::vector<std::size_t> recording_of;
  const auto attempt = [&](std::size_t k, const auto& work) {
    try {
      work();
    } catch (const fleet::ServerRefuses&) {
      throw;
    } catch (...) {
      failures[k] = std::current_exception();
    }
  };
  Progress progress("estimating by the fleet", arguments.quiet);
  for (std::size_t k = 0; k < count; ++k) {
    attempt(k, [&] {
      (void)validation::open_sensor_channels(arguments.recordings[k],
                                             validation::sensor_channels(task.model, task.channels));
      const auto as = suffix(format_for(task, targets[k]));
      SentPiece piece{{.kind = "estimate", .arguments = fmt::format("{} {}", as, arguments.estimator)}};
      fleet.add(piece, arguments.model);
      fleet.add(piece, arguments.recordings[k]);
      if (!arguments.channels.empty()) fleet.add(piece, arguments.channels);
      fleet.ask(std::move(piece));
      recording_of.push_back(k);
    });
  }
  std::size_t finished = 0;
  fleet.wait([&](std::size_t number, const fleet::Outcome& outcome) {
    const std::size_t k = recording_of[number];
    attempt(k, [&] {
      throw_failure(outcome);
      OutputFile output(targets[k], task.inputs);
      output.stream() << fleet.content(outcome.files.at(0));
      out[k] = read_summary(outcome.text);
      out[k].file = fleet.sent(number).here(out[k].file);
      for (std::string& doubt : out[k].doubts) doubt = fleet.sent(number).here(doubt);
      output.commit();
    });
    progress.update(static_cast<double>(++finished) / static_cast<double>(recording_of.size()));
  });
  std::erase(failures, nullptr);
  if (!failures.empty()) throw_together(failures);
  return out;
}

/// One recording on a worker.
fleet::Outcome do_estimate_piece(const fleet::Piece& piece) {
  const std::size_t gap = piece.arguments.find(' ');
  EstimateArguments arguments{
      path_of(piece, 0), {path_of(piece, 1)}, "estimate", piece.arguments.substr(gap + 1), {}, {}, false, {}, true};
  arguments.format = piece.arguments.substr(0, gap);
  if (piece.files.size() > 2) arguments.channels = path_of(piece, 2);
  const validation::EstimateSummary summary =
      estimate_one(task_of(arguments), arguments.recordings.front(), arguments.output, false);
  return {.text = text_of(summary), .files = {{arguments.output}}};
}

/// What the user should know of the recordings; with --strict a fault or a doubt fails.
void tell(const std::vector<validation::EstimateSummary>& summaries, const Task& task,
          const EstimateArguments& arguments) {
  bool sound = true;
  for (const validation::EstimateSummary& summary : summaries) {
    tell(summary.notes, summary.file);
    if (!arguments.quiet) say("{}\n", summary.sentence(task.model.valve.rated_flow_m3_per_s));
    for (const std::string& doubt : summary.doubts) say("spoolflow: doubt: {}\n", doubt);
    sound = sound && summary.doubts.empty() && summary.with_fault == 0;
  }
  if (arguments.strict && !sound)
    throw std::runtime_error("the estimate is written, but there are faults or doubts about the recording (--strict)");
}

}  // namespace

void estimate(const EstimateArguments& arguments) {
  std::vector<Input> roles{{arguments.model, FileKind::model}};
  for (const std::string& recording : arguments.recordings) roles.push_back({recording, FileKind::recording});
  refuse_other_kinds("estimate", roles);
  Task task = task_of(arguments);
  std::optional<OutputFile> summary_file;
  if (!arguments.json.empty()) summary_file.emplace(arguments.json, task.inputs);
  std::vector<validation::EstimateSummary> summaries;
  const bool one = arguments.recordings.size() == 1;
  if (!arguments.fleet.empty()) {
    if (one && arguments.recordings.front() == "-")
      throw std::invalid_argument("--fleet sends whole recordings; name a file instead of -");
    if (!one) make_output_folder(arguments.output);
    summaries = estimate_by_fleet(task, arguments,
                                  one ? std::vector<std::filesystem::path>{arguments.output}
                                      : targets_in(arguments.output, arguments.recordings, task.format));
  } else if (one) {
    const bool beside = parallel::cores() > 1;
    summaries.push_back(estimate_one(task, arguments.recordings.front(), arguments.output, beside));
  } else {
    const auto targets = targets_in(arguments.output, arguments.recordings, task.format);
    make_output_folder(arguments.output);
    task.quiet = true;  // one line cannot tell of many
    summaries = estimate_all(task, arguments.recordings, targets);
  }
  if (summary_file) {
    report::write_estimate_summary(summary_file->stream(), summaries);
    summary_file->commit();
  }
  tell(summaries, task, arguments);
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
       "one row a sample: time, flow with its band, pressure difference, forces, status; CSV, Parquet, MCAP, HDF5 or "
       "MATLAB by the suffix; of several recordings DIR/NAME.csv each, in parallel",
       {"spoolflow estimate valve_a.json run.csv -o estimate.csv",
        "spoolflow estimate valve_a.json run.mat --channels map.toml -o - | head",
        "spoolflow estimate valve_a.json run.csv -o estimate.parquet",
        "spoolflow estimate valve_a.json monday.csv tuesday.csv -o estimates"}});
  command->add_option("model", arguments->model, "model file")->required();
  command->add_option("recording", arguments->recordings, "one or several recordings")->required();
  command
      ->add_option("-o,--output", arguments->output, "a .csv, .parquet, .mcap, .h5 or .mat file, - for standard output")
      ->type_name("ESTIMATE.csv")
      ->required();
  command
      ->add_option("--format", arguments->format, "the format whatever the suffix, also of several recordings and of -")
      ->type_name("NAME")
      ->check(CLI::IsMember({"csv", "parquet", "mcap", "h5", "mat"}));
  command
      ->add_option("--estimator", arguments->estimator, "condensed or observer; the observer where the model has one")
      ->type_name("NAME")
      ->check(CLI::IsMember({"condensed", "observer"}));
  command
      ->add_option("--channels", arguments->channels, "channel map (TOML) for files with other column names or units")
      ->type_name("MAP.toml");
  command->add_option("--json", arguments->json, "summary to write: mean flow and band, share of each status, doubts")
      ->type_name("SUMMARY.json");
  command->add_flag("--strict", arguments->strict,
                    "exit status 1 where a sample has a fault or a recording is doubted");
  add_fleet_option(*command, arguments->fleet, "on the recordings");
  add_quiet(*command, arguments->quiet);
  add_piece_kind("estimate", do_estimate_piece);
  command->callback([arguments] { estimate(*arguments); });
}

}  // namespace spoolflow::apps
