#include "spoolflow/report/metrics_json.hpp"

#include <ostream>

#include <nlohmann/json.hpp>

#include "spoolflow/report/validation_report.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

using Json = nlohmann::ordered_json;

Json figures(const validation::ErrorFigures& figures, double full_scale) {
  const auto both = [&](double value) {
    return Json{{"percent_FS", 100 * value / full_scale}, {"L_min", units::L_per_min_from_m3_per_s(value)}};
  };
  if (figures.samples == 0) return {{"samples", 0}};
  return {{"p95", both(figures.p95)},
          {"rms", both(figures.rms)},
          {"max", both(figures.largest)},
          {"bias", both(figures.bias)},
          {"samples", figures.samples}};
}

Json result(const validation::EstimatorResult& result, double full_scale) {
  Json out{{"estimator", validation::name(result.estimator)}};
  if (result.metrics) {
    const validation::Metrics& m = *result.metrics;
    out["error"] = {{"all", figures(m.all, full_scale)},
                    {"moving", figures(m.moving, full_scale)},
                    {"rest", figures(m.rest, full_scale)},
                    {"reversal", figures(m.reversal, full_scale)}};
    out["error_of_reading_percent"] = {{"p95", 100 * m.share_of_reading.p95},
                                       {"rms", 100 * m.share_of_reading.rms},
                                       {"samples", m.share_of_reading.samples}};
    out["band"] = {
        {"coverage", m.band_coverage},
        {"mean_width_percent_FS", 100 * m.band_mean_width_m3_per_s / full_scale},
        {"mean_width_over_rms", m.all.rms > 0 ? Json(m.band_mean_width_m3_per_s / m.all.rms) : Json(nullptr)}};
  }
  Json status = Json::object();
  for (const validation::StatusShare& share : result.status) status[share.name] = share.share;
  out["status_share"] = status;
  return out;
}

}  // namespace

void write_metrics(std::ostream& out, const model::Model& model, const std::vector<validation::ValidatedRun>& runs,
                   const validation::ValidationOptions& options) {
  Json file{{"valve", model.valve.name},
            {"full_scale_L_min", units::L_per_min_from_m3_per_s(model.valve.rated_flow_m3_per_s)},
            {"verdict", verdict(model, runs)},
            {"reference_lag_s", options.reference_lag_s},
            {"reference_lag_applied", options.apply_reference_lag},
            {"runs", Json::array()}};
  for (const validation::ValidatedRun& run : runs) {
    Json each{{"file", run.file},
              {"samples", run.time_s.size()},
              {"duplicate_times", run.notes.duplicate_times},
              {"missing_values", run.notes.missing_values},
              {"has_reference", !run.reference_m3_per_s.empty()},
              {"estimators", Json::array()}};
    for (const validation::EstimatorResult& estimator : run.results) {
      each["estimators"].push_back(result(estimator, model.valve.rated_flow_m3_per_s));
    }
    file["runs"].push_back(std::move(each));
  }
  out << file.dump(1) << '\n';
}

}  // namespace spoolflow::report
