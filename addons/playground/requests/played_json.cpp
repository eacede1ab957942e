#include "addons/playground/requests/played_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "spoolflow/estimation/status_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::playground {
namespace {

constexpr std::size_t shown_of = 5;

double rounded(double value) {
  return std::round(value * 1e4) / 1e4;
}

}  // namespace

ValveSettings settings_of(const nlohmann::json& asked) {
  const ValveSettings usual;
  ValveSettings out;
  out.command = asked.value("command_percent", 100 * usual.command) / 100;
  out.pressure_difference_Pa =
      units::pascal_per_bar * asked.value("pressure_bar", usual.pressure_difference_Pa / units::pascal_per_bar);
  out.oil_temperature_C = asked.value("oil_C", usual.oil_temperature_C);
  out.edge_rounding_m = 1e-6 * asked.value("edge_rounding_um", 1e6 * usual.edge_rounding_m);
  out.friction_factor = asked.value("friction_factor", usual.friction_factor);
  out.dither_amplitude_A = asked.value("dither_A", usual.dither_amplitude_A);
  out.dither_frequency_Hz = asked.value("dither_Hz", usual.dither_frequency_Hz);
  return out;
}

nlohmann::json json_of(const std::vector<PlayedSample>& samples) {
  using nlohmann::json;
  json time = json::array(), flow = json::array(), lower = json::array(), upper = json::array(), truth = json::array(),
       position = json::array(), current = json::array();
  const auto L_per_min = [](double flow_m3_per_s) {
    return rounded(flow_m3_per_s * units::litre_per_minute_per_m3_per_s);
  };
  for (std::size_t k = 0; k < samples.size(); k += shown_of) {
    const PlayedSample& sample = samples[k];
    time.push_back(rounded(sample.time_s));
    flow.push_back(L_per_min(sample.flow_m3_per_s));
    lower.push_back(L_per_min(sample.flow_lower_m3_per_s));
    upper.push_back(L_per_min(sample.flow_upper_m3_per_s));
    truth.push_back(L_per_min(sample.true_flow_m3_per_s));
    position.push_back(rounded(units::mm_from_m(sample.position_m)));
    current.push_back(rounded(sample.current_A));
  }
  estimation::StatusText text;
  const sensor::Status status = samples.empty() ? sensor::Status::none : samples.back().status;
  return {
      {"time_s", time},           {"flow_L_min", flow},      {"flow_lower_L_min", lower}, {"flow_upper_L_min", upper},
      {"true_flow_L_min", truth}, {"position_mm", position}, {"current_A", current},      {"status", text(status)}};
}

}  // namespace spoolflow::playground
