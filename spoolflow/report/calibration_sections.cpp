#include "spoolflow/report/calibration_sections.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/html_text.hpp"
#include "spoolflow/report/svg_chart.hpp"
#include "spoolflow/report/svg_heat_map.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> out;
  out.reserve(values.size());
  for (const double v : values) out.push_back(v * factor);
  return out;
}

std::vector<std::vector<std::string>> residual_rows(const std::string& part,
                                                    const std::vector<model::Residual>& residuals) {
  std::vector<std::vector<std::string>> rows;
  for (const model::Residual& residual : residuals) {
    double scale = 1;
    std::string unit = residual.unit;
    if (unit == "m3/s") scale = units::litre_per_minute_per_m3_per_s, unit = "L/min";
    if (unit == "m") scale = 1e6, unit = "um";
    rows.push_back({part + ": " + residual.of, fmt::format("{:.3g}", residual.rms * scale),
                    fmt::format("{:.3g}", residual.largest * scale), unit});
  }
  return rows;
}

}  // namespace

void describe_valve(HtmlPage& page, const model::Model& model) {
  const model::Condensed& condensed = model.condensed;
  page.heading("The valve and the data");
  std::vector<std::vector<std::string>> rows{
      {"Valve", model.valve.name},
      {"Full scale", fmt::format("{:.4g} L/min", units::L_per_min_from_m3_per_s(model.valve.rated_flow_m3_per_s))},
      {"Stroke", fmt::format("{:.3g} mm", units::mm_from_m(model.valve.stroke_m))},
      {"Direction", model.valve.direction == "b" ? "P to B" : "P to A"},
      {"Oil", model.fluid.name},
      {"Calibrated currents", fmt::format("{:.3g} to {:.3g} A", condensed.current_A.lower, condensed.current_A.upper)},
      {"Calibrated pressure differences",
       fmt::format("{:.3g} to {:.3g} bar", units::bar_from_Pa(condensed.pressure_difference_Pa.lower),
                   units::bar_from_Pa(condensed.pressure_difference_Pa.upper))}};
  if (model.observer) {
    rows.push_back({"Calibrated oil temperatures",
                    fmt::format("{:.3g} to {:.3g} C", units::degC_from_K(model.observer->oil_temperature_K.lower),
                                units::degC_from_K(model.observer->oil_temperature_K.upper))});
  }
  page.table({"", ""}, rows);
  page.subheading("How well the maps fit the samples they were made from");
  auto residuals = residual_rows("condensed", condensed.residuals);
  if (model.observer) {
    for (auto& row : residual_rows("observer", model.observer->residuals)) residuals.push_back(std::move(row));
  }
  page.table({"Fit", "RMS", "largest", "unit"}, residuals);
  if (model.observer && !model.observer->defaults.empty()) {
    std::string names;
    for (const std::string& name : model.observer->defaults) names += (names.empty() ? "" : ", ") + name;
    page.paragraph("Assumed, because no recording of the campaign shows it: " + names + ".");
  }
  page.subheading("Where the model comes from");
  std::vector<std::vector<std::string>> inputs;
  for (const model::InputFile& input : model.provenance.inputs) {
    inputs.push_back({input.file, input.protocol, input.samples == 0 ? "" : fmt::format("{}", input.samples),
                      input.sha256.substr(0, 16)});
  }
  page.table({"File", "Protocol", "Samples", "sha256 (first 16)"}, inputs);
  page.html(fmt::format("<p class=\"soft\">Calibrated {} by spoolflow {}.</p>\n", html_text(model.provenance.created),
                        html_text(model.provenance.tool_version)));
}

void show_flow_force_map(HtmlPage& page, const model::Model& model) {
  const auto& loops = model.evidence.axial_force;
  if (loops.empty()) return;
  Chart chart{
      .x_label = "axial force [N]",
      .y_label = "flow rate [L/min]",
      .description =
          "Flow rate over axial force, one line a pressure difference in both directions, dashed lines of position",
      .bands = {},
      .series = {},
      .y_lowest = {},
      .y_highest = {},
      .width = 880,
      .height = 420};
  int colour = 0;
  for (const model::AxialForceLoop& loop : loops) {
    const std::vector<double> flow = scaled(loop.flow_m3_per_s, units::litre_per_minute_per_m3_per_s);
    chart.series.push_back({fmt::format("{:.3g} bar", units::bar_from_Pa(loop.pressure_difference_set_Pa)),
                            loop.opening_N, flow, colour % 8, Stroke::solid, ""});
    chart.series.push_back({"", loop.closing_N, flow, colour % 8, Stroke::thin, ""});
    ++colour;
  }
  const std::vector<double>& position_m = loops.front().position_m;
  for (double share = 0.2; share < 1.01; share += 0.2) {
    const auto at = std::min(position_m.size() - 1,
                             static_cast<std::size_t>(std::lround(share * static_cast<double>(position_m.size() - 1))));
    Series line{"", {}, {}, 8, Stroke::dashed, fmt::format("{:.2g} mm", units::mm_from_m(position_m[at]))};
    for (const model::AxialForceLoop& loop : loops) {
      line.x.push_back(0.5 * (loop.opening_N[at] + loop.closing_N[at]));
      line.y.push_back(units::L_per_min_from_m3_per_s(loop.flow_m3_per_s[at]));
    }
    chart.series.push_back(std::move(line));
  }
  page.figure(svg_of(chart),
              "Flow rate over axial force (paper Fig 5). Heavy lines: the spool opens; thin lines: it closes; between "
              "them lies "
              "twice the friction. Dashed: lines of position through the mean of both. The steeper such a line, the "
              "more flow a newton of force error costs.");
  const model::Uniqueness& uniqueness = model.evidence.uniqueness;
  page.paragraph(fmt::format(
      "The force of neighbouring pressure differences can be told apart above {:.2f} mm of opening. {}",
      units::mm_from_m(uniqueness.blind_below_m),
      uniqueness.ambiguous_at_m.empty()
          ? "Nowhere does a higher pressure difference pull less: for every force and position there is one flow rate."
          : fmt::format(
                "At {} positions a higher pressure difference pulls less: there one force means several flow rates.",
                uniqueness.ambiguous_at_m.size())));
}

void show_magnetic_force_map(HtmlPage& page, const model::Model& model) {
  Chart chart{.x_label = "position [mm]",
              .y_label = "magnetic force [N]",
              .description = "Magnetic force over position, one pair of lines a held current",
              .bands = {},
              .series = {},
              .y_lowest = {},
              .y_highest = {},
              .width = 880,
              .height = 420};
  double widest_N = 0;
  double widest_at_A = 0;
  bool first = true;
  for (const model::MagneticForceLoop& loop : model.evidence.magnetic_force) {
    const std::vector<double> position = scaled(loop.position_m, units::millimetre_per_metre);
    chart.series.push_back(
        {first ? "opening" : "", position, loop.opening_N, 0, Stroke::solid, fmt::format("{:.2g} A", loop.current_A)});
    chart.series.push_back({first ? "closing" : "", position, loop.closing_N, 1, Stroke::solid, ""});
    first = false;
    for (std::size_t k = 0; k < position.size(); ++k) {
      const double width_N = std::abs(loop.closing_N[k] - loop.opening_N[k]);
      if (width_N > widest_N) widest_N = width_N, widest_at_A = loop.current_A;
    }
  }
  page.figure(svg_of(chart), "Magnetic force over position at held currents, both directions (paper Fig 8).");
  page.paragraph(
      fmt::format("Hysteresis is widest at {:.2g} A: {:.2g} N between both directions.", widest_at_A, widest_N));
}

void show_sensitivity(HtmlPage& page, const model::Model& model) {
  const model::SensitivityMap& map = model.evidence.sensitivity;
  page.heading("Where the sensor is blind, and why");
  page.paragraph(
      "A newton of force that is not flow force (friction, hysteresis, a wrong map) becomes an error of flow through "
      "the slope "
      "dQ/dF of the map. Dark regions need a better force than light ones for the same accuracy.");
  HeatMap heat{.x_label = "position [mm]",
               .y_label = "pressure difference [bar]",
               .value_label = "flow per force [% FS / N]",
               .description = "Slope of flow over force by position and pressure difference",
               .x = scaled(map.position_m, units::millimetre_per_metre),
               .y = scaled(map.pressure_difference_Pa, 1 / units::pascal_per_bar),
               .value = {},
               .highest = 6,
               .width = 880,
               .height = 340};
  heat.value.resize(map.flow_per_force_m3_per_s_N.size());
  for (std::size_t p = 0; p < map.position_m.size(); ++p) {
    for (std::size_t d = 0; d < map.pressure_difference_Pa.size(); ++d) {
      heat.value[d * map.position_m.size() + p] =
          100 * map.flow_per_force_m3_per_s_N[p * map.pressure_difference_Pa.size() + d] /
          model.valve.rated_flow_m3_per_s;
    }
  }
  page.figure(svg_of(heat),
              "Percent of full scale that one newton costs. Low pressure differences are blind because the flow force "
              "grows with "
              "the square of the flow; small openings have no flow force yet, but no flow to miss either.");
}

}  // namespace spoolflow::report
