#include "spoolflow/apps/analyse_series.hpp"

#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "spoolflow/analysis/series_study.hpp"
#include "spoolflow/apps/terminal/input_kind.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/report/analysis/series_study_report.hpp"
#include "spoolflow/report/json/results_json.hpp"

namespace spoolflow::apps {
namespace {

/// Medians in percent, of what is known of any unit; the page and the file have the spread over the units as well.
std::string medians(const analysis::SeriesStudy& study) {
  using analysis::SeriesFigures;
  std::string out = fmt::format("{:<14} {:<16} {:>7} {:>8} {:>8} {:>7} {:>6}\n", "medians, %", "unit known by", "95 %",
                                "largest", "in band", "width", "units");
  for (std::size_t run = 0; run < analysis::series_runs; ++run) {
    for (const analysis::KnownBy by : analysis::all_known_by) {
      if (study.refused(by) == study.units.size()) continue;
      const auto median = [&](double SeriesFigures::*figure) { return 100 * study.over_units(by, run, figure).median; };
      out += fmt::format("{:<14} {:<16} {:>7.2f} {:>8.1f} {:>8.1f} {:>7.1f} {:>6}\n", report::series_run_name(run),
                         report::known_by_name(by), median(&SeriesFigures::p95), median(&SeriesFigures::largest),
                         median(&SeriesFigures::in_band), median(&SeriesFigures::band_width),
                         study.units.size() - study.refused(by));
    }
  }
  return out;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

std::vector<std::filesystem::path> inputs_of(const AnalyseArguments& arguments, const std::string& valve_file) {
  return {arguments.model, arguments.scenario, arguments.recording, arguments.channels, valve_file};
}

void print_lines(const std::string& text) {
  print_text(terminal_lines(text));
  flush_standard_output();
}

unsigned workers(const AnalyseArguments& arguments) {
  return arguments.jobs == 0 ? parallel::cores() : arguments.jobs;
}

analysis::Scenario scenario_of(const AnalyseArguments& arguments) {
  analysis::Scenario scenario;
  if (!arguments.scenario.empty()) scenario = analysis::read_scenario(arguments.scenario);
  if (arguments.samples != 0) scenario.study.base_samples = arguments.samples;
  if (arguments.seed != 0) scenario.seed = arguments.seed;
  return scenario;
}

std::optional<std::filesystem::path> state_file(const AnalyseArguments& arguments) {
  for (const std::string& output : {arguments.json, arguments.report}) {
    if (!output.empty() && output != "-" && !output.starts_with("/dev/")) return output + ".study";
  }
  return std::nullopt;
}

analysis::StudyWork kept_work(const AnalyseArguments& arguments) {
  analysis::StudyWork work{.identity = std::string(tool_version()), .workers = workers(arguments)};
  if (const std::optional<std::filesystem::path> state = state_file(arguments)) {
    work.saved = bytes_of(*state);
    work.save = [file = *state](const std::string& text) { write_file(file, {}, text); };
  }
  return work;
}

model::Model model_of(const AnalyseArguments& arguments) {
  std::vector<Input> roles{{arguments.model, FileKind::model}};
  if (!arguments.recording.empty()) roles.push_back({arguments.recording, FileKind::recording, "--recording "});
  refuse_other_kinds("analyse", roles);
  model::Model model = model::read_model(arguments.model);
  if (model.whole()) return model::of_direction(model, arguments.direction.empty() ? "b" : arguments.direction);
  if (!arguments.direction.empty() && arguments.direction != model.valve.direction) {
    throw model::ModelError(
        fmt::format("{}: --direction {}: the model knows direction \"{}\" only; leave the option out, "
                    "or calibrate the whole valve",
                    arguments.model, arguments.direction, model.valve.direction));
  }
  return model;
}

void analyse_series(const AnalyseArguments& arguments) {
  if (!arguments.channels.empty())
    throw std::invalid_argument("--channels: --series reads no recording; leave it away");
  const report::ReaderUnits units(arguments.units);
  const model::Model type = model_of(arguments);
  const analysis::Scenario scenario = scenario_of(arguments);
  Outputs outputs(inputs_of(arguments, scenario.study.valve));
  OutputFile *const page = outputs.open_if_named(arguments.report), *figures = outputs.open_if_named(arguments.json);
  const rig::ValveAndCampaign valve = analysis::study_valve(type, scenario);
  const analysis::SeriesStudy study = [&] {
    Progress progress("series", arguments.quiet);
    analysis::StudyWork work = kept_work(arguments);
    work.progress = [&](const std::string& task, double share) { progress.update(task, share); };
    return analysis::series_study(type, arguments.model, valve, arguments.series, scenario.seed, work);
  }();
  if (page != nullptr) report::write_series_study_report(page->stream(), type, study, units);
  if (figures != nullptr) report::write_series_study_json(figures->stream(), type, study);
  outputs.commit();
  if (const auto state = state_file(arguments)) std::filesystem::remove(*state);
  if (arguments.json == "-" || arguments.report == "-") return;
  print_lines(report::series_verdict(study) + "\n");
  print_text(medians(study));
  flush_standard_output();
}

}  // namespace spoolflow::apps
