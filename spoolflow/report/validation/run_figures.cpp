#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/report/figures/figure.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/report/validation/validation_figures.hpp"

namespace spoolflow::report {
namespace {

std::string text(estimation::Estimator estimator) {
  return std::string(estimation::name(estimator));
}

Mark line(const validation::Line& data, const std::string& tone, const std::string& name, double width_px = 1.4,
          double factor = 1) {
  return {Shape::line, tone, {}, name, "", width_px, data.time_s, scaled(data.value, factor), {}};
}

Mark band(const validation::Ribbon& data, const std::string& tone, const std::string& name) {
  return {Shape::area, tone, {}, name, "", 0, data.time_s, scaled(data.lower, 1), scaled(data.upper, 1)};
}

Panel flow_panel(const validation::RunResult& run) {
  const validation::EstimatorResult& leading = run.results.back();
  Panel panel{.title = "Flow rate", .quantity = units::Kind::flow, .height_px = 280};
  panel.marks.push_back(band(leading.band_m3_per_s, text(leading.estimator), text(leading.estimator) + ", 95 % band"));
  for (std::size_t e = 0; e + 1 < run.results.size(); ++e) {
    panel.marks.push_back(
        line(run.results[e].flow_m3_per_s, text(run.results[e].estimator), text(run.results[e].estimator), 0.9));
  }
  if (run.has_reference) {
    panel.marks.push_back(line(run.reference_line_m3_per_s, "ink", "measured", 1.9));
  }
  panel.marks.push_back(line(leading.flow_m3_per_s, text(leading.estimator), text(leading.estimator), 1.3));
  return panel;
}

Panel error_panel(const validation::RunResult& run, double full_scale_m3_per_s) {
  Panel panel{.title = "Error, estimated less measured [% FS]", .height_px = 150};
  for (const validation::EstimatorResult& result : run.results) {
    if (!result.metrics) continue;
    const bool leading = &result == &run.results.back();
    panel.marks.push_back(line(result.error_m3_per_s, text(result.estimator), text(result.estimator),
                               leading ? 1.3 : 0.9, 100 / full_scale_m3_per_s));
  }
  return panel;
}

/// From zero, unless the spool went to the other side of the centre as well.
std::optional<double> lowest_position_m(const validation::RunResult& run) {
  constexpr double noise_share = 0.02;  // of the positions' range
  const auto& used = run.position_m;
  if (used && used->lowest < -noise_share * (used->highest - used->lowest)) return std::nullopt;
  return 0.0;
}

Panel pressure_panel(const validation::RunResult& run) {
  const validation::EstimatorResult& leading = run.results.back();
  Panel panel{.title = "Pressure difference", .quantity = units::Kind::pressure, .height_px = 90, .lowest = 0.0};
  panel.marks.push_back(line(run.pressure_difference_line_Pa, "ink", "measured", 1.6));
  panel.marks.push_back(line(leading.pressure_difference_Pa, text(leading.estimator), text(leading.estimator), 1.0));
  return panel;
}

Panel status_panel(const validation::EstimatorResult& result) {
  Panel panel{.title = fmt::format("Status of the {}", text(result.estimator)), .height_px = 0};
  for (const validation::StatusRow& status : result.status) {
    Row row{fmt::format("{} ({} %)", status.name, fixed(100 * status.share, status.share < 0.01 ? 2 : 0)),
            status.fault ? "fault" : text(result.estimator)};
    for (const validation::StatusSpan& span : status.spans) row.spans.push_back({span.from_s, span.to_s, span.share});
    panel.rows.push_back(std::move(row));
  }
  return panel;
}

}  // namespace

CaptionedFigure run_flow_figure(const validation::RunResult& run) {
  return {{.description = "Measured and estimated flow rate with its 95 % band over time, run " + run.name,
           .x_title = "Time",
           .x_quantity = units::Kind::time,
           .panels = {flow_panel(run)}},
          fmt::format("Run {}{}. Its own section below has plots that zoom, the error and the forces.", run.name,
                      run.results.back().worst ? ", which has the largest error" : "")};
}

CaptionedFigure run_figure(const validation::RunResult& run, double full_scale_m3_per_s) {
  const validation::EstimatorResult& leading = run.results.back();
  CaptionedFigure out{{.description = "Measured and estimated flow rate, error and status over time, run " + run.name,
                       .x_title = "Time",
                       .x_quantity = units::Kind::time,
                       .panels = {flow_panel(run)}}};
  const bool judged = leading.metrics.has_value();
  if (judged) out.figure.panels.push_back(error_panel(run, full_scale_m3_per_s));
  if (!run.pressure_difference_line_Pa.time_s.empty()) out.figure.panels.push_back(pressure_panel(run));
  Panel position{
      .title = "Position", .quantity = units::Kind::length, .height_px = 70, .lowest = lowest_position_m(run)};
  position.marks.push_back(line(run.position_line_m, "ink", "measured", 1.2));
  out.figure.panels.push_back(std::move(position));
  if (!leading.status.empty()) out.figure.panels.push_back(status_panel(leading));
  out.caption = judged ? "Measured and estimated flow rate, and their difference (the paper's Figs. 9 and 10). "
                       : "Estimated flow rate; the recording has no reference flow, so its error is not known. ";
  if (!run.pressure_difference_line_Pa.time_s.empty()) {
    out.caption += "The measured pressure difference is shown for comparison; no estimator reads it. ";
  }
  if (!leading.status.empty()) out.caption += "A pale status bar: part of that stretch only.";
  out.live = trace_json(run, full_scale_m3_per_s);
  return out;
}

namespace {

/// A force stacked on those below it: from their upper edge to its own.
Mark layer(const validation::RunTrace& trace, const std::vector<float>& from_N, const validation::TracedChannel& to_N,
           const std::string& tone, const std::string& name) {
  constexpr std::size_t stretches = 400;
  const std::vector<float>& upper_N = to_N.highest.empty() ? to_N.lowest : to_N.highest;
  return band(validation::thinned_band(trace.time_s, from_N, upper_N, stretches), tone, name);
}

}  // namespace

CaptionedFigure force_figure(const validation::RunResult& run) {
  const validation::EstimatorResult& leading = run.results.back();
  Panel panel{.title = "Force", .quantity = units::Kind::force, .height_px = 230};
  if (!run.trace.estimators.empty()) {
    const validation::TracedEstimator& says = run.trace.estimators.back();
    const std::vector<float> nothing(run.trace.time_s.size(), 0.0F);
    panel.marks = {layer(run.trace, nothing, says.spring_force_N, "b", "spring"),
                   layer(run.trace, says.spring_force_N.lowest, says.spring_and_flow_N, "a", "flow force"),
                   layer(run.trace, says.spring_and_flow_N.lowest, says.all_forces_N, "d", "friction")};
  }
  panel.marks.push_back(line(leading.magnetic_force_N, "ink", "magnetic"));
  return {
      {.description = "Forces on the spool over time, run " + run.name,
       .x_title = "Time",
       .x_quantity = units::Kind::time,
       .panels = {std::move(panel)}},
      fmt::format("Forces as the {} sees them, stacked: the magnetic force carries spring, flow force and friction. "
                  "While the spool closes, friction helps and lies over the flow force.",
                  text(leading.estimator))};
}

CaptionedFigure worst_moment_figure(const validation::RunResult& run, double full_scale_m3_per_s) {
  const validation::EstimatorResult& leading = run.results.back();
  const validation::WorstMoment& worst = *leading.worst;
  Panel panel{.title = "Flow rate", .quantity = units::Kind::flow, .height_px = 230};
  panel.marks.push_back(band(worst.band_m3_per_s, text(leading.estimator), text(leading.estimator) + ", 95 % band"));
  panel.marks.push_back(line(worst.reference_m3_per_s, "ink", "measured", 1.9));
  for (std::size_t e = 0; e < run.results.size(); ++e) {
    const bool last = e + 1 == run.results.size();
    panel.marks.push_back(
        line(worst.flow_m3_per_s[e], text(run.results[e].estimator), text(run.results[e].estimator), last ? 1.4 : 0.9));
  }
  return {{.description = "The seconds around the largest error, run " + run.name,
           .x_title = "Time",
           .x_quantity = units::Kind::time,
           .panels = {std::move(panel)}},
          phrase("The {}'s largest error: {} % FS at {}, {}, {}{}. Status then: {}{}.", text(leading.estimator),
                 signed_fixed(100 * worst.error_m3_per_s / full_scale_m3_per_s, 1), fixed(units::time(worst.time_s), 2),
                 worst.moving
                     ? fmt::format("the spool moving at {} mm/s", three_digits(1e3 * std::abs(worst.velocity_m_per_s)))
                     : "the spool at rest",
                 worst.position_m < 0 ? phrase("at {}", fixed(units::length(worst.position_m), 2))
                                      : phrase("{} open", fixed(units::length(worst.position_m), 2)),
                 worst.pressure_difference_Pa ? phrase(", {}", fixed(units::pressure(*worst.pressure_difference_Pa), 0))
                                              : Text(),
                 worst.status.empty() ? "none" : fmt::format("{}", fmt::join(worst.status, ", ")),
                 worst.moving && std::ranges::count(worst.status, "spool_at_rest") > 0
                     ? ", though it moved: the sensor took friction to hold it"
                     : "")};
}

}  // namespace spoolflow::report
