#include "spoolflow/apps/work/estimate_text.hpp"

#include <fmt/format.h>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::apps {

void write_estimate_header(recording::CsvWriter& out) {
  out.header({"time_s", "flow_L_min", "flow_lower_L_min", "flow_upper_L_min", "pressure_difference_bar",
              "magnetic_force_N", "flow_force_N", "friction_force_N", "status"});
}

void write_estimate_rows(recording::CsvWriter& out, std::span<const double> time_s,
                         std::span<const sensor::Estimate<double>> estimates, estimation::StatusText& status_text) {
  using units::litre_per_minute_per_m3_per_s;
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    const sensor::Estimate<double>& estimate = estimates[k];
    out.number(time_s[k], 6);
    out.number(estimate.flow_m3_per_s * litre_per_minute_per_m3_per_s, 6);
    out.number(estimate.flow_lower_m3_per_s * litre_per_minute_per_m3_per_s, 6);
    out.number(estimate.flow_upper_m3_per_s * litre_per_minute_per_m3_per_s, 6);
    out.number(estimate.pressure_difference_Pa / units::pascal_per_bar, 4);
    out.number(estimate.magnetic_force_N, 3);
    out.number(estimate.flow_force_N, 3);
    out.number(estimate.friction_force_N, 3);
    out.text(status_text(estimate.status));
    out.end_row();
  }
}

std::vector<std::string> notes_text(const recording::ReadNotes& notes, const std::string& file) {
  std::vector<std::string> out;
  if (notes.duplicate_times > 0) {
    out.push_back(
        fmt::format("{}: {} samples repeat the time stamp before them; each is estimated, with status time_fault", file,
                    notes.duplicate_times));
  }
  if (notes.missing_values > 0) {
    out.push_back(fmt::format("{}: {} values are missing; the estimate is held there, with status sample_missing", file,
                              notes.missing_values));
  }
  if (notes.missing_times + notes.backward_times > 0) {
    out.push_back(fmt::format(
        "{}: {} samples have no time stamp, of {} it runs back; the estimate is held there, with status time_fault",
        file, notes.missing_times, notes.backward_times));
  }
  if (!notes.resampled.empty()) out.push_back(fmt::format("{}: {}", file, notes.resampled));
  if (notes.left_out > 0)
    out.push_back(fmt::format("{}: {} lines are no samples and have no row", file, notes.left_out));
  return out;
}

}  // namespace spoolflow::apps
