#include "spoolflow/report/run_sections.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/svg_chart.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

constexpr std::size_t plot_columns = 700;

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> out;
  out.reserve(values.size());
  for (const double v : values) out.push_back(v * factor);
  return out;
}

Series line_of(const std::string& name, const std::vector<double>& x, const std::vector<double>& y, int colour,
               Stroke stroke = Stroke::solid) {
  Decimated kept = decimate(x, y, plot_columns);
  return {name, std::move(kept.x), std::move(kept.y), colour, stroke, ""};
}

/// The band as an area: the lowest lower end and the highest upper end of each stretch of time.
Band band_of(const std::string& name, const std::vector<double>& x, const std::vector<double>& lower,
             const std::vector<double>& upper, int colour) {
  Band out{name, {}, {}, {}, colour};
  const std::size_t stretch = std::max<std::size_t>(1, x.size() / plot_columns);
  for (std::size_t k = 0; k < x.size(); k += stretch) {
    const std::size_t end = std::min(x.size(), k + stretch);
    out.x.push_back(x[k]);
    out.lower.push_back(*std::min_element(lower.begin() + static_cast<std::ptrdiff_t>(k),
                                          lower.begin() + static_cast<std::ptrdiff_t>(end)));
    out.upper.push_back(*std::max_element(upper.begin() + static_cast<std::ptrdiff_t>(k),
                                          upper.begin() + static_cast<std::ptrdiff_t>(end)));
  }
  return out;
}

std::vector<double> error_percent(const validation::EstimatorResult& result, const validation::ValidatedRun& run,
                                  double full_scale) {
  std::vector<double> out;
  for (std::size_t k = 0; k < result.flow_m3_per_s.size(); ++k)
    out.push_back(100 * (result.flow_m3_per_s[k] - run.reference_m3_per_s[k]) / full_scale);
  return out;
}

/// 95th percentile of the error magnitude in equal stretches of another quantity; stretches with few samples stay
/// empty.
Series error_over(const std::vector<double>& quantity, const std::vector<double>& error, int colour,
                  const std::string& name) {
  constexpr std::size_t bins = 16;
  constexpr std::size_t fewest = 50;
  Series out{name, {}, {}, colour, Stroke::solid, ""};
  const auto [lowest, highest] = std::minmax_element(quantity.begin(), quantity.end());
  const double width = (*highest - *lowest) / bins;
  if (!(width > 0)) return out;
  std::vector<std::vector<double>> binned(bins);
  for (std::size_t k = 0; k < quantity.size(); ++k) {
    if (std::isnan(quantity[k]) || std::isnan(error[k])) continue;
    binned[std::min(bins - 1, static_cast<std::size_t>((quantity[k] - *lowest) / width))].push_back(error[k]);
  }
  for (std::size_t b = 0; b < bins; ++b) {
    out.x.push_back(*lowest + (static_cast<double>(b) + 0.5) * width);
    out.y.push_back(binned[b].size() < fewest ? std::nan("") : validation::error_figures(binned[b]).p95);
  }
  return out;
}

void show_error_over(HtmlPage& page, const validation::ValidatedRun& run, double full_scale) {
  struct Axis {
    std::string label;
    std::vector<double> values;
  };
  std::vector<Axis> axes{{"flow rate [L/min]", scaled(run.reference_m3_per_s, units::litre_per_minute_per_m3_per_s)},
                         {"position [mm]", scaled(run.position_m, units::millimetre_per_metre)}};
  if (!run.oil_temperature_K.empty()) {
    axes.push_back({"oil temperature [C]", run.oil_temperature_K});
    for (double& t : axes.back().values) t = units::degC_from_K(t);
  }
  std::string figures;
  for (const Axis& axis : axes) {
    Chart chart{.x_label = axis.label,
                .y_label = "error, 95th percentile [% FS]",
                .description = "Error over " + axis.label,
                .bands = {},
                .series = {},
                .y_lowest = 0,
                .y_highest = {},
                .width = 430,
                .height = 260};
    int colour = 0;
    for (const validation::EstimatorResult& result : run.results) {
      chart.series.push_back(error_over(axis.values, error_percent(result, run, full_scale), colour++,
                                        std::string(validation::name(result.estimator))));
    }
    figures += "<div>" + svg_of(chart) + "</div>";
  }
  page.figure("<div style=\"display:grid;grid-template-columns:repeat(auto-fit,minmax(280px,1fr));gap:10px\">" +
                  figures + "</div>",
              "95th percentile of the error over flow rate, position and oil temperature.");
}

void show_forces(HtmlPage& page, const validation::ValidatedRun& run) {
  const validation::EstimatorResult& best = run.results.back();
  Chart chart{.x_label = "time [s]",
              .y_label = "force [N]",
              .description = "Forces over time",
              .bands = {},
              .series = {},
              .y_lowest = {},
              .y_highest = {},
              .width = 880,
              .height = 260};
  chart.series = {line_of("magnetic", run.time_s, best.magnetic_force_N, 0),
                  line_of("spring", run.time_s, best.spring_force_N, 5),
                  line_of("flow", run.time_s, best.flow_force_N, 2),
                  line_of("friction", run.time_s, best.friction_force_N, 3, Stroke::thin)};
  page.figure(
      svg_of(chart),
      fmt::format("Forces on the spool by the {} sensor: the magnetic force carries spring, flow force and friction.",
                  validation::name(best.estimator)));
}

}  // namespace

void show_run(HtmlPage& page, const validation::ValidatedRun& run, double full_scale) {
  page.heading("Run " + run.name);
  const bool referenced = !run.reference_m3_per_s.empty();
  Chart flow{.x_label = "time [s]",
             .y_label = "flow rate [L/min]",
             .description = "Measured and estimated flow rate over time",
             .bands = {},
             .series = {},
             .y_lowest = {},
             .y_highest = {},
             .width = 880,
             .height = 340};
  const validation::EstimatorResult& best = run.results.back();
  constexpr double L_min = units::litre_per_minute_per_m3_per_s;
  flow.bands.push_back(
      band_of("95 % band", run.time_s, scaled(best.lower_m3_per_s, L_min), scaled(best.upper_m3_per_s, L_min), 0));
  if (run.results.size() > 1) {
    flow.series.push_back(line_of(std::string(validation::name(run.results.front().estimator)), run.time_s,
                                  scaled(run.results.front().flow_m3_per_s, L_min), 8, Stroke::thin));
  }
  if (referenced) flow.series.push_back(line_of("measured", run.time_s, scaled(run.reference_m3_per_s, L_min), 1));
  flow.series.push_back(line_of(fmt::format("estimated ({})", validation::name(best.estimator)), run.time_s,
                                scaled(best.flow_m3_per_s, L_min), 0, Stroke::dashed));
  page.figure(svg_of(flow), referenced
                                ? "Measured and estimated flow rate (paper Figs 9 and 10), with the 95 % band."
                                : "Estimated flow rate with its 95 % band; the recording has no reference flow.");
  if (referenced) {
    Chart error{.x_label = "time [s]",
                .y_label = "error [% FS]",
                .description = "Error of the estimate over time",
                .bands = {},
                .series = {},
                .y_lowest = {},
                .y_highest = {},
                .width = 880,
                .height = 240};
    const bool both = run.results.size() > 1;
    for (std::size_t r = 0; r < run.results.size(); ++r) {
      const bool leading = r + 1 == run.results.size();
      error.series.push_back(line_of(std::string(validation::name(run.results[r].estimator)), run.time_s,
                                     error_percent(run.results[r], run, full_scale), leading || !both ? 0 : 8,
                                     leading ? Stroke::solid : Stroke::thin));
    }
    page.figure(svg_of(error), "Error of the estimate against the reference meter.");
    show_error_over(page, run, full_scale);
  }
  show_forces(page, run);
  std::vector<std::vector<std::string>> status;
  for (const validation::EstimatorResult& result : run.results) {
    for (const validation::StatusShare& share : result.status) {
      status.push_back(
          {std::string(validation::name(result.estimator)), share.name, fmt::format("{:.1f} %", 100 * share.share)});
    }
  }
  if (!status.empty()) {
    page.subheading("What the sensor said of itself");
    page.table({"Estimator", "Status", "share of samples"}, status);
  }
}

}  // namespace spoolflow::report
