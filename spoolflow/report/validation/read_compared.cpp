#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/model/json_text.hpp"
#include "spoolflow/report/validation/comparison.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* remedy = "give a file that `spoolflow validate --json` wrote";

/// One value of the file by its place, such as "/all_runs/0/estimator".
template <class Value>
Value at(const Json& json, const std::string& place, const std::filesystem::path& file) {
  try {
    return json.at(Json::json_pointer(place)).get<Value>();
  } catch (const Json::exception&) {
    throw MetricsError(fmt::format("{}: {} is missing or of another type; {}", file.string(), place, remedy));
  }
}

ComparedEstimator estimator_at(const Json& json, const std::string& place, const std::filesystem::path& file) {
  const auto percent = [&](const char* figure) {
    return at<double>(json, fmt::format("{}/error/all/{}/percent_FS", place, figure), file);
  };
  ComparedEstimator out{at<std::string>(json, place + "/estimator", file),
                        percent("p95"),
                        percent("rms"),
                        percent("largest"),
                        percent("bias"),
                        100 * at<double>(json, place + "/error/all/band_coverage", file),
                        percent("band_mean_width")};
  const Json::json_pointer bins(place + "/error_over/pressure_difference_bar");
  for (std::size_t b = 0; json.contains(bins) && b < json.at(bins).size(); ++b) {
    const std::string bin = fmt::format("{}/{}", bins.to_string(), b);
    out.pressure_difference_Pa.push_back(
        units::Pa_from_bar(0.5 * (at<double>(json, bin + "/from", file) + at<double>(json, bin + "/to", file))));
    out.p95_over_pressure.push_back(at<double>(json, bin + "/p95_percent_FS", file));
  }
  return out;
}

}  // namespace

ComparedValidation read_compared(const std::filesystem::path& metrics_file) {
  std::ifstream in(metrics_file);
  if (!in) throw MetricsError(fmt::format("{}: cannot be read; {}", metrics_file.string(), remedy));
  const std::string text = model::read_json_text(in);
  const Json json = model::parsed_json(text, metrics_file.string());
  if (json.is_discarded()) throw MetricsError(fmt::format("{}: is no JSON; {}", metrics_file.string(), remedy));
  if (at<std::string>(json, "/format", metrics_file) != "spoolflow metrics") {
    throw MetricsError(fmt::format("{}: its format is not \"spoolflow metrics\"; {}", metrics_file.string(), remedy));
  }
  if (const int version = at<int>(json, "/version", metrics_file); version != 1) {
    throw MetricsError(
        fmt::format("{}: is of version {}, this program reads version 1; validate that model again with this program",
                    metrics_file.string(), version));
  }
  ComparedValidation out{at<std::string>(json, "/valve", metrics_file), metrics_file.filename().string(),
                         units::m3_per_s_from_L_per_min(at<double>(json, "/full_scale_L_min", metrics_file)),
                         at<Json>(json, "/runs", metrics_file).size()};
  const std::size_t estimators = at<Json>(json, "/all_runs", metrics_file).size();
  for (std::size_t e = 0; e < estimators; ++e) {
    const std::string place = fmt::format("/all_runs/{}", e);
    if (!json.contains(Json::json_pointer(place + "/error"))) continue;
    out.estimators.push_back(estimator_at(json, place, metrics_file));
  }
  if (out.estimators.empty()) {
    throw MetricsError(fmt::format("{}: holds no figures, for none of its runs had a reference flow; {}",
                                   metrics_file.string(), remedy));
  }
  return out;
}

}  // namespace spoolflow::report
