#include "spoolflow/apps/estimate_work.hpp"

#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/terminal/ahead.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/apps/work/estimate_table.hpp"
#include "spoolflow/calibration/environment.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/monitor/contradiction.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

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
  recording::SampleBlock samples;
  std::vector<sensor::Estimate<double>> estimates;
  recording::ReadNotes notes;
  std::optional<double> share;
};

/// The model's monitor over the first minutes of a run: enough strokes, whatever the rest takes.
class FirstMinutes {
 public:
  explicit FirstMinutes(const model::Model& model) : watch_(model) {}
  void take(const recording::SampleBlock& samples, const std::vector<sensor::Estimate<double>>& answers) {
    constexpr double watched_s = 300;
    const estimation::Columns columns = estimation::sensor_columns(samples);
    if (answers.empty()) return;
    if (std::isnan(begin_s_)) begin_s_ = columns.time_s.front();
    if (columns.time_s.front() - begin_s_ > watched_s) return;
    watch_.take(columns, answers);
  }
  void add_contradiction(const std::string& file, std::vector<std::string>& doubts) {
    monitor::add_contradiction(watch_, file, doubts);
  }

 private:
  monitor::Monitor watch_;
  double begin_s_ = std::nan("");
};

}  // namespace

EstimateTask estimate_task(const EstimateArguments& arguments) {
  EstimateTask task{model::read_model(arguments.model),
                    {},
                    {},
                    {},
                    {arguments.model},
                    recording::table_format(arguments.format),
                    arguments.quiet};
  if (!arguments.environment.empty()) {
    calibration::apply(recording::read_environment(arguments.environment), task.model);
    task.inputs.emplace_back(arguments.environment);
  }
  task.known = plausibility::known_valve(task.model);
  task.estimator = estimation::best_estimator(task.model);
  if (arguments.estimator == "condensed") task.estimator = estimation::Estimator::condensed;
  if (arguments.estimator == "observer") task.estimator = estimation::Estimator::observer;
  task.channels = channels_from(arguments.channels);
  if (!arguments.channels.empty()) task.inputs.emplace_back(arguments.channels);
  task.inputs.insert(task.inputs.end(), arguments.recordings.begin(), arguments.recordings.end());
  return task;
}

recording::TableFormat format_for(const EstimateTask& task, const std::filesystem::path& target) {
  return task.format ? *task.format : recording::table_format_of(target);
}

validation::EstimateSummary estimate_recording(const EstimateTask& task, const std::string& recording,
                                               const std::filesystem::path& target, bool beside) {
  const bool runs_on = recording == "-";
  recording::ReadOptions channels = estimation::sensor_channels(task.model, task.channels);
  channels.runs_on = runs_on;
  const auto reader = estimation::open_sensor_channels(recording, channels);
  estimation::RunningSensor sensor = estimation::running_sensor(task.model, task.estimator);
  recording::TableHead head = estimate_table(task.model, task.estimator, fmt::format("spoolflow {}", tool_version()));
  OutputFile output(target, task.inputs);  // first, as an input in its place is the worse slip
  const recording::TableFormat format = format_for(task, target);
  validation::EstimateSummary summary{.file = runs_on ? "standard input" : recording};
  plausibility::RunMeans means;
  std::optional<FirstMinutes> watch;
  if (task.estimator == estimation::Estimator::observer) watch.emplace(task.model);
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
          estimation::run(sensor, estimation::sensor_columns(read->samples), block.estimates);
          if (watch) watch->take(read->samples, block.estimates);  // here, as writing takes longest meanwhile
          std::swap(block.samples, read->samples);
          block.notes = read->notes;
          block.share = read->share;
          return true;
        },
        beside);
    recording::TableRows rows;
    while (const EstimatedBlock* block = estimating.next()) {
      put_estimates(rows, block->samples.column(recording::Channel::time), block->estimates);
      writer->write(rows);
      summary.add(block->estimates);
      if (runs_on) writer->hand_over();  // whoever reads waits for these rows
      summary.notes = block->notes;
      progress.update(block->share, block->notes.rows);
    }
    writer->finish();
  }
  output.commit();
  for (plausibility::Finding& finding : plausibility::run_findings(task.known, means, recording))
    summary.doubts.push_back(std::move(finding.text));
  if (watch) watch->add_contradiction(summary.file, summary.doubts);
  return summary;
}

}  // namespace spoolflow::apps
