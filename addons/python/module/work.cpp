#include <fstream>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <sstream>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/models.hpp"
#include "addons/python/module/page_text.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/analysis/analysis.hpp"
#include "spoolflow/analysis/dither_study.hpp"
#include "spoolflow/apps/work/analysed_run.hpp"
#include "spoolflow/apps/work/corrected_model.hpp"
#include "spoolflow/apps/work/monitored_recording.hpp"
#include "spoolflow/apps/work/readable_model.hpp"
#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/report/analysis/analysis_report.hpp"
#include "spoolflow/report/analysis/dither_report.hpp"
#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/report/monitor/monitor_report.hpp"
#include "spoolflow/report/validation/validation_report.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;
using Path = std::filesystem::path;

/// Figures as the command writes them as JSON, the page, and what else was asked for.
struct Judgement {
  std::string figures;
  std::optional<std::string> page;
  std::optional<std::string> more{};  ///< a model file's text, a verdict
  std::vector<std::string> notes{};   ///< of recordings as they were read: columns on another time, or not read
  [[nodiscard]] py::tuple tuple() const { return py::make_tuple(figures, page, more, notes); }

  void note(const Path& recording, const std::string& as_read) {
    if (!as_read.empty()) notes.push_back(recording.string() + ": " + as_read);
  }
};

recording::ChannelMap channel_map(const std::optional<Path>& file) {
  return file ? recording::read_channel_map(*file) : recording::ChannelMap{};
}

std::vector<estimation::Estimator> chosen(const std::string& name, const model::Model& model) {
  if (name == "both") return estimation::all_estimators(model);
  if (name == "condensed") return {estimation::Estimator::condensed};
  if (name == "observer") return {estimation::Estimator::observer};
  throw std::invalid_argument("estimator: " + name + " not in {both,condensed,observer}");
}

py::tuple validate(const SharedModel& kept, const std::vector<Path>& recordings, const std::optional<Path>& channels,
                   const std::string& estimator, const std::optional<Path>& requirements,
                   const std::optional<double>& reference_lag_s, bool apply_reference_lag,
                   const std::vector<Path>& compare, const PageUnits& units, const py::object& progress) {
  return at_work([&](SignalCheck& check) {
           const model::Model& model = kept->model;
           std::vector<report::ComparedValidation> others;
           for (const Path& metrics : compare) others.push_back(report::read_compared(metrics));
           validation::ValidationOptions options{chosen(estimator, model), channel_map(channels), reference_lag_s,
                                                 apply_reference_lag};
           if (requirements) options.requirements = validation::read_requirements(*requirements);
           const validation::Validation found =
               validation::validate(model, recordings, options, [&](double share) { check(progress, share); });
           Judgement out{text_of([&](std::ostream& json) { report::write_metrics(json, model, found); }),
                         page_of(units, [&](std::ostream& page, const report::ReaderUnits& in) {
                           report::write_validation_report(page, model, found, others, in);
                         })};
           for (std::size_t k = 0; k < found.runs.size(); ++k) out.note(recordings.at(k), found.runs[k].resampled);
           return out;
         })
      .tuple();
}

py::tuple monitor_recordings(const SharedModel& kept, const std::vector<Path>& recordings,
                             const std::optional<Path>& channels, const std::string& baseline,
                             double false_alarms_per_year, bool adapt, const PageUnits& units,
                             const py::object& progress) {
  return at_work([&](SignalCheck& check) {
           const model::Model& model = kept->model;
           const recording::ChannelMap map = channel_map(channels);
           monitor::Monitor watch(model, {false_alarms_per_year}, apps::read_baseline(baseline));
           apps::MonitoredRuns done;
           apps::Monitored from{model, model::sha256_of_text(kept->text), recordings, {}, SPOOLFLOW_VERSION};
           std::uint64_t before_it = 0;
           std::vector<std::string> files;
           for (const Path& recording : recordings) files.push_back(recording.string());
           apps::refuse_given_twice(files);
           std::vector<apps::WatchedRecording> watched;
           for (const Path& recording : recordings) {
             const auto report_share = [&](std::optional<double> share) {
               const auto before = static_cast<double>(done.runs.size());
               check(progress, (before + share.value_or(0)) / static_cast<double>(recordings.size()));
             };
             watched.push_back(
                 apps::monitor_recording(model, recording.string(), map, watch, done.trend, done.band, report_share));
             done.runs.push_back({recording.stem().string(), watch.condition(), watch.causes(), watch.indicators()});
             from.samples.push_back(watch.usage().samples - before_it);
             before_it = watch.usage().samples;
           }
           Judgement out{text_of([&](std::ostream& json) {
                           report::write_monitor_json(json, model, watch, done.runs, done.band.figures());
                         }),
                         page_of(units, [&](std::ostream& page, const report::ReaderUnits& in) {
                           report::write_monitor_report(page, model, watch, done.runs, done.trend, in);
                         })};
           for (std::size_t k = 0; k < recordings.size(); ++k) {
             out.note(recordings[k], watched[k].as_read);
             for (const plausibility::Finding& finding : watched[k].findings)
               out.notes.push_back(apps::doubt_text(finding));
           }
           if (adapt) out.more = apps::readable_text(apps::corrected_model(from, watch), "the corrected model");
           return out;
         })
      .tuple();
}

/// What is analysed beside the scenario's file.
struct AnalysisRequest {
  std::optional<Path> scenario;
  std::optional<std::uint32_t> samples;
  std::optional<std::uint64_t> seed;
  std::optional<bool> study;
  unsigned workers;
  std::string direction;
  std::optional<Path> recording;  ///< a run along which the budget is made up as well
  std::optional<Path> channels;
  [[nodiscard]] unsigned threads() const { return workers == 0 ? parallel::cores() : workers; }
};

analysis::Scenario scenario_of(const AnalysisRequest& asked) {
  analysis::Scenario out;
  if (asked.scenario) out = analysis::read_scenario(*asked.scenario);
  if (asked.samples) out.study.base_samples = *asked.samples;
  if (asked.seed) out.seed = *asked.seed;
  if (asked.study) out.study.skip = !*asked.study;
  return out;
}

model::Model analysed_model(const SharedModel& kept, const std::string& direction) {
  return kept->model.whole() ? model::of_direction(kept->model, direction) : kept->model;
}

py::tuple analyse(const SharedModel& kept, const AnalysisRequest& asked, const PageUnits& units,
                  const py::object& progress) {
  return at_work([&](SignalCheck& check) {
           const model::Model model = analysed_model(kept, asked.direction);
           const unsigned workers = asked.threads();
           std::optional<apps::AnalysedRun> run;
           if (asked.recording) {
             run = apps::read_analysed_run(model, asked.recording->string(), channel_map(asked.channels));
           }
           analysis::Analysis results{scenario_of(asked), {}, {}, {}, {}};
           const bool whole = !results.scenario.study.skip;
           std::optional<rig::ValveAndCampaign> valve;
           if (whole) valve = analysis::study_valve(model, results.scenario);
           const double of_points = whole ? 0.25 : 1;
           results.points = analysis::analyse_points(model, results.scenario, workers, [&](double share) {
             check(progress, "uncertainty budget", of_points * 0.7 * share);
           });
           results.maps = analysis::operating_maps(model, results.scenario, workers, [&](double share) {
             check(progress, "operating maps", of_points * (0.7 + 0.3 * share));
           });
           if (run) {
             results.run = analysis::analyse_run(model, run->samples, results.scenario, workers,
                                                 [&](double) { check(progress, "budget along the run", of_points); });
           }
           if (whole) {
             analysis::StudyWork work{.identity = SPOOLFLOW_VERSION, .workers = workers};
             work.progress = [&](const std::string& task, double share) {
               check(progress, task, of_points + (1 - of_points) * share);
             };
             results.study = analysis::global_study(model, results.scenario, *valve, work);
           }
           Judgement out{text_of([&](std::ostream& json) { report::write_analysis_json(json, model, results); }),
                         page_of(units, [&](std::ostream& page, const report::ReaderUnits& in) {
                           report::write_analysis_report(page, model, results, in);
                         })};
           if (run) out.note(*asked.recording, run->resampled);
           return out;
         })
      .tuple();
}

/// How to dither.
py::tuple dither(const SharedModel& kept, const AnalysisRequest& asked, const std::string& shape,
                 double ripple_limit_share, const PageUnits& units) {
  return at_work([&](SignalCheck&) {
           const model::Model model = analysed_model(kept, asked.direction);
           analysis::DitherQuestion question;
           question.points = scenario_of(asked).points;
           question.shape = shape == "sine" ? analysis::DitherShape::sine : analysis::DitherShape::square;
           question.ripple_limit_share = ripple_limit_share;
           const analysis::DitherStudy found = analysis::dither_study(model, question, asked.threads());
           const report::DitherVerdict said = report::dither_verdict(model, found);
           return Judgement{text_of([&](std::ostream& json) { report::write_dither_json(json, model, found); }),
                            page_of(units,
                                    [&](std::ostream& page, const report::ReaderUnits& in) {
                                      report::write_dither_report(page, model, found, in);
                                    }),
                            said.sentence.str()};
         })
      .tuple();
}

}  // namespace

void add_work(py::module_& module) {
  module.def("validate", &validate);
  module.def("monitor", &monitor_recordings);
  module.def("analyse", [](const SharedModel& model, const std::optional<Path>& scenario,
                           const std::optional<std::uint32_t>& samples, const std::optional<std::uint64_t>& seed,
                           const std::optional<bool>& study, unsigned workers, const std::string& direction,
                           const std::optional<Path>& recording, const std::optional<Path>& channels,
                           const PageUnits& units, const py::object& progress) {
    return analyse(model, {scenario, samples, seed, study, workers, direction, recording, channels}, units, progress);
  });
  module.def("dither", [](const SharedModel& model, const std::optional<Path>& scenario, unsigned workers,
                          const std::string& direction, const std::string& shape, double ripple_limit_share,
                          const PageUnits& units) {
    return dither(model, {scenario, {}, {}, {}, workers, direction, {}, {}}, shape, ripple_limit_share, units);
  });
}

}  // namespace spoolflow::python
