#include <algorithm>
#include <array>
#include <ostream>

#include <nlohmann/json.hpp>

#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/report/json/type_json.hpp"
#include "spoolflow/report/validation/verdict.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

using Json = nlohmann::ordered_json;

const char* source_name(validation::MeterSource source) {
  static constexpr std::array names{"given", "this_run", "other_runs", "none"};
  return names.at(static_cast<std::size_t>(source));
}

class MetricsJson {
 public:
  explicit MetricsJson(double full_scale_m3_per_s) : percent_(100 / full_scale_m3_per_s) {}

  [[nodiscard]] Json run(const validation::RunResult& run) const;
  [[nodiscard]] Json pooled(const validation::PooledResult& pooled) const;

 private:
  [[nodiscard]] Json flow(double flow_m3_per_s) const {
    return {{"L_min", units::L_per_min_from_m3_per_s(flow_m3_per_s)}, {"percent_FS", flow_m3_per_s * percent_}};
  }
  [[nodiscard]] Json group(const validation::GroupFigures& group) const;
  void add_metrics(Json& to, const validation::Metrics& metrics) const;
  [[nodiscard]] Json profiles(const std::vector<validation::ErrorProfile>& profiles) const;
  void add_directions(Json& to, const validation::DirectionProfile& profile) const;
  [[nodiscard]] Json sign(const validation::SignFigures& figures) const;
  [[nodiscard]] static Json steps(const validation::StepResponse& response);
  [[nodiscard]] Json estimator(const validation::EstimatorResult& result) const;

  double percent_;
};

Json MetricsJson::group(const validation::GroupFigures& group) const {
  const validation::ErrorFigures& error = group.error;
  if (error.samples == 0) return {{"samples", 0}};
  return {
      {"samples", error.samples},
      {"p95", flow(error.p95)},
      {"rms", flow(error.rms)},
      {"largest", flow(error.largest)},
      {"bias", flow(error.bias)},
      {"band_coverage", group.band_coverage},
      {"band_mean_width", flow(group.band_mean_width_m3_per_s)},
      {"band_mean_width_over_rms", error.rms > 0 ? Json(group.band_mean_width_m3_per_s / error.rms) : Json(nullptr)}};
}

void MetricsJson::add_metrics(Json& to, const validation::Metrics& metrics) const {
  to["error"] = {{"all", group(metrics.all)},
                 {"moving", group(metrics.moving)},
                 {"rest", group(metrics.rest)},
                 {"reversal", group(metrics.reversal)}};
  if (metrics.p_to_b.error.samples + metrics.p_to_a.error.samples > 0) {
    to["error"]["p_to_b"] = group(metrics.p_to_b);
    to["error"]["p_to_a"] = group(metrics.p_to_a);
  }
  const validation::ErrorFigures& reading = metrics.share_of_reading;
  to["error_of_reading_percent"] = {{"samples", reading.samples}};
  if (reading.samples == 0) return;
  to["error_of_reading_percent"].update({{"p95", 100 * reading.p95},
                                         {"rms", 100 * reading.rms},
                                         {"largest", 100 * reading.largest},
                                         {"bias", 100 * reading.bias}});
}

Json MetricsJson::profiles(const std::vector<validation::ErrorProfile>& profiles) const {
  struct Key {
    const char* name;
    double factor, offset;
  };
  constexpr std::array<Key, validation::quantities.size()> keys{
      {{"flow_L_min", units::litre_per_minute_per_m3_per_s, 0},
       {"position_mm", units::millimetre_per_metre, 0},
       {"pressure_difference_bar", 1 / units::pascal_per_bar, 0},
       {"oil_temperature_C", 1, -units::kelvin_at_0_degC}}};
  Json out = Json::object();
  for (std::size_t q = 0; q < profiles.size(); ++q) {
    Json bins = Json::array();
    for (const validation::ProfileBin& bin : profiles[q].bins()) {
      bins.push_back({{"from", bin.from * keys[q].factor + keys[q].offset},
                      {"to", bin.to * keys[q].factor + keys[q].offset},
                      {"samples", bin.samples},
                      {"median_percent_FS", bin.median_m3_per_s * percent_},
                      {"p95_percent_FS", bin.p95_m3_per_s * percent_},
                      {"band_coverage", bin.band_coverage}});
    }
    if (!bins.empty()) out[keys[q].name] = std::move(bins);
  }
  return out;
}

Json MetricsJson::estimator(const validation::EstimatorResult& result) const {
  Json out{{"estimator", estimation::name(result.estimator)}};
  if (result.metrics) add_metrics(out, *result.metrics);
  if (result.worst) {
    out["worst"] = {{"time_s", result.worst->time_s},
                    {"error", flow(result.worst->error_m3_per_s)},
                    {"position_mm", units::mm_from_m(result.worst->position_m)},
                    {"phase", result.worst->moving ? "moving" : (result.worst->rest ? "rest" : "closed")},
                    {"velocity_mm_s", units::mm_from_m(result.worst->velocity_m_per_s)},
                    {"status", result.worst->status}};
    if (result.worst->pressure_difference_Pa) {
      out["worst"]["pressure_difference_bar"] = units::bar_from_Pa(*result.worst->pressure_difference_Pa);
    }
  }
  if (result.direction) add_directions(out, *result.direction);
  if (result.sign) out["sign"] = sign(*result.sign);
  if (result.frequency_response) {
    const validation::FrequencyResponse& response = *result.frequency_response;
    Json points = Json::array();
    for (const validation::FrequencyPoint& point : response.points) {
      points.push_back({{"frequency_Hz", point.frequency_Hz},
                        {"gain", point.gain},
                        {"phase_rad", point.phase_rad},
                        {"coherence", point.coherence}});
    }
    out["frequency_response"] = {{"corner_Hz", response.corner_Hz ? Json(*response.corner_Hz) : Json(nullptr)},
                                 {"points", std::move(points)}};
  }
  Json status = Json::object();
  for (const validation::StatusRow& row : result.status) status[row.name] = row.share;
  out["status_share"] = std::move(status);
  return out;
}

void MetricsJson::add_directions(Json& to, const validation::DirectionProfile& profile) const {
  constexpr std::array names{"opening", "closing", "rest"};
  Json out = Json::object();
  for (const validation::Direction direction : validation::directions) {
    const auto figures = profile.magnitudes(direction);
    if (!figures) continue;
    out[names[static_cast<std::size_t>(direction)]] = {{"samples", figures->samples},
                                                       {"median_percent_FS", figures->median_m3_per_s * percent_},
                                                       {"p95_percent_FS", figures->p95_m3_per_s * percent_}};
  }
  if (const auto hysteresis = profile.hysteresis()) {
    out["hysteresis"] = {{"opening_less_closing", flow(hysteresis->difference_m3_per_s)},
                         {"position_mm", units::mm_from_m(hysteresis->position_m)}};
  }
  to["error_by_direction"] = std::move(out);
}

Json MetricsJson::sign(const validation::SignFigures& figures) const {
  const double samples = static_cast<double>(std::max<std::size_t>(figures.samples, 1));
  return {{"samples", figures.samples},
          {"wrong", figures.wrong},
          {"wrong_share", static_cast<double>(figures.wrong) / samples},
          {"undetermined_share", static_cast<double>(figures.undetermined) / samples},
          {"undetermined_largest_flow", flow(figures.undetermined_largest_m3_per_s)}};
}

Json MetricsJson::steps(const validation::StepResponse& response) {
  const auto milliseconds = [](double seconds) { return 1e3 * seconds; };  // NaN is written as null
  Json out{{"steps", response.steps},
           {"reference_rise_ms", milliseconds(response.reference_rise_s)},
           {"estimators", Json::array()}};
  for (const validation::StepAnswer& answer : response.answers) {
    out["estimators"].push_back({{"estimator", estimation::name(answer.estimator)},
                                 {"followed", answer.followed},
                                 {"delay_ms", milliseconds(answer.delay_s)},
                                 {"rise_ms", milliseconds(answer.rise_s)},
                                 {"overshoot", answer.overshoot}});
  }
  return out;
}

Json MetricsJson::run(const validation::RunResult& run) const {
  Json out{{"file", run.file},
           {"sha256", run.sha256},
           {"samples", run.samples},
           {"reference_lag_s", run.reference_meter.meter.lag_s},
           {"reference_dead_time_s", run.reference_meter.meter.dead_time_s},
           {"reference_lag_source", source_name(run.reference_meter.source)},
           {"duration_s", run.duration_s},
           {"missing_values", run.missing_values},
           {"duplicate_times", run.duplicate_times},
           {"resampled", run.resampled},
           {"has_reference", run.has_reference},
           {"also_calibrated_with", run.calibrated_with},
           {"estimators", Json::array()}};
  if (const auto& uncertainty = run.reference_meter.uncertainty) {
    out["reference_lag_uncertainty_s"] = uncertainty->lag_s;
    out["reference_dead_time_uncertainty_s"] = uncertainty->dead_time_s;
  }
  for (const validation::EstimatorResult& result : run.results) out["estimators"].push_back(estimator(result));
  if (run.step_response) out["step_response"] = steps(*run.step_response);
  if (run.reference_scale) {
    const validation::ReferenceScale& found = *run.reference_scale;
    out["reference_scale"] = {{"scale", found.scale},
                              {"scale_uncertainty", found.scale_uncertainty},
                              {"offset", flow(found.offset_m3_per_s)},
                              {"offset_uncertainty", flow(found.offset_uncertainty_m3_per_s)}};
  }
  if (!run.doubts.empty()) out["doubts"] = run.doubts;
  return out;
}

Json MetricsJson::pooled(const validation::PooledResult& pooled) const {
  Json out{{"estimator", estimation::name(pooled.estimator)}};
  if (pooled.metrics) add_metrics(out, *pooled.metrics);
  if (pooled.by_sample) add_metrics(out["by_sample"], *pooled.by_sample);
  out["error_over"] = profiles(pooled.profiles);
  if (pooled.direction) add_directions(out, *pooled.direction);
  if (pooled.sign) out["sign"] = sign(*pooled.sign);
  return out;
}

Json requirements(const validation::Validation& validation) {
  Json limits = Json::array();
  for (const validation::JudgedLimit& judged : validation.limits) {
    const validation::Limit& limit = judged.limit;
    const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
    limits.push_back({{"run", judged.run},
                      {"estimator", estimation::name(judged.estimator)},
                      {"figure", name_of(validation::figure_names, limit.figure)},
                      {"when", name_of(validation::when_names, limit.when)},
                      {"unit", name_of(validation::limit_unit_names, limit.unit)},
                      {"at_least", number(limit.at_least)},
                      {"at_most", number(limit.at_most)},
                      {"value", number(judged.value)},
                      {"met", judged.met}});
  }
  const bool all = std::ranges::all_of(validation.limits, [](auto& each) { return each.met; });
  return {{"file", validation.requirements_file}, {"met", all}, {"limits", std::move(limits)}};
}

}  // namespace

void write_metrics(std::ostream& out, const model::Model& model, const validation::Validation& validation) {
  const MetricsJson json(model.valve.rated_flow_m3_per_s);
  const Verdict said = verdict(model, validation);
  Json limits = Json::array();
  for (const Text& limit : said.limits) limits.push_back(limit.str());
  Json file{{"format", "spoolflow metrics"},
            {"version", 1},
            {"valve", model.valve.name},
            {"full_scale_L_min", units::L_per_min_from_m3_per_s(model.valve.rated_flow_m3_per_s)},
            {"verdict", said.sentence.str()},
            {"limits", std::move(limits)},
            {"reference_lag_s", validation.reference_lag_s},
            {"reference_lag_applied", validation.reference_lag_applied},
            {"all_runs", Json::array()},
            {"runs", Json::array()}};
  if (!validation.limits.empty()) file["requirements"] = requirements(validation);
  for (const validation::PooledResult& pooled : validation.pooled) file["all_runs"].push_back(json.pooled(pooled));
  for (const validation::RunResult& run : validation.runs) file["runs"].push_back(json.run(run));
  add_type(file, model);
  out << file.dump(1) << '\n';
}

}  // namespace spoolflow::report
