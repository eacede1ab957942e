/// `spoolflow analyse`: how uncertain the flow rate is, why, and what to improve next.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/analysis/analysis.hpp"
#include "spoolflow/analysis/dither_study.hpp"
#include "spoolflow/analysis/ishigami.hpp"
#include "spoolflow/apps/analyse_series.hpp"
#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/elsewhere.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/work/analysed_run.hpp"
#include "spoolflow/report/analysis/analysis_report.hpp"
#include "spoolflow/report/analysis/analysis_verdict.hpp"
#include "spoolflow/report/analysis/dither_report.hpp"
#include "spoolflow/report/json/results_json.hpp"

namespace spoolflow::apps {
namespace {

/// Of the whole work, where there is a global study.
constexpr double budget_share = 0.25;

/// Status 1 where the check fails: the program is at fault, not its input.
struct SelfCheckFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void self_check(const AnalyseArguments& arguments) {
  const analysis::SelfCheck check = analysis::check_ishigami(arguments.samples == 0 ? 1024 : arguments.samples,
                                                             arguments.seed == 0 ? 1 : arguments.seed);
  Outputs outputs;
  if (OutputFile* const file = outputs.open_if_named(arguments.json))
    report::write_self_check_json(file->stream(), check);
  outputs.commit();
  if (arguments.json != "-") {
    std::string text = fmt::format("Ishigami function, {} base samples, seed {}\n", check.base_samples, check.seed);
    for (std::size_t f = 0; f < check.found.factors.size(); ++f) {
      const auto& [first, total] = check.found.factors[f];
      text += fmt::format(
          "x{}: first order {:6.3f} [{:6.3f}, {:6.3f}], exact {:.3f}; total {:6.3f} [{:6.3f}, {:6.3f}], exact {:.3f}\n",
          f + 1, first.value, first.lower, first.upper, check.first_order[f], total.value, total.lower, total.upper,
          check.total[f]);
    }
    print_lines(text);
  }
  if (!check.passed) throw SelfCheckFailed("self-check: a known index lies outside its confidence interval");
}

analysis::RunSamples run_of(const model::Model& model, const AnalyseArguments& arguments) {
  AnalysedRun run = read_analysed_run(model, arguments.recording, channels_from(arguments.channels));
  if (!run.resampled.empty()) say("{}: {}\n", arguments.recording, run.resampled);
  return std::move(run.samples);
}

analysis::Study study(const model::Model& model, const analysis::Scenario& scenario, const rig::ValveAndCampaign& valve,
                      const AnalyseArguments& arguments, analysis::RunsWork done_elsewhere, Progress& progress) {
  analysis::StudyWork work = kept_work(arguments);
  work.progress = [&](const std::string& task, double share) {
    progress.update(task, budget_share + (1 - budget_share) * share);
  };
  work.elsewhere = std::move(done_elsewhere);
  return analysis::global_study(model, scenario, valve, work);
}

void analyse_dither(const AnalyseArguments& arguments) {
  const report::ReaderUnits units(arguments.units);
  const model::Model model = model_of(arguments);
  analysis::DitherQuestion question;
  question.points = scenario_of(arguments).points;
  question.shape = arguments.dither_shape == "sine" ? analysis::DitherShape::sine : analysis::DitherShape::square;
  question.ripple_limit_share = 0.01 * arguments.ripple_limit_percent;
  Outputs outputs(inputs_of(arguments));
  OutputFile *const page = outputs.open_if_named(arguments.report), *figures = outputs.open_if_named(arguments.json);
  const analysis::DitherStudy results = [&] {
    Progress progress("dither", arguments.quiet);
    return analysis::dither_study(model, question, workers(arguments));
  }();
  if (page != nullptr) report::write_dither_report(page->stream(), model, results, units);
  if (figures != nullptr) report::write_dither_json(figures->stream(), model, results);
  outputs.commit();
  if (arguments.json == "-" || arguments.report == "-") return;
  const report::DitherVerdict verdict = report::dither_verdict(model, results);
  std::string text = verdict.sentence.in(units) + "\n";
  for (const report::Text& remark : verdict.remarks) text += "- " + remark.in(units) + "\n";
  print_lines(text);
}

void analyse(const AnalyseArguments& arguments) {
  if (arguments.print_scenario) return print_lines(analysis::scenario_template());
  if (!arguments.self_check.empty()) return self_check(arguments);
  if (arguments.model.empty()) throw CLI::RequiredError("model");
  if (arguments.dither) return analyse_dither(arguments);
  if (arguments.series > 0) return analyse_series(arguments);
  const report::ReaderUnits units(arguments.units);
  const model::Model model = model_of(arguments);
  analysis::Analysis results{scenario_of(arguments), {}, {}, {}, {}};
  Outputs outputs(inputs_of(arguments, results.scenario.study.valve));
  OutputFile *const page = outputs.open_if_named(arguments.report), *figures = outputs.open_if_named(arguments.json);
  const bool whole = !results.scenario.study.skip;
  std::optional<analysis::RunSamples> run;
  if (!arguments.recording.empty()) run = run_of(model, arguments);
  std::optional<rig::ValveAndCampaign> valve;
  if (whole) valve = analysis::study_valve(model, results.scenario);
  analysis::RunsWork done_elsewhere;
  if (whole && !arguments.fleet.empty()) {
    done_elsewhere = elsewhere().study(
        {arguments.fleet, arguments.model, model.valve.direction, results.scenario, arguments.scenario});
  }
  {
    const double share_of_budget = whole ? budget_share : 1;
    Progress progress("uncertainty budget", arguments.quiet);
    const double points_until = run ? 0.35 : 0.7;
    const double run_from = run ? 0.5 : 1;
    results.points = analysis::analyse_points(model, results.scenario, workers(arguments), [&](double share) {
      progress.update(share_of_budget * points_until * share);
    });
    results.maps = analysis::operating_maps(model, results.scenario, workers(arguments), [&](double share) {
      progress.update(share_of_budget * (points_until + (run_from - points_until) * share));
    });
    if (run) {
      progress.task("budget along the run");
      results.run = analysis::analyse_run(model, *run, results.scenario, workers(arguments), [&](double share) {
        progress.update(share_of_budget * (run_from + (1 - run_from) * share));
      });
    }
    if (whole) results.study = study(model, results.scenario, *valve, arguments, std::move(done_elsewhere), progress);
  }
  if (page != nullptr) report::write_analysis_report(page->stream(), model, results, units);
  if (figures != nullptr) report::write_analysis_json(figures->stream(), model, results);
  outputs.commit();
  if (const auto state = state_file(arguments)) std::filesystem::remove(*state);
  if (arguments.json != "-" && arguments.report != "-") {
    const report::AnalysisVerdict verdict = report::analysis_verdict(model, results);
    std::string text = verdict.sentence + "\n";
    for (const std::string& remark : verdict.remarks) text += "- " + remark + "\n";
    print_lines(text);
  }
}

/// `of_the_budget`: options that have no meaning beside --dither.
void add_dither_options(CLI::App& command, AnalyseArguments& arguments,
                        const std::vector<CLI::Option*>& of_the_budget) {
  CLI::Option* const dither = command.add_flag("--dither", arguments.dither,
                                               "how to dither instead: band at rest and flow ripple, and what to set");
  for (CLI::Option* const other : of_the_budget) dither->excludes(other);
  command
      .add_option("--ripple-limit", arguments.ripple_limit_percent,
                  "of the flow that dither may make, half of peak to peak in % of full scale")
      ->type_name("PERCENT")
      ->check(between(0.001, 100.0))
      ->capture_default_str()
      ->needs(dither);
  command.add_option("--dither-shape", arguments.dither_shape, "course of the dither's current")
      ->type_name("SHAPE")
      ->check(CLI::IsMember({"sine", "square"}))
      ->capture_default_str()
      ->needs(dither);
}

}  // namespace

void add_analyse_command(CLI::App& program) {
  auto arguments = std::make_shared<AnalyseArguments>();
  CLI::App* command = add_command(
      program,
      {"analyse",
       "how uncertain the flow rate is, why, and what to improve next",
       "MODEL.json; a scenario (TOML) may name working points, instruments and spreads, --print-scenario prints one",
       "the uncertainty budget with its check by Monte Carlo and the sensitivities as JSON; the verdict on standard "
       "output",
       {"spoolflow analyse valve_a.json --json analysis.json",
        "spoolflow analyse valve_a.json --dither --ripple-limit 0.3 --report dither.html",
        "spoolflow analyse type_a.json --series 200 --json series.json --report series.html"}});
  command->add_option("model", arguments->model, "model file");
  command->add_option("--scenario", arguments->scenario, "what to analyse; every key has a default")
      ->type_name("S.toml");
  CLI::Option* const recording =
      command->add_option("--recording", arguments->recording, "a run along which the budget is made up as well")
          ->type_name("RECORDING");
  command->add_option("--channels", arguments->channels, "channel map (TOML) of a recording with other column names")
      ->type_name("MAP.toml");
  command->add_option("--report", arguments->report, "HTML report to write")->type_name("REPORT.html");
  command->add_option("--json", arguments->json, "figures to write as JSON; - for standard output")
      ->type_name("OUT.json");
  CLI::Option* const samples = command->add_option("--samples", arguments->samples, "base samples of the global study")
                                   ->type_name("N")
                                   ->check(CLI::Range(2U, 65536U));
  command->add_option("--seed", arguments->seed, "of all random numbers, instead of the scenario's")
      ->type_name("N")
      ->check(whole_number_from(1));
  command->add_option("--jobs", arguments->jobs, "threads; all cores where not given; the result is the same")
      ->type_name("N")
      ->check(CLI::Range(1U, 1024U));
  command
      ->add_option("--direction", arguments->direction,
                   "of a whole valve the flow analysed: b (P to B, default) or a (P to A)")
      ->type_name("NAME")
      ->check(CLI::IsMember({"a", "b"}));
  CLI::Option* const fleet = add_fleet_option(*command, arguments->fleet, "of the global study");
  CLI::Option* const series = command
                                  ->add_option("--series", arguments->series,
                                               "judge virtual units of a type instead: by type, minute, campaign")
                                  ->type_name("UNITS")
                                  ->check(CLI::Range(1U, 10000U));
  for (CLI::Option* const other : {recording, samples, fleet}) series->excludes(other);
  add_dither_options(*command, *arguments, {recording, samples, fleet, series});
  command->add_flag("--print-scenario", arguments->print_scenario, "print a scenario with all keys and end");
  command->add_option("--self-check", arguments->self_check, "check the Sobol indices on a function whose are known")
      ->type_name("NAME")
      ->check(CLI::IsMember({"ishigami"}));
  add_units(*command, arguments->units);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { analyse(*arguments); });
}

}  // namespace spoolflow::apps
