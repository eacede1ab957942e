#include "spoolflow/report/series/series_report.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include <fmt/format.h>

#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

using calibration::Series;
using calibration::SeriesParameter;
using calibration::SeriesUnit;
using calibration::UnitParameter;

double scale_of(const std::string& unit) {
  return calibration::written_unit(unit).scale;
}
std::string unit_of(const std::string& unit) {
  const std::string_view name = calibration::written_unit(unit).name;
  return name == "um" ? "µm" : std::string(name);
}

std::string names_of(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Of the type, but beyond `marginal_deviations` in a direction.
bool at_edge(const SeriesUnit& unit) {
  return unit.refusal.empty() && std::ranges::any_of(unit.parameters, &UnitParameter::marginal);
}

/// Directions whose deviations ask for it.
std::vector<std::string> parameters_that(const Series& series, bool (*asks)(const SeriesParameter&)) {
  std::vector<std::string> out;
  for (const SeriesParameter& parameter : series.parameters) {
    if (asks(parameter)) out.push_back(spaced(parameter.name));
  }
  return out;
}

/// What needs a look, the worst first.
void show_verdict(HtmlPage& page, const Series& series) {
  const auto edge = std::ranges::count_if(series.units, at_edge);
  const std::size_t of_type = series.units.size() - series.refused();
  page.html(fmt::format("<p class=\"verdict\">{} of {} units are of the type{}.</p>\n<ul class=\"limits\">", of_type,
                        series.units.size(), series.direction));
  const auto item = [&](const std::string& text) { page.html(fmt::format("<li>{}</li>\n", html_text(text))); };
  if (series.refused() > 0) item(fmt::format("{} refused: no model was written of them", series.refused()));
  if (edge > 0)
    item(fmt::format("{} at the type's edge, beyond {:g} standard deviations in a direction", edge,
                     calibration::marginal_deviations));
  const auto drifting = parameters_that(series, [](const SeriesParameter& each) { return each.drifts; });
  if (!drifting.empty()) item("drifts over the serial numbers: " + names_of(drifting));
  const auto incapable = parameters_that(series, [](const SeriesParameter& each) { return each.capability < 1; });
  if (!incapable.empty()) item("spreads or lies off beyond its tolerance (Cpk below 1): " + names_of(incapable));
  const auto unseen = parameters_that(series, [](const SeriesParameter& each) { return each.seen == 0; });
  if (!unseen.empty()) item("shown by no unit's recordings: " + names_of(unseen));
  page.html("</ul>\n");
}

std::string known(double value, std::string (*written)(double)) {
  return std::isnan(value) ? "–" : written(value);
}

HtmlTable spread_table(const Series& series) {
  HtmlTable table({{"Differs in", Set::text},
                   {"Unit", Set::text},
                   {"Tolerance"},
                   {"Spread"},
                   {"Mean"},
                   {"± 95 %"},
                   {"Cpk"},
                   {"Drift over 100 units"},
                   {"Shown by"},
                   {"", Set::text}});
  for (const SeriesParameter& each : series.parameters) {
    const double scale = scale_of(each.unit);
    constexpr double of_95 = 1.96, units = 100;
    table.row({html_text(spaced(each.name)), unit_of(each.unit), two_digits(scale * each.tolerance),
               known(scale * each.spread, two_digits), known(scale * each.mean, signed_two_digits),
               known(of_95 * scale * each.mean_uncertainty, two_digits),
               known(each.capability, [](double value) { return fixed(value, 2); }),
               known(units * scale * each.drift_per_serial, signed_two_digits), std::to_string(each.seen),
               each.drifts           ? "drifts"
               : each.capability < 1 ? "beyond tolerance"
                                     : ""});
  }
  return table;
}

/// All units of one direction: deviations from the type over its tolerance, beside serial numbers.
Panel panel_of(const Series& series, std::size_t k) {
  const SeriesParameter& about = series.parameters[k];
  Panel out{.title = fmt::format("{} [{}]", spaced(about.name), unit_of(about.unit)), .height_px = 110};
  const double scale = scale_of(about.unit), limit = calibration::capability_deviations * scale * about.tolerance;
  Mark of_type{.shape = Shape::dots, .tone = "observer", .name = "unit of the type", .width_px = 4};
  Mark foreign{.shape = Shape::dots, .tone = "c", .name = "refused", .width_px = 5};
  Mark open{.shape = Shape::area, .tone = "soft", .name = "standard uncertainty", .width_px = 0};
  const double first = series.units.front().serial, last = series.units.back().serial;
  const double bar = std::min(0.3, 0.006 * (1 + last - first));
  double reach = 1.2 * limit;
  for (const SeriesUnit& unit : series.units) {
    const UnitParameter& parameter = unit.parameters[k];
    Mark& mark = unit.refusal.empty() ? of_type : foreign;
    mark.x.push_back(unit.serial);
    mark.y.push_back(scale * parameter.value);
    reach = std::max(reach, 1.1 * scale * std::abs(parameter.value));
    if (!unit.refusal.empty()) continue;
    const double below = scale * (parameter.value - parameter.uncertainty),
                 above = scale * (parameter.value + parameter.uncertainty);
    open.x.insert(open.x.end(), {unit.serial - bar, unit.serial + bar, unit.serial + bar});
    open.y.insert(open.y.end(), {below, below, NAN});  // a bar of its own
    open.y_upper.insert(open.y_upper.end(), {above, above, NAN});
  }
  out.lowest = -reach;
  out.highest = reach;
  out.marks.push_back(std::move(open));
  for (const double side : {-limit, limit})
    out.marks.push_back({.shape = Shape::dashed,
                         .tone = "ink",
                         .name = "3 tolerances",
                         .width_px = 1,
                         .x = {first, last},
                         .y = {side, side}});
  if (about.drifts) {
    const double middle = 0.5 * (first + last), mean = scale * about.mean, slope = scale * about.drift_per_serial;
    out.marks.push_back({.tone = "c",
                         .name = "drift",
                         .x = {first, last},
                         .y = {mean + slope * (first - middle), mean + slope * (last - middle)}});
  }
  out.marks.push_back(std::move(of_type));
  if (!foreign.x.empty()) out.marks.push_back(std::move(foreign));
  return out;
}

CaptionedFigure course_figure(const Series& series) {
  CaptionedFigure out{{.description = "Deviations of all units over their serial numbers",
                       .x_title = "Serial number",
                       .x_lowest = series.units.front().serial - 0.5,
                       .x_highest = series.units.back().serial + 0.5}};
  for (std::size_t k = 0; k < series.parameters.size(); ++k) {
    if (series.parameters[k].seen > 0 || !series.population) out.figure.panels.push_back(panel_of(series, k));
  }
  out.caption =
      "Each dot is a unit's deviation from the type, the bar what its own recordings leave open of it (one standard "
      "deviation to either side); dashed: three tolerances. Directions that no recording shows are left out.";
  return out;
}

std::string deviations_text(const SeriesUnit& unit) {
  std::vector<const UnitParameter*> far;
  for (const UnitParameter& parameter : unit.parameters) {
    if (std::abs(parameter.deviations) > 2) far.push_back(&parameter);
  }
  std::ranges::sort(far,
                    [](const auto* a, const auto* b) { return std::abs(a->deviations) > std::abs(b->deviations); });
  std::string out;
  for (const UnitParameter* each : far) {
    out += fmt::format("{}{} {} {} ({} standard deviations)", out.empty() ? "" : ", ", spaced(each->name),
                       signed_two_digits(scale_of(each->unit) * each->value), unit_of(each->unit),
                       fixed(std::abs(each->deviations), 1));
  }
  return out.empty() ? "in all directions together" : out;
}

void show_outliers(HtmlPage& page, const Series& series) {
  HtmlTable table(
      {{"Unit", Set::text}, {"", Set::text}, {"Chi square"}, {"Beyond two standard deviations", Set::sentence}});
  for (const SeriesUnit& unit : series.units) {
    if (unit.refusal.empty() && !at_edge(unit)) continue;
    table.row({html_text(unit.name), unit.refusal.empty() ? "at the edge" : "refused", fixed(unit.chi_square, 1),
               html_text(deviations_text(unit))});
  }
  page.section("Units at the edge and beyond" + series.direction);
  if (table.empty()) {
    page.paragraph("None.");
    return;
  }
  page.table(table);
  page.note(
      fmt::format("A unit is refused beyond {:g} standard deviations in a direction, where the sum of their squares "
                  "(chi square) exceeds {:g}, or where no unit of the type explains its recordings.",
                  calibration::foreign_deviations, calibration::foreign_chi_square));
}

void show_direction(HtmlPage& page, const Series& series) {
  page.section("Spread and capability" + series.direction);
  page.table(spread_table(series));
  page.note(fmt::format(
      "Tolerance, spread: one standard deviation between units, as the type has it and as these units are; what each "
      "unit's recordings leave open is taken out, and the type counts as {:g} units. Cpk: distance of the mean "
      "from "
      "{:g} tolerances over three spreads, from {} units on, for fewer do not show it; 1 and more is capable. Drift: "
      "slope over serial numbers, from {} units on, "
      "marked beyond {:g} standard uncertainties of it. Refused units count in none of these.",
      calibration::tolerances_as_units, calibration::capability_deviations, calibration::least_for_capability,
      calibration::least_for_drift, calibration::drifting_deviations));
  page.section("Over the serial numbers" + series.direction);
  page.figure(course_figure(series));
  show_outliers(page, series);
}

}  // namespace

void write_series_report(std::ostream& out, const std::vector<Series>& series, const std::string& origin,
                         const ReaderUnits& units) {
  HtmlPage page("spoolflow series report", "Series of " + series.front().type, origin, units);
  page.headline(fmt::format("{} units", series.front().units.size()));
  for (const Series& each : series) show_verdict(page, each);
  for (const Series& each : series) show_direction(page, each);
  out << page.str();
}

}  // namespace spoolflow::report
