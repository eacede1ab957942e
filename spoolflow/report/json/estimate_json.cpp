#include <ostream>

#include <nlohmann/json.hpp>

#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {

void write_estimate_summary(std::ostream& out, const std::vector<validation::EstimateSummary>& summaries) {
  using Json = nlohmann::ordered_json;
  Json recordings = Json::array();
  for (const validation::EstimateSummary& summary : summaries) {
    const double count = summary.samples > 0 ? static_cast<double>(summary.samples) : 1.0;
    Json status = Json::object();
    for (std::size_t k = 0; k < summary.with_status.size(); ++k) {
      if (summary.with_status[k] > 0)
        status[sensor::status_names[k].name] = static_cast<double>(summary.with_status[k]) / count;
    }
    recordings.push_back({{"file", summary.file},
                          {"samples", summary.samples},
                          {"mean_flow_L_min", units::L_per_min_from_m3_per_s(summary.flow_sum_m3_per_s / count)},
                          {"mean_band_width_L_min", units::L_per_min_from_m3_per_s(summary.width_sum_m3_per_s / count)},
                          {"fault_share", static_cast<double>(summary.with_fault) / count},
                          {"status_shares", std::move(status)},
                          {"duplicate_times", summary.notes.duplicate_times},
                          {"missing_values", summary.notes.missing_values()},
                          {"missing_times", summary.notes.missing_times},
                          {"backward_times", summary.notes.backward_times},
                          {"resampled", summary.notes.resampled},
                          {"doubts", summary.doubts}});
  }
  out << Json{{"recordings", std::move(recordings)}}.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace spoolflow::report
