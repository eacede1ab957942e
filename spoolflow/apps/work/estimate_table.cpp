#include "spoolflow/apps/work/estimate_table.hpp"

#include <memory>

#include "spoolflow/estimation/status_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::apps {

recording::TableHead estimate_table() {
  recording::TableHead head{.name = "estimate", .numbers = {}, .flags = "status", .flag_names = {}, .flag_text = {}};
  head.numbers = {{"time_s", "s", "the sample's time as recorded", 6},
                  {"flow_L_min", "L/min", "flow rate", 6},
                  {"flow_lower_L_min", "L/min", "lower end of the 95 % band", 6},
                  {"flow_upper_L_min", "L/min", "upper end of the 95 % band", 6},
                  {"pressure_difference_bar", "bar", "pressure difference over the metering edge", 4},
                  {"magnetic_force_N", "N", "magnetic force", 3},
                  {"flow_force_N", "N", "steady flow force", 3},
                  {"friction_force_N", "N", "friction force", 3}};
  for (const sensor::StatusName& each : sensor::status_names)
    head.flag_names.push_back({static_cast<std::uint32_t>(each.bit), each.name});
  head.flag_names.push_back(
      {static_cast<std::uint32_t>(sensor::monitor_status_name.bit), sensor::monitor_status_name.name});
  const auto text = std::make_shared<estimation::StatusText>();
  head.flag_text = [text](std::uint32_t word) { return (*text)(static_cast<sensor::Status>(word)); };
  return head;
}

recording::TableHead estimate_table(const model::Model& model, estimation::Estimator estimator,
                                    const std::string& tool) {
  recording::TableHead head = estimate_table();
  head.notes = {
      {"written_by", tool}, {"valve", model.valve.name}, {"estimator", std::string(estimation::name(estimator))}};
  return head;
}

void put_estimates(recording::TableRows& rows, std::span<const double> time_s,
                   std::span<const sensor::Estimate<double>> estimates) {
  using units::litre_per_minute_per_m3_per_s;
  const std::size_t count = estimates.size();
  rows.numbers.resize(8);
  rows.numbers[0].assign(time_s.begin(), time_s.end());
  for (std::size_t k = 1; k < rows.numbers.size(); ++k) rows.numbers[k].resize(count);
  rows.flags.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const sensor::Estimate<double>& estimate = estimates[k];
    rows.numbers[1][k] = estimate.flow_m3_per_s * litre_per_minute_per_m3_per_s;
    rows.numbers[2][k] = estimate.flow_lower_m3_per_s * litre_per_minute_per_m3_per_s;
    rows.numbers[3][k] = estimate.flow_upper_m3_per_s * litre_per_minute_per_m3_per_s;
    rows.numbers[4][k] = estimate.pressure_difference_Pa / units::pascal_per_bar;
    rows.numbers[5][k] = estimate.magnetic_force_N;
    rows.numbers[6][k] = estimate.flow_force_N;
    rows.numbers[7][k] = estimate.friction_force_N;
    rows.flags[k] = static_cast<std::uint32_t>(estimate.status);
  }
}

}  // namespace spoolflow::apps
