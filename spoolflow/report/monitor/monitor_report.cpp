#include "spoolflow/report/monitor/monitor_report.hpp"

#include <array>
#include <cmath>
#include <ostream>

#include <fmt/format.h>

#include "spoolflow/report/calibration/model_sections.hpp"
#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/report/text/html_text.hpp"

namespace spoolflow::report {
namespace {

/// With the signs of number_text.hpp.
std::string figure_text(double value) {
  if (!std::isfinite(value)) return "\u2013";
  const std::string magnitude = fmt::format("{:.4g}", std::abs(value));
  return value < 0 ? "\u2212" + magnitude : magnitude;
}

/// Lengths of a few micrometres are written in them.
double in_its_unit(const monitor::Indicator& indicator, double value) {
  return indicator.unit == "m" && indicator.state != monitor::IndicatorState::counts ? 1e6 * value : value;
}

std::string unit_of(const monitor::Indicator& indicator) {
  if (indicator.unit == "m" && indicator.state != monitor::IndicatorState::counts) return "µm";
  return indicator.unit == "1" ? "" : std::string(indicator.unit);
}

std::string sentence(monitor::Ne107 sign) {
  static constexpr std::array sentences{
      "Nothing contradicts the model.", "Maintenance required (NE 107: M): the valve wears.",
      "Out of specification (NE 107: S): the answer's band does not hold.",
      "Function check (NE 107: C): the inputs are missing.", "Failure (NE 107: F): an input or the coil has failed."};
  return sentences.at(static_cast<std::size_t>(sign));
}

std::string causes_text(const std::vector<monitor::Cause>& causes) {
  std::string out;
  for (const monitor::Cause& cause : causes) {
    if (!out.empty()) out += ", ";
    out += fmt::format("{} ({:.3g} to 1)", spaced(monitor::name(cause.fault)), cause.odds);
  }
  return out.empty() ? "none" : out;
}

HtmlTable indicator_table(const std::vector<monitor::Indicator>& indicators) {
  HtmlTable table(
      {{"Indicator", Set::text}, {"Value"}, {"± 95 %"}, {"Baseline"}, {"Unit", Set::text}, {"State", Set::text}});
  for (const monitor::Indicator& each : indicators) {
    table.row({html_text(spaced(each.name)), figure_text(in_its_unit(each, each.value)),
               figure_text(in_its_unit(each, each.uncertainty_95)), figure_text(in_its_unit(each, each.baseline)),
               html_text(unit_of(each)), html_text(std::string(monitor::name(each.state)))});
  }
  return table;
}

/// One panel an indicator: its value over the windows within its uncertainty, and the baseline.
CaptionedFigure trend_figure(const std::vector<TrendPoint>& trend) {
  CaptionedFigure out{{.description = "Indicators over the windows that were judged",
                       .x_title = "Windows judged",
                       .x_lowest = trend.front().windows,
                       .x_highest = std::max(trend.back().windows, trend.front().windows + 1)}};
  for (std::size_t k = 0; k < trend.front().indicators.size(); ++k) {
    const monitor::Indicator& first = trend.front().indicators[k];
    if (first.state == monitor::IndicatorState::counts) continue;
    Mark band{.shape = Shape::area, .tone = "soft", .width_px = 0};
    Mark line{.tone = "observer", .width_px = 1.6};
    Mark base{.shape = Shape::dashed, .tone = "ink", .width_px = 1};
    bool known = false;
    for (const TrendPoint& point : trend) {
      const monitor::Indicator& at = point.indicators[k];
      known = known || std::isfinite(at.value);
      band.x.push_back(point.windows);
      band.y.push_back(in_its_unit(at, at.value - at.uncertainty_95));
      band.y_upper.push_back(in_its_unit(at, at.value + at.uncertainty_95));
      line.x.push_back(point.windows);
      line.y.push_back(in_its_unit(at, at.value));
      base.x.push_back(point.windows);
      base.y.push_back(in_its_unit(at, at.baseline));
    }
    if (!known) continue;
    const std::string unit = unit_of(first);
    Panel panel{.title = spaced(first.name) + (unit.empty() ? "" : " [" + unit + "]"), .height_px = 110};
    panel.marks = {std::move(band), std::move(line), std::move(base)};
    out.figure.panels.push_back(std::move(panel));
  }
  out.caption =
      "Line: the indicator; area: its uncertainty (95 %); dashed: the baseline, or where there is none the model. A "
      "window "
      "is a cycle of the spool, of up to a minute.";
  return out;
}

}  // namespace

void write_monitor_report(std::ostream& out, const model::Model& model, const monitor::Monitor& watch,
                          const std::vector<MonitoredRun>& runs, const std::vector<TrendPoint>& trend,
                          const ReaderUnits& units) {
  HtmlPage page("spoolflow monitor report", "Condition of " + model.valve.name, origin_of(model), units);
  page.headline(headline_of(model));
  page.html(fmt::format("<p class=\"verdict\">{}</p>\n<ul class=\"limits\">", html_text(sentence(watch.condition()))));
  for (const monitor::Cause& cause : watch.causes()) {
    page.html(fmt::format("<li>{}: odds {:.3g} to 1</li>", html_text(spaced(monitor::name(cause.fault))), cause.odds));
  }
  page.html("</ul>\n");
  page.section("Indicators");
  page.table(indicator_table(watch.indicators()));
  page.note(
      "A raised indicator lies beyond what healthy valves differ from their models by, decided with the stated rate of "
      "false alarms, and belongs to the set of faults that explains all of them best.");
  if (!trend.empty()) {
    page.section("Course");
    page.figure(trend_figure(trend));
  }
  page.section("Recordings");
  HtmlTable table({{"Recording", Set::text}, {"NE 107", Set::text}, {"Causes", Set::sentence}});
  for (const MonitoredRun& run : runs)
    table.row({html_text(run.name), html_text(std::string(monitor::name(run.condition))),
               html_text(causes_text(run.causes))});
  page.table(table);
  out << page.str();
}

}  // namespace spoolflow::report
