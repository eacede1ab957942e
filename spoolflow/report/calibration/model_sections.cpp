#include "spoolflow/report/calibration/model_sections.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/report/calibration/calibration_figures.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

/// What a channel's values are, and how they are written.
struct Channel {
  units::Kind kind;
  int decimals;
};
constexpr Channel current_channel{units::Kind::current, 2};
constexpr Channel position_channel{units::Kind::length, 2};
constexpr Channel pressure_channel{units::Kind::pressure, 1};
constexpr Channel flow_channel{units::Kind::flow, 1};
constexpr Channel temperature_channel{units::Kind::temperature, 1};

Text channel_text(double lowest, double highest, const Channel& of) {
  return range_text(fixed(units::Quantity{of.kind, lowest}, of.decimals),
                    fixed(units::Quantity{of.kind, highest}, of.decimals));
}

/// What all runs together used.
Text used_text(const std::vector<validation::RunResult>& runs,
               std::optional<validation::Extent> validation::RunResult::*channel, const Channel& of) {
  std::optional<validation::Extent> used;
  for (const validation::RunResult& run : runs) {
    const std::optional<validation::Extent>& each = run.*channel;
    if (!each) continue;
    if (!used) used = each;
    used->lowest = std::min(used->lowest, each->lowest);
    used->highest = std::max(used->highest, each->highest);
  }
  return used ? channel_text(used->lowest, used->highest, of) : Text("not recorded");
}

Text calibrated_temperature(const model::Model& model) {
  if (model.observer) {
    return channel_text(model.observer->oil_temperature_K.lower, model.observer->oil_temperature_K.upper,
                        temperature_channel);
  }
  if (model.condensed.oil_temperature_K) {
    return fixed(units::temperature(*model.condensed.oil_temperature_K), temperature_channel.decimals);
  }
  return "not recorded";
}

Text extent_text(const std::optional<validation::Extent>& extent, const Channel& of) {
  return extent ? channel_text(extent->lowest, extent->highest, of) : Text("\u2013");
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
               rate_Hz > 0 ? three_digits(rate_Hz) + " Hz" : "\u2013", extent_text(run.position_m, position_channel),
               extent_text(run.pressure_difference_Pa, pressure_channel),
               extent_text(run.oil_temperature_K, temperature_channel),
               extent_text(run.reference_m3_per_s, flow_channel)});
  }
  return table;
}

const char* flows_of(const model::Model& model) {
  if (model.whole()) return "P to B and P to A";
  return model::flow_of(model.valve.direction);
}

/// `unit`: of the model, SI. Residuals of positions are too small for the unit of positions.
Text residual_text(double residual, const std::string& unit) {
  if (unit == "m") return three_digits(1e6 * residual) + " \u00b5m";
  if (const std::optional<units::Kind> kind = units::kind_in(unit))
    return three_digits(units::Quantity{*kind, residual});
  return three_digits(residual) + " " + html_text(unit);
}

/// What is known to no better than its own size is not known.
Text uncertainty_text(double uncertainty, const std::string& unit) {
  if (unit == "1" && uncertainty > 1) return "not identifiable";
  return unit == "1" ? Text(two_digits(100 * uncertainty) + " %") : residual_text(uncertainty, unit);
}

void add_residuals(HtmlTable& table, const std::string& estimator, const std::vector<model::Residual>& residuals) {
  for (const model::Residual& residual : residuals) {
    table.row({html_text(residual.of), estimator, residual_text(residual.rms, residual.unit),
               residual_text(residual.largest, residual.unit)},
              &residual == &residuals.front());
  }
}

/// The cylinder that the maps are for.
Text load_of(const model::Model& model) {
  if (!model.valve.load_area_ratio) return Text();
  return phrase(", behind a cylinder with {} of port B's piston area at port A",
                three_digits(*model.valve.load_area_ratio));
}

}  // namespace

std::string origin_of(const model::Model& model) {
  return fmt::format("Model of {}, {}", model.provenance.created, model.provenance.tool_version);
}

Text headline_of(const model::Model& model) {
  const std::string type = !model.type        ? ""
                           : model.type->unit ? fmt::format("; a unit of the type {}", model.type->name)
                                              : "; of no unit: the model of the type, whose band holds all its units";
  return phrase("full scale {}{}{}", three_digits(units::flow(model.valve.rated_flow_m3_per_s)), type,
                model.provenance.simulated ? "; simulated: calibrated with recordings of the virtual test rig" : "");
}

const char* flow_name(const model::Model& model) {
  return model.valve.direction == "a" ? "Flow P to A" : "Flow P to B";
}

void show_valve(HtmlPage& page, const model::Model& model, const std::vector<validation::RunResult>& runs) {
  page.section("The valve and the data");
  page.paragraph(phrase("{}: full scale {}, stroke {}, flow {}{}. Oil: {}{}.", model.valve.name,
                        three_digits(units::flow(model.valve.rated_flow_m3_per_s)),
                        fixed(units::length(model.valve.stroke_m), 2), flows_of(model), load_of(model),
                        model.fluid.name,
                        model.fluid.viscosity_40C_m2_per_s
                            ? phrase(", {} mm\u00b2/s at {}",
                                     three_digits(*model.fluid.viscosity_40C_m2_per_s / units::m2_per_s_per_mm2_per_s),
                                     fixed(units::temperature(units::K_from_degC(40)), 0))
                            : Text()));
  std::vector<HtmlTable::Column> columns{{"Range of", Set::text}, {"calibrated", Set::number}};
  if (!runs.empty()) columns.push_back({"used by the runs", Set::number});
  HtmlTable table(std::move(columns));
  const model::Condensed& condensed = model.condensed;
  using Run = validation::RunResult;
  const model::Condensed* const p_to_a = model.whole() ? &model.p_to_a->condensed : nullptr;
  const double lowest_A = p_to_a != nullptr ? -p_to_a->current_A.upper : condensed.current_A.lower;
  const double lowest_m = p_to_a != nullptr ? -p_to_a->position_m.upper : condensed.position_m.lower;
  table.row({p_to_a != nullptr ? "coil current, b &gt; 0, a &lt; 0" : "coil current",
             channel_text(lowest_A, condensed.current_A.upper, current_channel),
             used_text(runs, &Run::current_A, current_channel)});
  table.row({p_to_a != nullptr ? "spool position, &gt; 0 opens P to B" : "spool position",
             channel_text(lowest_m, condensed.position_m.upper, position_channel),
             used_text(runs, &Run::position_m, position_channel)});
  table.row(
      {p_to_a != nullptr ? "pressure difference, flow P to B" : "pressure difference",
       channel_text(condensed.pressure_difference_Pa.lower, condensed.pressure_difference_Pa.upper, pressure_channel),
       used_text(runs, &Run::pressure_difference_Pa, pressure_channel)});
  if (p_to_a != nullptr) {
    table.row(
        {"pressure difference, flow P to A",
         channel_text(p_to_a->pressure_difference_Pa.lower, p_to_a->pressure_difference_Pa.upper, pressure_channel),
         used_text(runs, &Run::pressure_difference_Pa, pressure_channel)});
  }
  table.row({"oil temperature", calibrated_temperature(model),
             used_text(runs, &Run::oil_temperature_K, temperature_channel)});
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

void show_quantities(HtmlPage& page, const model::Model& model) {
  if (model.provenance.quantities.empty()) return;
  page.section("What was measured, inferred, assumed");
  if (model.type) {
    page.paragraph("Of the valve that the type was made from; by how much units differ stands in the model's type.");
  }
  HtmlTable table({{"Quantity", Set::text}, {"is", Set::text}, {"from", Set::text}, {"within (95 %)"}});
  for (const model::KnownQuantity& each : model.provenance.quantities) {
    table.row({html_text(each.of), html_text(each.how), html_text(each.from),
               each.uncertainty_95 ? uncertainty_text(*each.uncertainty_95, each.unit) : Text("not known")});
  }
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
  page.paragraph(phrase(
      "Force that is not flow force (friction, hysteresis, a wrong map) becomes an error of the flow rate through the "
      "slope of the map. Below {} of opening the levels' forces do not differ by more than noise. {}",
      fixed(units::length(uniqueness.blind_below_m), 2),
      uniqueness.ambiguous_at_m.empty()
          ? "Elsewhere each force means one flow rate: nowhere does a higher pressure difference pull less."
          : fmt::format("Positions at which a higher pressure difference pulls less, so that one force means several "
                        "flow rates: {}.",
                        uniqueness.ambiguous_at_m.size())));
  page.figure(sensitivity_figure(model, runs));
}

}  // namespace spoolflow::report
