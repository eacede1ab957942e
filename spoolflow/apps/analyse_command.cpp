/// `spoolflow analyse`: how uncertain the flow rate is, why, and what to improve next.
#include <fstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/analysis/analysis.hpp"
#include "spoolflow/analysis/dither_study.hpp"
#include "spoolflow/analysis/ishigami.hpp"
#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/elsewhere.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/suggestion.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/apps/work/analysed_run.hpp"
#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/report/analysis/analysis_report.hpp"
#include "spoolflow/report/analysis/analysis_verdict.hpp"
#include "spoolflow/report/analysis/dither_report.hpp"
#include "spoolflow/report/json/analysis_json.hpp"
#include "spoolflow/report/json/dither_json.hpp"

namespace spoolflow::apps {
namespace {

struct AnalyseArguments {
  std::string model;
  std::string scenario;
  std::string json;
  std::string report;
  std::string recording;
  std::string channels;
  std::string self_check;
  std::string fleet;  ///< whose workers do the runs of the study; empty: this machine
  std::vector<std::string> units;
  std::uint32_t samples = 0;  ///< 0: as the scenario says
  std::uint64_t seed = 0;     ///< 0: as the scenario says
  unsigned jobs = 0;          ///< 0: all cores
  std::string direction;      ///< "a" or "b"; empty: that of the model, of a whole valve "b"
  std::string dither_shape = "sine";
  double ripple_limit_percent = 0.5;
  bool dither = false;
  bool print_scenario = false;
  bool quiet = false;
};

/// Of the whole work, where there is a global study.
constexpr double budget_share = 0.25;

/// Status 1 where the check fails: the program is at fault, not its input.
struct SelfCheckFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void print_lines(const std::string& text) {
  print_text(terminal_lines(text));
  flush_standard_output();
}

void self_check(const AnalyseArguments& arguments) {
  const analysis::SelfCheck check = analysis::check_ishigami(arguments.samples == 0 ? 1024 : arguments.samples,
                                                             arguments.seed == 0 ? 1 : arguments.seed);
  if (!arguments.json.empty()) {
    OutputFile output(arguments.json);
    report::write_self_check_json(output.stream(), check);
    output.commit();
  }
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

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Where an interrupted study keeps its finished runs: beside the output, if that is a file.
std::optional<std::filesystem::path> state_file(const AnalyseArguments& arguments) {
  for (const std::string& output : {arguments.json, arguments.report}) {
    if (!output.empty() && output != "-" && !output.starts_with("/dev/")) return output + ".study";
  }
  return std::nullopt;
}

/// The model, or of a whole valve the model of the direction asked for. Throws where the model knows another one only.
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

analysis::RunSamples run_of(const model::Model& model, const AnalyseArguments& arguments) {
  recording::ChannelMap channels;
  if (!arguments.channels.empty()) channels = recording::read_channel_map(arguments.channels);
  AnalysedRun run = read_analysed_run(model, arguments.recording, std::move(channels));
  if (!run.resampled.empty()) say("{}: {}\n", arguments.recording, run.resampled);
  return std::move(run.samples);
}

analysis::Study study(const model::Model& model, const analysis::Scenario& scenario, const rig::ValveAndCampaign& valve,
                      const AnalyseArguments& arguments, analysis::RunsWork done_elsewhere, Progress& progress) {
  analysis::StudyWork work{.identity = std::string(tool_version()), .workers = workers(arguments)};
  const std::optional<std::filesystem::path> state = state_file(arguments);
  if (state) {
    work.saved = bytes_of(*state);
    work.save = [&](const std::string& text) {
      OutputFile output(*state);
      output.stream() << text;
      output.commit();
    };
  }
  work.progress = [&](const std::string& task, double share) {
    progress.task(task);
    progress.update(budget_share + (1 - budget_share) * share);
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
  std::vector<std::filesystem::path> inputs{arguments.model};
  if (!arguments.scenario.empty()) inputs.emplace_back(arguments.scenario);
  std::optional<OutputFile> page;
  std::optional<OutputFile> figures;
  if (!arguments.report.empty()) page.emplace(arguments.report, inputs);
  if (!arguments.report.empty()) inputs.emplace_back(arguments.report);
  if (!arguments.json.empty()) figures.emplace(arguments.json, inputs);
  const analysis::DitherStudy results = [&] {
    Progress progress("dither", arguments.quiet);
    return analysis::dither_study(model, question, workers(arguments));
  }();
  if (page) report::write_dither_report(page->stream(), model, results, units);
  if (figures) report::write_dither_json(figures->stream(), model, results);
  commit_together({page ? &*page : nullptr, figures ? &*figures : nullptr});
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
  const report::ReaderUnits units(arguments.units);
  const model::Model model = model_of(arguments);
  analysis::Analysis results{scenario_of(arguments), {}, {}, {}, {}};
  std::vector<std::filesystem::path> inputs{arguments.model};
  if (!arguments.scenario.empty()) inputs.emplace_back(arguments.scenario);
  for (const std::string& file : {arguments.recording, arguments.channels}) {
    if (!file.empty()) inputs.emplace_back(file);
  }
  std::optional<OutputFile> page;
  std::optional<OutputFile> figures;
  if (!arguments.report.empty()) page.emplace(arguments.report, inputs);
  if (!arguments.report.empty()) inputs.emplace_back(arguments.report);
  if (!arguments.json.empty()) figures.emplace(arguments.json, inputs);
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
  if (page) report::write_analysis_report(page->stream(), model, results, units);
  if (figures) report::write_analysis_json(figures->stream(), model, results);
  commit_together({page ? &*page : nullptr, figures ? &*figures : nullptr});
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
      ->check(CLI::Range(0.001, 100.0))
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
        "spoolflow analyse valve_a.json --dither --ripple-limit 0.3 --report dither.html"}});
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
      ->check(CLI::PositiveNumber);
  command->add_option("--jobs", arguments->jobs, "threads; all cores where not given; the result is the same")
      ->type_name("N")
      ->check(CLI::Range(1U, 1024U));
  command
      ->add_option("--direction", arguments->direction,
                   "of a whole valve the flow analysed: b (P to B, default) or a (P to A)")
      ->type_name("NAME")
      ->check(CLI::IsMember({"a", "b"}));
  CLI::Option* const fleet = add_fleet_option(*command, arguments->fleet, "of the global study");
  add_dither_options(*command, *arguments, {recording, samples, fleet});
  command->add_flag("--print-scenario", arguments->print_scenario, "print a scenario with all keys and end");
  command->add_option("--self-check", arguments->self_check, "check the Sobol indices on a function whose are known")
      ->type_name("NAME")
      ->check(CLI::IsMember({"ishigami"}));
  add_units(*command, arguments->units);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { analyse(*arguments); });
}

}  // namespace spoolflow::apps
