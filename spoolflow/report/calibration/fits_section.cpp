#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/calibration/model_sections.hpp"
#include "spoolflow/report/page/html_table.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

HtmlTable parameters_table(const model::Fit& fit) {
  HtmlTable table({{"parameter (SI)", Set::text}, {"value"}, {"standard<br>uncertainty"}, {"of the<br>value [%]"}});
  for (const model::FittedParameter& each : fit.parameters) {
    const bool held = each.uncertainty == 0;
    table.row({html_text(each.name), fmt::format("{:.4g}", each.value),
               held ? "held at its bound" : fmt::format("{:.2g}", each.uncertainty),
               held || each.value == 0 ? "" : three_digits(100 * each.uncertainty / std::abs(each.value))});
  }
  return table;
}

struct Pair {
  std::size_t a, b;
  double correlation;
};

/// The closest first.
std::vector<Pair> close_pairs(const model::Fit& fit) {
  constexpr double close = 0.5;
  std::vector<Pair> out;
  const std::size_t count = fit.parameters.size();
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      const double correlation = fit.correlation[a * count + b];
      if (std::abs(correlation) >= close) out.push_back({a, b, correlation});
    }
  }
  std::ranges::sort(out,
                    [](const Pair& x, const Pair& y) { return std::abs(x.correlation) > std::abs(y.correlation); });
  return out;
}

void show_correlations(HtmlPage& page, const model::Fit& fit) {
  constexpr std::size_t most = 8;
  const std::vector<Pair> pairs = close_pairs(fit);
  if (pairs.empty()) {
    page.paragraph("No two of these parameters are correlated by half or more: the recordings identify each of them.");
    return;
  }
  HtmlTable table({{"parameter", Set::text}, {"and", Set::text}, {"correlation"}});
  for (std::size_t k = 0; k < std::min(most, pairs.size()); ++k) {
    table.row({html_text(fit.parameters[pairs[k].a].name), html_text(fit.parameters[pairs[k].b].name),
               signed_fixed(pairs[k].correlation, 2)});
  }
  page.paragraph(fmt::format(
      "Correlations of a half and more{}; all of them are in the model file. Where two parameters are close to "
      "±1, the recordings show their sum or difference rather than each.",
      pairs.size() > most ? fmt::format(", the {} closest of {}", most, pairs.size()) : ""));
  page.table(table);
}

}  // namespace

void show_fits(HtmlPage& page, const model::Model& model) {
  if (!model.observer || model.observer->fits.empty()) return;
  page.section("How well the parameters are known");
  for (const model::Fit& fit : model.observer->fits) {
    page.subsection(static_cast<char>(std::toupper(static_cast<unsigned char>(fit.of.front()))) + fit.of.substr(1));
    page.table(parameters_table(fit));
    show_correlations(page, fit);
  }
}

void show_temperatures(HtmlPage& page, const model::Model& model) {
  if (!model.observer || !(model.observer->oil_temperature_K.upper > model.observer->oil_temperature_K.lower)) return;
  const auto& edge = model.observer->parameters.edge;
  const model::Range& range = model.observer->oil_temperature_K;
  constexpr double shown_share = 2.0 / 3;
  constexpr int lines = 3, points = 80;
  const double pressure_Pa = shown_share * edge.highest_pressure_difference_Pa();
  Panel force{.title = "Flow force", .quantity = units::Kind::force, .title_end = ", closing > 0", .height_px = 240};
  Panel friction{
      .title = "Half width of the spool's friction", .quantity = units::Kind::force, .height_px = 160, .lowest = 0.0};
  for (int t = 0; t < lines; ++t) {
    const double ramp = static_cast<double>(t) / (lines - 1);
    const double temperature_K = range.lower + ramp * (range.upper - range.lower);
    Mark force_line{.ramp = ramp, .name = fixed(units::temperature(temperature_K), 0)};
    Mark friction_line{.ramp = ramp};
    for (int p = 0; p <= points; ++p) {
      const double position_m = model.valve.stroke_m * p / points;
      const auto point = edge.at(temperature_K, pressure_Pa, position_m);
      for (Mark* line : {&force_line, &friction_line}) line->x.push_back(position_m);
      force_line.y.push_back(point.flow_force_N);
      friction_line.y.push_back(point.friction_N);
    }
    force.marks.push_back(std::move(force_line));
    friction.marks.push_back(std::move(friction_line));
  }
  page.figure({{.description = "Flow force and friction over position at the calibrated oil temperatures",
                .x_title = "Position",
                .x_quantity = units::Kind::length,
                .panels = {std::move(force), std::move(friction)}},
               phrase("Flow force and friction at {} over position, over the range of calibrated oil temperatures.",
                      fixed(units::pressure(pressure_Pa), 0))});
}

}  // namespace spoolflow::report
