/// `spoolflow estimate`: the flow rate of a recording, sample by sample, from what the sensor may read.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/output_file.hpp"
#include "spoolflow/apps/progress.hpp"
#include "spoolflow/recording/csv_writer.hpp"
#include "spoolflow/units/conversion.hpp"
#include "spoolflow/validation/estimation.hpp"

namespace spoolflow::apps {
namespace {

void write_rows(recording::CsvWriter& out, const recording::SampleBlock& block,
                const std::vector<sensor::Estimate<double>>& estimates, validation::StatusText& status_text) {
  using units::litre_per_minute_per_m3_per_s;
  const auto& time_s = block.columns[static_cast<std::size_t>(recording::Channel::time)];
  for (std::size_t k = 0; k < block.rows; ++k) {
    const sensor::Estimate<double>& estimate = estimates[k];
    out.number(time_s[k], 6);
    out.number(estimate.flow_m3_per_s * litre_per_minute_per_m3_per_s, 4);
    out.number(estimate.flow_lower_m3_per_s * litre_per_minute_per_m3_per_s, 4);
    out.number(estimate.flow_upper_m3_per_s * litre_per_minute_per_m3_per_s, 4);
    out.number(estimate.pressure_difference_Pa / units::pascal_per_bar, 4);
    out.number(estimate.magnetic_force_N, 3);
    out.number(estimate.flow_force_N, 3);
    out.number(estimate.friction_force_N, 3);
    out.text(status_text(estimate.status));
    out.end_row();
  }
}

void tell(const recording::ReadNotes& notes, const std::string& file) {
  if (notes.duplicate_times > 0) {
    fmt::print(stderr, "{}: {} samples repeat the time stamp before them; each is estimated, with status time_fault\n",
               file, notes.duplicate_times);
  }
  if (notes.missing_values > 0) {
    fmt::print(stderr, "{}: {} values are missing; the estimate is held there, with status sample_missing\n", file,
               notes.missing_values);
  }
}
}  // namespace

void estimate(const EstimateArguments& arguments) {
  const model::Model model = model::read_model(arguments.model);
  validation::Estimator estimator = validation::best_estimator(model);
  if (arguments.estimator == "condensed") estimator = validation::Estimator::condensed;
  if (arguments.estimator == "observer") estimator = validation::Estimator::observer;
  recording::ChannelMap channels;
  if (!arguments.channels.empty()) channels = recording::read_channel_map(arguments.channels);
  const auto reader =
      recording::open_reader(arguments.recording, validation::sensor_channels(model, std::move(channels)));
  validation::Estimation estimation(model, estimator);
  std::vector<std::filesystem::path> inputs{arguments.model, arguments.recording};
  if (!arguments.channels.empty()) inputs.emplace_back(arguments.channels);
  OutputFile output(arguments.output, inputs);
  {
    Progress progress("estimating", arguments.quiet);
    recording::CsvWriter writer(output.stream());
    writer.header({"time_s", "flow_L_min", "flow_lower_L_min", "flow_upper_L_min", "pressure_difference_bar",
                   "magnetic_force_N", "flow_force_N", "friction_force_N", "status"});
    recording::SampleBlock block;
    std::vector<sensor::Estimate<double>> estimates;
    validation::StatusText status_text;
    while (reader->next(block)) {
      estimation.run(block, estimates);
      write_rows(writer, block, estimates, status_text);
      progress.update(reader->progress(), reader->notes().rows);
    }
    writer.flush();
  }
  output.commit();
  tell(reader->notes(), arguments.recording);
}

void add_estimate_command(CLI::App& program) {
  auto arguments = std::make_shared<EstimateArguments>();
  CLI::App* command = add_command(
      program,
      {"estimate",
       "estimate the flow rate of a recording, with its 95 % band",
       "MODEL.json from `spoolflow calibrate`, and a recording (CSV, MATLAB, HDF5; - for CSV from standard input) "
       "with time, current and position, better also voltage and oil temperature; nothing else of it is read",
       "CSV, one row a sample: time, flow with its band, pressure difference, forces, status",
       {"spoolflow estimate valve_a.json run.csv -o estimate.csv",
        "spoolflow estimate valve_a.json run.mat --channels map.toml -o - | head"}});
  command->add_option("model", arguments->model, "model file")->required();
  command->add_option("recording", arguments->recording, "recording")->required();
  command->add_option("-o,--output", arguments->output, "CSV file to write; - for standard output")
      ->type_name("ESTIMATE.csv")
      ->required();
  command
      ->add_option("--estimator", arguments->estimator, "condensed or observer; the observer where the model has one")
      ->type_name("NAME")
      ->check(CLI::IsMember({"condensed", "observer"}));
  command
      ->add_option("--channels", arguments->channels, "channel map (TOML) for files with other column names or units")
      ->type_name("MAP.toml");
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { estimate(*arguments); });
}

}  // namespace spoolflow::apps
