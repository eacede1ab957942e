#include "spoolflow/report/calibration/model_sections.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/report/calibration/calibration_figures.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

/// A quantity's unit for people: shown = factor * SI + offset.
struct Shown {
  const char* unit;
  double factor, offset;
  int decimals;
};
constexpr Shown ampere{"A", 1, 0, 2};
constexpr Shown millimetre{"mm", units::millimetre_per_metre, 0, 2};
constexpr Shown bar{"bar", 1 / units::pascal_per_bar, 0, 1};
constexpr Shown litre_per_minute{"L/min", units::litre_per_minute_per_m3_per_s, 0, 1};
constexpr Shown celsius{"\u00b0C", 1, -units::kelvin_at_0_degC, 1};

std::string range_text(double lowest, double highest, const Shown& as) {
  const std::string from = fixed(lowest * as.factor + as.offset, as.decimals);
  const std::string to = fixed(highest * as.factor + as.offset, as.decimals);
  return from == to ? fmt::format("{} {}", from, as.unit) : fmt::format("{} to {} {}", from, to, as.unit);
}

/// What all runs together used.
std::string used_text(const std::vector<validation::RunResult>& runs,
                      std::optional<validation::Extent> validation::RunResult::*channel, const Shown& as) {
  std::optional<validation::Extent> used;
  for (const validation::RunResult& run : runs) {
    const std::optional<validation::Extent>& each = run.*channel;
    if (!each) continue;
    if (!used) used = each;
    used->lowest = std::min(used->lowest, each->lowest);
    used->highest = std::max(used->highest, each->highest);
  }
  return used ? range_text(used->lowest, used->highest, as) : std::string("not recorded");
}

std::string calibrated_temperature(const model::Model& model) {
  if (model.observer) {
    return range_text(model.observer->oil_temperature_K.lower, model.observer->oil_temperature_K.upper, celsius);
  }
  if (model.condensed.oil_temperature_K) {
    return range_text(*model.condensed.oil_temperature_K, *model.condensed.oil_temperature_K, celsius);
  }
  return "not recorded";
}

std::string extent_text(const std::optional<validation::Extent>& extent, const Shown& as) {
  return extent ? range_text(extent->lowest, extent->highest, as) : std::string("\u2013");
}

/// What was tested: one line a recording.
HtmlTable runs_table(const std::vector<validation::RunResult>& runs) {
  HtmlTable table({{"Run", Set::text},
                   {"samples"},
                   {"duration"},
                   {"rate"},
                   {"position"},
                   {"pressure difference"},
                   {"oil temperature"},
                   {"measured flow"}});
  for (const validation::RunResult& run : runs) {
    const double rate_Hz = run.duration_s > 0 ? static_cast<double>(run.samples - 1) / run.duration_s : 0;
    table.row({html_text(run.name), fmt::format("{}", run.samples), fixed(run.duration_s, 1) + " s",
               rate_Hz > 0 ? three_digits(rate_Hz) + " Hz" : "\u2013", extent_text(run.position_m, millimetre),
               extent_text(run.pressure_difference_Pa, bar), extent_text(run.oil_temperature_K, celsius),
               extent_text(run.reference_m3_per_s, litre_per_minute)});
  }
  return table;
}

void add_residuals(HtmlTable& table, const std::string& estimator, const std::vector<model::Residual>& residuals) {
  for (const model::Residual& residual : residuals) {
    double factor = 1;
    std::string unit = residual.unit;
    if (unit == "m3/s") factor = units::litre_per_minute_per_m3_per_s, unit = "L/min";
    if (unit == "m") factor = 1e6, unit = "\u00b5m";
    if (unit == "Pa") factor = 1 / units::pascal_per_bar, unit = "bar";
    table.row({html_text(residual.of), estimator, three_digits(residual.rms * factor) + " " + html_text(unit),
               three_digits(residual.largest * factor) + " " + html_text(unit)},
              &residual == &residuals.front());
  }
}

}  // namespace

std::string origin_of(const model::Model& model) {
  return fmt::format("Model of {}, {}", model.provenance.created, model.provenance.tool_version);
}

void show_valve(HtmlPage& page, const model::Model& model, const std::vector<validation::RunResult>& runs) {
  page.section("The valve and the data");
  page.paragraph(
      fmt::format("{}: full scale {} L/min, stroke {} mm, flow {}. Oil: {}{}.", model.valve.name,
                  three_digits(units::L_per_min_from_m3_per_s(model.valve.rated_flow_m3_per_s)),
                  fixed(units::mm_from_m(model.valve.stroke_m), 2), model.valve.direction == "b" ? "P to B" : "P to A",
                  model.fluid.name,
                  model.fluid.viscosity_40C_m2_per_s
                      ? fmt::format(", {} mm\u00b2/s at 40 \u00b0C",
                                    three_digits(*model.fluid.viscosity_40C_m2_per_s / units::m2_per_s_per_mm2_per_s))
                      : ""));
  std::vector<HtmlTable::Column> columns{{"Range of", Set::text}, {"calibrated", Set::number}};
  if (!runs.empty()) columns.push_back({"used by the runs", Set::number});
  HtmlTable table(std::move(columns));
  const model::Condensed& condensed = model.condensed;
  using Run = validation::RunResult;
  table.row({"coil current", range_text(condensed.current_A.lower, condensed.current_A.upper, ampere),
             used_text(runs, &Run::current_A, ampere)});
  table.row({"spool position", range_text(condensed.position_m.lower, condensed.position_m.upper, millimetre),
             used_text(runs, &Run::position_m, millimetre)});
  table.row({"pressure difference",
             range_text(condensed.pressure_difference_Pa.lower, condensed.pressure_difference_Pa.upper, bar),
             used_text(runs, &Run::pressure_difference_Pa, bar)});
  table.row({"oil temperature", calibrated_temperature(model), used_text(runs, &Run::oil_temperature_K, celsius)});
  page.table(table);
  if (!runs.empty()) page.table(runs_table(runs));
}

void show_residuals(HtmlPage& page, const model::Model& model) {
  page.subsection("How well the maps fit the samples they were made from");
  HtmlTable table({{"Map", Set::text}, {"of the", Set::text}, {"RMS"}, {"largest"}});
  add_residuals(table, "condensed", model.condensed.residuals);
  if (model.observer) add_residuals(table, "observer", model.observer->residuals);
  page.table(table);
}

void show_inputs(HtmlPage& page, const model::Model& model, const std::vector<validation::RunResult>& runs) {
  page.subsection("Files");
  HtmlTable table({{"File", Set::text}, {"used for", Set::text}, {"samples"}, {"sha256", Set::hash}});
  for (const model::InputFile& input : model.provenance.inputs) {
    table.row({html_text(input.file), "calibration: " + html_text(input.protocol),
               input.samples == 0 ? "" : fmt::format("{}", input.samples), html_text(input.sha256)});
  }
  for (const validation::RunResult& run : runs) {
    table.row({html_text(run.file), "validation", fmt::format("{}", run.samples), html_text(run.sha256)},
              &run == &runs.front());
  }
  page.table(table);
}

void show_maps(HtmlPage& page, const model::Model& model) {
  page.section("What was calibrated");
  page.pair({flow_force_figure(model.evidence), magnetic_force_figure(model.evidence)});
  page.pair({friction_figure(model.evidence), hysteresis_figure(model.evidence)});
}

void show_blindness(HtmlPage& page, const model::Model& model, const std::vector<validation::RunResult>& runs) {
  page.section("Where the sensor is blind, and why");
  const model::Uniqueness& uniqueness = model.evidence.uniqueness;
  page.paragraph(fmt::format(
      "Force that is not flow force (friction, hysteresis, a wrong map) becomes an error of the flow rate through the "
      "slope of the map. Below {} mm of opening the levels' forces cannot be told apart at all. {}",
      fixed(units::mm_from_m(uniqueness.blind_below_m), 2),
      uniqueness.ambiguous_at_m.empty()
          ? "Elsewhere each force means one flow rate: nowhere does a higher pressure difference pull less."
          : fmt::format("At {} positions a higher pressure difference pulls less: one force means several flow rates.",
                        uniqueness.ambiguous_at_m.size())));
  page.figure(sensitivity_figure(model, runs));
}

}  // namespace spoolflow::report
