#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/analysis/budget_sections.hpp"
#include "spoolflow/report/figures/bar_chart.hpp"
#include "spoolflow/report/figures/figure.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

using analysis::RunResult;

/// Whether nothing was recorded before an instant for much longer than usual.
bool after_gap(const std::vector<double>& time_s, std::size_t k) {
  constexpr double many = 20;
  const double usual_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size());
  return k > 0 && time_s[k] - time_s[k - 1] > many * usual_s;
}

CaptionedFigure course(const RunResult& result) {
  const std::string name(estimation::name(result.estimator));
  std::vector<double> below, above, error, expanded, of_trials;
  for (std::size_t k = 0; k < result.time_s.size(); ++k) {
    const double half = result.coverage_factor * result.combined_m3_per_s[k];
    // NaN breaks the area.
    below.push_back(after_gap(result.time_s, k) ? NAN : result.flow_m3_per_s[k] - half);
    above.push_back(result.flow_m3_per_s[k] + half);
    expanded.push_back(half);
    of_trials.push_back(result.coverage_factor * result.deviation_m3_per_s[k]);
    if (!result.reference_m3_per_s.empty())
      error.push_back(std::abs(result.flow_m3_per_s[k] - result.reference_m3_per_s[k]));
  }
  Panel flow{.title = "Flow rate", .quantity = units::Kind::flow};
  flow.marks.push_back({.shape = Shape::area,
                        .tone = name,
                        .name = "budget's interval (95 %)",
                        .x = result.time_s,
                        .y = below,
                        .y_upper = above});
  if (!result.reference_m3_per_s.empty()) {
    flow.marks.push_back({.tone = "ink",
                          .name = "reference",
                          .width_px = 1.2,
                          .x = result.time_s,
                          .y = scaled(result.reference_m3_per_s, 1)});
  }
  flow.marks.push_back({.tone = name, .name = name, .x = result.time_s, .y = scaled(result.flow_m3_per_s, 1)});
  Panel size{.title = "Error and expanded uncertainty", .quantity = units::Kind::flow, .height_px = 160, .lowest = 0.0};
  if (!error.empty()) {
    size.marks.push_back(
        {.tone = "ink", .name = "magnitude of the error", .width_px = 1, .x = result.time_s, .y = error});
  }
  size.marks.push_back({.tone = name, .name = "expanded, budget", .x = result.time_s, .y = expanded});
  size.marks.push_back({.shape = Shape::dashed,
                        .tone = "fault",
                        .name = fmt::format("k times the deviation of {} trials", result.trials),
                        .width_px = 1.2,
                        .x = result.time_s,
                        .y = of_trials});
  // Peaks of single instants would squeeze everything else.
  std::vector<double> sorted = expanded;
  std::ranges::sort(sorted);
  constexpr double least_m3_per_s = 1e-6 / units::litre_per_minute_per_m3_per_s;
  size.highest =
      std::max(least_m3_per_s, 2.5 * sorted[static_cast<std::size_t>(0.98 * static_cast<double>(sorted.size() - 1))]);
  return {{.description = "The " + name + "'s flow rate with the budget's interval over time",
           .x_title = "Time",
           .x_quantity = units::Kind::time,
           .panels = {flow, size}},
          fmt::format("The {} along the run with the budget's 95 % interval (k = {}).", sensor_name(result.estimator),
                      fixed(result.coverage_factor, 2))};
}

BarChart parts(const RunResult& result) {
  std::vector<analysis::RunLine> lines = result.lines;
  std::ranges::stable_sort(
      lines, [](const auto& a, const auto& b) { return a.rms_contribution_m3_per_s > b.rms_contribution_m3_per_s; });
  BarChart chart{
      .description = fmt::format("Contributions of the inputs along the run, {}", estimation::name(result.estimator)),
      .axis = "Contribution, root mean square over the run",
      .quantity = units::Kind::flow,
      .bars = {}};
  for (const analysis::RunLine& line : lines) {
    if (line.rms_contribution_m3_per_s < 0.01 * lines.front().rms_contribution_m3_per_s) continue;
    const uncertainty::QuantityAbout& about = uncertainty::about(line.input.quantity);
    chart.bars.push_back({.name = std::string(about.title),
                          .tone = about.part_of_model ? "observer" : "condensed",
                          .solid = {line.rms_contribution_m3_per_s},
                          .text = bare(three_digits(units::flow(line.rms_contribution_m3_per_s)))});
  }
  return chart;
}

std::string percent(double share) {
  return fixed(100 * share, 1) + " %";
}

}  // namespace

void show_run_budget(HtmlPage& page, const analysis::RunAnalysis& run, double full_scale_m3_per_s) {
  page.section("Along a run");
  page.paragraph(fmt::format("{}, {} samples; the budget at {} instants evenly over them.", run.recording, run.samples,
                             run.results.empty() ? 0 : run.results.front().time_s.size()));
  for (const RunResult& result : run.results) {
    double squares = 0;
    for (const double u : result.combined_m3_per_s) squares += u * u;
    const double rms = std::sqrt(squares / static_cast<double>(result.combined_m3_per_s.size()));
    page.subsection(fmt::format("The {}", sensor_name(result.estimator)));
    page.paragraph(
        phrase("Standard uncertainty {} ({} % FS), root mean square over the run; {} whole replays with drawn errors "
               "give {} times that.",
               three_digits(units::flow(rms)), fixed(100 * rms / full_scale_m3_per_s, 2), result.trials,
               fixed(result.deviation_ratio, 2)));
    if (result.shares) {
      page.paragraph(fmt::format(
          "Of {} instants with a reference, {} lie in the sensor's own 95 % band; the budget predicts {}, the trials "
          "predict {}. In the budget's own 95 % interval lie {}. {}",
          result.shares->instants, percent(result.shares->in_band), percent(result.shares->in_band_by_budget),
          percent(result.shares->in_band_by_trials), percent(result.shares->in_budget_interval),
          result.shares->other_bench
              ? "The errors of oil and flow meters count in these; the reference meter's lag is taken out."
              : "The reference is taken to share oil and flow meter with the calibration, so that their errors do not "
                "show; its lag is taken out."));
    }
    page.figure(course(result));
    page.chart(
        {parts(result), "What makes the uncertainty along the run; less than a hundredth of the largest left out."});
  }
}

}  // namespace spoolflow::report
