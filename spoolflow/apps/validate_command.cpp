/// `spoolflow validate`: how good the sensor is on recordings with a reference flow.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal/input_kind.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/work/notes.hpp"
#include "spoolflow/calibration/environment.hpp"
#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/report/validation/requirements_table.hpp"
#include "spoolflow/report/validation/validation_report.hpp"
#include "spoolflow/report/validation/verdict.hpp"

namespace spoolflow::apps {
namespace {

std::vector<estimation::Estimator> chosen(const std::string& name, const model::Model& model) {
  if (name == "condensed") return {estimation::Estimator::condensed};
  if (name == "observer") return {estimation::Estimator::observer};
  return estimation::all_estimators(model);
}

void print_row(const std::string& run, estimation::Estimator estimator, const validation::GroupFigures& all,
               double percent) {
  print("{:<24} {:<10} {:>8.2f} {:>8.2f} {:>8.1f} {:>7.1f} %\n", run, estimation::name(estimator),
        all.error.p95 * percent, all.error.rms * percent, all.error.largest * percent, 100 * all.band_coverage);
}

/// What is known of each run's meter.
void print_meters(const validation::Validation& validation) {
  std::vector<std::string> lines, unknown;
  for (const validation::RunResult& run : validation.runs) {
    const validation::MeterSource source = run.reference_meter.source;
    if (!run.has_reference || source == validation::MeterSource::given) continue;
    if (source == validation::MeterSource::none) {
      unknown.push_back(run.name);
    } else {
      lines.push_back(fmt::format("Reference meter of {}: lag {}{}\n", run.name, report::reference_meter_text(run),
                                  run.reference_meter.uncertainty ? " (95 %)" : ""));
    }
  }
  if (!unknown.empty()) {
    lines.push_back(fmt::format("Reference meter of {}: its lag does not show and counts as 0 (--reference-lag-ms)\n",
                                fmt::join(unknown, ", ")));
  }
  if (!lines.empty()) print("\n{}", fmt::join(lines, ""));
}

void print_figures(const model::Model& model, const validation::Validation& validation) {
  const double percent = 100 / model.valve.rated_flow_m3_per_s;
  const report::Verdict said = report::verdict(model, validation);
  print("{}\n", said.sentence.str());
  for (const report::Text& limit : said.limits) print("- {}\n", limit.str());
  if (!validation.limits.empty()) print("\n{}\n", report::requirements_sentence(validation));
  for (const validation::JudgedLimit& judged : validation.limits) {
    print("{}  {}: {}; found {}\n", judged.met ? "met    " : "NOT MET", judged.run, report::limit_text(judged).str(),
          report::value_text(judged).str());
  }
  print("\n{:<24} {:<10} {:>8} {:>8} {:>8} {:>9}\n", "run", "estimator", "p95 %FS", "RMS %FS", "max %FS", "in band");
  for (const validation::RunResult& run : validation.runs) {
    for (const validation::EstimatorResult& result : run.results) {
      if (!result.metrics) {
        print("{:<24} {:<10} no reference flow\n", run.name, estimation::name(result.estimator));
        continue;
      }
      print_row(run.name, result.estimator, result.metrics->all, percent);
    }
  }
  if (!validation::pools_several_runs(validation)) return;
  for (const validation::PooledResult& pooled : validation.pooled) {
    if (pooled.metrics) print_row("all runs", pooled.estimator, pooled.metrics->all, percent);
  }
  for (const validation::PooledResult& pooled : validation.pooled) {
    if (pooled.by_sample) print_row("all samples", pooled.estimator, pooled.by_sample->all, percent);
  }
}

}  // namespace

void validate(const ValidateArguments& arguments) {
  refuse_other_kinds("validate", arguments.model, arguments.recordings);
  const report::ReaderUnits units(arguments.units);
  model::Model model = model::read_model(arguments.model);
  if (!arguments.quiet) say_note(type_note(model, arguments.model));
  if (!arguments.environment.empty()) calibration::apply(recording::read_environment(arguments.environment), model);
  validation::ValidationOptions options{chosen(arguments.estimator, model), {}, {}, arguments.apply_reference_lag};
  if (arguments.reference_lag_ms) options.reference_lag_s = *arguments.reference_lag_ms * 1e-3;
  options.channels = channels_from(arguments.channels);
  if (!arguments.requirements.empty()) options.requirements = validation::read_requirements(arguments.requirements);
  std::vector<report::ComparedValidation> others;
  for (const std::string& metrics : arguments.compare) others.push_back(report::read_compared(metrics));
  std::vector<std::filesystem::path> inputs{arguments.model, arguments.channels, arguments.requirements,
                                            arguments.environment};
  inputs.insert(inputs.end(), arguments.recordings.begin(), arguments.recordings.end());
  inputs.insert(inputs.end(), arguments.compare.begin(), arguments.compare.end());
  Outputs outputs(inputs);
  OutputFile *const page = outputs.open_if_named(arguments.report), *figures = outputs.open_if_named(arguments.json);
  validation::Validation validation;
  {
    Progress progress("validating", arguments.quiet);
    validation = validation::validate(model, {arguments.recordings.begin(), arguments.recordings.end()}, options,
                                      [&](double share) { progress.update(share); });
  }
  for (const validation::RunResult& run : validation.runs) {
    if (!run.resampled.empty()) say("{}: {}\n", run.file, run.resampled);
  }
  if (page != nullptr) report::write_validation_report(page->stream(), model, validation, others, units);
  if (figures != nullptr) report::write_metrics(figures->stream(), model, validation);
  outputs.commit();
  if (arguments.json != "-" && arguments.report != "-") {
    print_figures(model, validation);
    print_meters(validation);
  }
  const auto unmet = std::ranges::count(validation.limits, false, &validation::JudgedLimit::met);
  if (arguments.fail_unmet && unmet > 0)
    throw std::runtime_error(
        fmt::format("{} of {} requirements are not met (--fail-unmet)", unmet, validation.limits.size()));
}

void add_validate_command(CLI::App& program) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command = add_command(
      program,
      {"validate",
       "compare the estimate with a reference flow meter and write a report",
       "MODEL.json, and recordings that also hold flow_reference (without it the report shows the estimate alone)",
       "a self-contained HTML report, and all figures as JSON; a summary on standard output",
       {"spoolflow validate valve_a.json ramp.csv duty.csv --report report.html --json metrics.json"}});
  command->add_option("model", arguments->model, "model file")->required();
  command->add_option("recordings", arguments->recordings, "recordings with a reference flow")->required();
  CLI::Option* report =
      command->add_option("--report", arguments->report, "HTML report to write")->type_name("REPORT.html");
  command->add_option("--json", arguments->json, "figures to write as JSON; - for standard output")
      ->type_name("METRICS.json");
  add_channels_option(*command, arguments->channels);
  CLI::Option* requirements =
      command
          ->add_option("--requirements", arguments->requirements, "limits (TOML) against which the figures are judged")
          ->type_name("LIMITS.toml");
  add_environment_option(*command, arguments->environment);
  command->add_flag("--fail-unmet", arguments->fail_unmet, "exit status 1 where a requirement is not met")
      ->needs(requirements);
  command
      ->add_option("--compare", arguments->compare,
                   "figures of another valve or model to show side by side; may be repeated")
      ->type_name("METRICS.json")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->needs(report);
  add_units(*command, arguments->units);
  command->add_option("--estimator", arguments->estimator, "both, condensed or observer")
      ->type_name("NAME")
      ->check(CLI::IsMember({"both", "condensed", "observer"}))
      ->capture_default_str();
  command
      ->add_option("--reference-lag-ms", arguments->reference_lag_ms,
                   "lag of the reference meter; else lag and dead time are found in each run")
      ->check(between(0.0, 10000.0));
  command->add_flag("--apply-reference-lag,!--no-reference-lag", arguments->apply_reference_lag,
                    "delay and lag the estimate as the meter does before comparing (default)");
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { validate(*arguments); });
}

}  // namespace spoolflow::apps
