/// `spoolflow analyse TYPE.json --series UNITS`.
#include <fmt/format.h>

#include "spoolflow/analysis/series_study.hpp"
#include "spoolflow/apps/analyse_arguments.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/report/analysis/series_study_report.hpp"
#include "spoolflow/report/json/series_study_json.hpp"

namespace spoolflow::apps {
namespace {

/// Medians in percent, of what is known of any unit; the page and the file have the spread over the units as well.
std::string medians(const analysis::SeriesStudy& study) {
  using analysis::SeriesFigures;
  std::string out = fmt::format("{:<14} {:<37} {:>7} {:>8} {:>8} {:>7} {:>6}\n", "medians, %", "unit known by", "95 %",
                                "largest", "in band", "width", "units");
  for (std::size_t run = 0; run < analysis::series_runs; ++run) {
    for (const analysis::KnownBy by : analysis::all_known_by) {
      if (study.refused(by) == study.units.size()) continue;
      const auto median = [&](double SeriesFigures::*figure) { return 100 * study.over_units(by, run, figure).median; };
      out += fmt::format("{:<14} {:<37} {:>7.2f} {:>8.1f} {:>8.1f} {:>7.1f} {:>6}\n", report::series_run_name(run),
                         report::known_by_name(by), median(&SeriesFigures::p95), median(&SeriesFigures::largest),
                         median(&SeriesFigures::in_band), median(&SeriesFigures::band_width),
                         study.units.size() - study.refused(by));
    }
  }
  return out;
}

}  // namespace

void analyse_series(const AnalyseArguments& arguments) {
  const report::ReaderUnits units(arguments.units);
  const model::Model type = model_of(arguments);
  const analysis::Scenario scenario = scenario_of(arguments);
  std::vector<std::filesystem::path> inputs{arguments.model};
  if (!arguments.scenario.empty()) inputs.emplace_back(arguments.scenario);
  std::optional<OutputFile> page;
  std::optional<OutputFile> figures;
  if (!arguments.report.empty()) page.emplace(arguments.report, inputs);
  if (!arguments.report.empty()) inputs.emplace_back(arguments.report);
  if (!arguments.json.empty()) figures.emplace(arguments.json, inputs);
  const rig::ValveAndCampaign valve = analysis::study_valve(type, scenario);
  const analysis::SeriesStudy study = [&] {
    Progress progress("series", arguments.quiet);
    analysis::StudyWork work = kept_work(arguments);
    work.progress = [&](const std::string& task, double share) {
      progress.task(task);
      progress.update(share);
    };
    return analysis::series_study(type, arguments.model, valve, arguments.series, scenario.seed, work);
  }();
  if (page) report::write_series_study_report(page->stream(), type, study, units);
  if (figures) report::write_series_study_json(figures->stream(), type, study);
  commit_together({page ? &*page : nullptr, figures ? &*figures : nullptr});
  if (const auto state = state_file(arguments)) std::filesystem::remove(*state);
  if (arguments.json == "-" || arguments.report == "-") return;
  print_lines(report::series_verdict(study) + "\n");
  print_text(medians(study));
  flush_standard_output();
}

}  // namespace spoolflow::apps
