#include "addons/playground/requests/recorded_work.hpp"

#include <ostream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/apps/work/estimate_table.hpp"
#include "spoolflow/apps/work/inspection_text.hpp"
#include "spoolflow/apps/work/notes.hpp"
#include "spoolflow/apps/work/readable_model.hpp"
#include "spoolflow/calibration/calibrate.hpp"
#include "spoolflow/estimation/columns.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/plausibility/run_findings.hpp"
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"
#include "spoolflow/report/calibration/calibration_summary.hpp"
#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/report/validation/validation_report.hpp"
#include "spoolflow/report/validation/verdict.hpp"
#include "spoolflow/rig/bench/recording_file.hpp"
#include "spoolflow/rig/bench/scenario.hpp"
#include "spoolflow/validation/estimate_summary.hpp"

namespace spoolflow::playground {
namespace {

using Json = nlohmann::json;

std::unique_ptr<std::ostream> opened(const Outlet& outlet, const std::string& file) {
  std::unique_ptr<std::ostream> out = outlet.opened(file);
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", file));
  return out;
}

/// For text alone, which is written from its beginning to its end.
class OneStream final : public recording::TableOutput {
 public:
  explicit OneStream(std::ostream& stream) : stream_(stream) {}
  std::ostream& in_sequence() override { return stream_; }
  recording::PlacedBytes& in_places() override { throw std::logic_error("text is written in sequence"); }
  recording::PlacedBytes& scratch() override { throw std::logic_error("text needs no room beside it"); }

 private:
  std::ostream& stream_;
};

recording::ChannelMap channels_of(const Json& asked) {
  const std::string file = asked.value("channels", "");
  return file.empty() ? recording::ChannelMap{} : recording::read_channel_map(file);
}

Json texts(const std::vector<report::Text>& lines) {
  Json out = Json::array();
  for (const report::Text& line : lines) out.push_back(line.str());
  return out;
}

}  // namespace

Json inspect(const Json& asked, const Outlet& outlet) {
  const std::string file = asked.at("file");
  recording::ReadOptions options;
  options.channels = channels_of(asked);
  const recording::Inspection found = recording::inspect(
      file, options,
      [&](std::optional<double> share, std::uint64_t) { outlet.progress(share.value_or(0), "inspecting"); });
  const apps::InspectedFile inspected{
      .file = file, .map_file = asked.value("channels", ""), .map = options.channels, .found = found};
  return {{"text", apps::inspection_text(inspected)}, {"inspection", Json::parse(apps::inspection_json(found))}};
}

Json calibrate(const Json& asked, const Outlet& outlet) {
  const std::string model_file = asked.at("model");
  const recording::Campaign campaign = recording::read_campaign(asked.at("campaign").get<std::string>());
  const model::Model model = calibration::calibrate(
      campaign, SPOOLFLOW_VERSION, [&](const std::string& step, double share) { outlet.progress(share, step); },
      asked.value("despite_doubts", false) ? calibration::Contradictions::noted : calibration::Contradictions::refused);
  *opened(outlet, model_file) << apps::readable_text(model, model_file);
  const auto page = opened(outlet, asked.at("report"));
  report::write_calibration_report(*page, model);
  Json summary = Json::array();
  for (const char* direction : {"b", "a"}) {
    if (!model.whole() && *direction == 'a') break;
    const model::Model one = model.whole() ? model::of_direction(model, direction) : model;
    for (const report::SummaryLine& line : report::calibration_summary(one)) {
      summary.push_back({{"direction", model.whole() ? model::flow_of(direction) : ""},
                         {"of", line.of},
                         {"value", line.value},
                         {"unit", line.unit},
                         {"usual", line.usual},
                         {"usually", line.usually}});
    }
  }
  return {{"valve", model.valve.name},
          {"sentence", report::calibration_verdict(model).sentence.str()},
          {"doubts", model.provenance.doubts},
          {"summary", summary}};
}

Json estimate(const Json& asked, const Outlet& outlet) {
  const model::Model model = model::read_model(asked.at("model").get<std::string>());
  const std::string file = asked.at("recording");
  const auto reader = estimation::open_sensor_channels(file, estimation::sensor_channels(model, channels_of(asked)));
  estimation::RunningSensor sensor = estimation::running_sensor(model, estimation::best_estimator(model));
  const auto stream = opened(outlet, asked.at("output"));
  OneStream output(*stream);
  const auto out = recording::csv_table_writer(apps::estimate_table(), output);
  recording::TableRows rows;
  validation::EstimateSummary summary{.file = file};
  plausibility::RunMeans means;
  recording::SampleBlock block;
  std::vector<sensor::Estimate<double>> estimates;
  while (reader->next(block)) {
    estimates.resize(block.rows);
    estimation::run(sensor, estimation::sensor_columns(block), estimates);
    means.take(block);
    apps::put_estimates(rows, block.column(recording::Channel::time), estimates);
    out->write(rows);
    summary.add(estimates);
    outlet.progress(reader->progress().value_or(0), "estimating");
  }
  out->finish();
  summary.notes = reader->notes();
  Json doubts = Json::array();
  for (const plausibility::Finding& finding : plausibility::run_findings(plausibility::known_valve(model), means, file))
    doubts.push_back(finding.text);
  return {{"sentence", summary.sentence(model.valve.rated_flow_m3_per_s)},
          {"notes", apps::notes_text(summary.notes, file)},
          {"doubts", doubts}};
}

Json validate(const Json& asked, const Outlet& outlet) {
  const model::Model model = model::read_model(asked.at("model").get<std::string>());
  const auto recordings = asked.at("recordings").get<std::vector<std::string>>();
  const validation::ValidationOptions options{.estimators = estimation::all_estimators(model),
                                              .channels = channels_of(asked)};
  const validation::Validation validation =
      validation::validate(model, {recordings.begin(), recordings.end()}, options,
                           [&](double share) { outlet.progress(share, "validating"); });
  const auto page = opened(outlet, asked.at("report"));
  report::write_validation_report(*page, model, validation);
  const auto metrics = opened(outlet, asked.at("metrics"));
  report::write_metrics(*metrics, model, validation);
  const report::Verdict said = report::verdict(model, validation);
  return {{"sentence", said.sentence.str()}, {"limits", texts(said.limits)}};
}

Json simulate(const Json& asked, const Outlet& outlet) {
  const rig::PlannedScenario planned = rig::plan(rig::read_scenario(asked.at("scenario").get<std::string>()));
  const rig::Simulation simulation =
      rig::simulate(planned.valve, planned.run, planned.valve.seed,
                    {.with_truth = true, .progress = [&](double share) { outlet.progress(share, "simulating"); }});
  const auto recording = opened(outlet, asked.at("recording"));
  rig::write_recording(*recording, simulation.recording, planned.run);
  const auto truth = opened(outlet, asked.at("truth"));
  rig::write_truth(*truth, simulation.truth);
  return {{"samples", simulation.truth.size()}};
}

}  // namespace spoolflow::playground
