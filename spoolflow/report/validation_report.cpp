#include "spoolflow/report/validation_report.hpp"

#include <algorithm>
#include <ostream>

#include <fmt/format.h>

#include "spoolflow/report/calibration_sections.hpp"
#include "spoolflow/report/html_text.hpp"
#include "spoolflow/report/run_sections.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

/// The run on which the best estimator errs most; null where no run has a reference.
const validation::ValidatedRun* worst_run(const std::vector<validation::ValidatedRun>& runs) {
  const validation::ValidatedRun* worst = nullptr;
  for (const validation::ValidatedRun& run : runs) {
    if (run.results.empty() || !run.results.back().metrics) continue;
    if (worst == nullptr || run.results.back().metrics->all.p95 > worst->results.back().metrics->all.p95) worst = &run;
  }
  return worst;
}

void tile(HtmlPage& page, const std::string& value, const std::string& meaning) {
  page.html(fmt::format("<div class=\"tile\"><b>{}</b><span>{}</span></div>", html_text(value), html_text(meaning)));
}

void metrics_table(HtmlPage& page, const model::Model& model, const std::vector<validation::ValidatedRun>& runs) {
  const double percent = 100 / model.valve.rated_flow_m3_per_s;
  std::vector<std::vector<std::string>> rows;
  for (const validation::ValidatedRun& run : runs) {
    for (const validation::EstimatorResult& result : run.results) {
      if (!result.metrics) continue;
      const validation::Metrics& metrics = *result.metrics;
      const auto row = [&](const std::string& phase, const validation::ErrorFigures& figures, bool first) {
        if (figures.samples == 0) return;
        rows.push_back({first ? run.name : "", first ? std::string(validation::name(result.estimator)) : "", phase,
                        fmt::format("{:.2f}", figures.p95 * percent), fmt::format("{:.2f}", figures.rms * percent),
                        fmt::format("{:.1f}", figures.largest * percent),
                        fmt::format("{:+.2f}", figures.bias * percent),
                        fmt::format("{:.2f}", units::L_per_min_from_m3_per_s(figures.p95)),
                        first ? fmt::format("{:.1f} %", 100 * metrics.share_of_reading.p95) : "",
                        first ? fmt::format("{:.1f} %", 100 * metrics.band_coverage) : "",
                        first ? fmt::format("{:.2f}", metrics.band_mean_width_m3_per_s * percent) : ""});
      };
      row("all", metrics.all, true);
      row("moving", metrics.moving, false);
      row("at rest", metrics.rest, false);
      row("around reversal", metrics.reversal, false);
    }
  }
  page.table({"Run", "Estimator", "Samples", "p95 % FS", "RMS % FS", "max % FS", "bias % FS", "p95 L/min",
              "p95 of reading", "in band", "band width % FS"},
             rows);
}

}  // namespace

std::string verdict(const model::Model& model, const std::vector<validation::ValidatedRun>& runs) {
  const validation::ValidatedRun* worst = worst_run(runs);
  const double percent = 100 / model.valve.rated_flow_m3_per_s;
  if (worst == nullptr)
    return "No run has a reference flow: the flow rate is estimated, how wrong it is cannot be told.";
  const validation::EstimatorResult& best = worst->results.back();
  const validation::Metrics& metrics = *best.metrics;
  double lowest_coverage = 1;
  for (const validation::ValidatedRun& run : runs) {
    if (run.results.back().metrics)
      lowest_coverage = std::min(lowest_coverage, run.results.back().metrics->band_coverage);
  }
  std::string out = fmt::format(
      "The {} sensor tells the flow rate of {} within {:.1f} % of full scale ({:.2g} L/min) for 95 % of the samples on "
      "its worst run, {}.",
      validation::name(best.estimator), model.valve.name, metrics.all.p95 * percent,
      units::L_per_min_from_m3_per_s(metrics.all.p95), worst->name);
  if (worst->results.size() > 1) {
    out += fmt::format(" The {} sensor reaches {:.1f} % there.", validation::name(worst->results.front().estimator),
                       worst->results.front().metrics->all.p95 * percent);
  }
  const bool at_rest = metrics.rest.samples > 0 && metrics.rest.p95 > metrics.moving.p95;
  out += fmt::format(" What limits it is {}.",
                     at_rest ? "friction while the spool rests"
                             : (metrics.reversal.p95 > 1.3 * metrics.all.p95 ? "friction around reversals of the motion"
                                                                             : "friction while the spool moves"));
  out += fmt::format(" Its 95 % band holds {:.1f} % of the samples{}.", 100 * lowest_coverage,
                     runs.size() > 1 ? " on the run where it holds least" : "");
  return out;
}

void write_validation_report(std::ostream& out, const model::Model& model,
                             const std::vector<validation::ValidatedRun>& runs,
                             const validation::ValidationOptions& options) {
  HtmlPage page(fmt::format("Flow sensor of {}", model.valve.name));
  page.html("<p class=\"verdict\">" + html_text(verdict(model, runs)) + "</p>");
  if (const validation::ValidatedRun* worst = worst_run(runs)) {
    const validation::Metrics& metrics = *worst->results.back().metrics;
    const double percent = 100 / model.valve.rated_flow_m3_per_s;
    page.html("<div class=\"tiles\">");
    tile(page, fmt::format("{:.1f} % FS", metrics.all.p95 * percent), "95th percentile of the error, worst run");
    tile(page, fmt::format("{:.0f} % FS", metrics.all.largest * percent), "largest error of that run");
    tile(page, fmt::format("{:.0f} %", 100 * metrics.band_coverage), "of its samples inside the 95 % band");
    tile(page, fmt::format("{}", runs.size()), runs.size() == 1 ? "run" : "runs");
    page.html("</div>\n");
    page.heading("Figures");
    metrics_table(page, model, runs);
    page.html(
        fmt::format("<p class=\"soft\">% FS: percent of {:.4g} L/min. Moving: commanded faster than 1 % of the stroke "
                    "a second. Around reversal: "
                    "within 2 s of a change or stop of the motion. The reference meter lags by {:.0f} ms; the estimate "
                    "was {}. Of reading: where "
                    "the reference is above a tenth of full scale.{}</p>\n",
                    units::L_per_min_from_m3_per_s(model.valve.rated_flow_m3_per_s), 1e3 * options.reference_lag_s,
                    options.apply_reference_lag ? "lagged likewise before comparing"
                                                : "compared as it is, so that fast changes count as errors",
                    worst->phases.from_measured_position
                        ? " Phases are told from the measured position: the command was not recorded."
                        : ""));
  }
  for (const validation::ValidatedRun& run : runs) show_run(page, run, model.valve.rated_flow_m3_per_s);
  show_sensitivity(page, model);
  page.heading("What was calibrated");
  show_flow_force_map(page, model);
  show_magnetic_force_map(page, model);
  describe_valve(page, model);
  out << page.str();
}

void write_calibration_report(std::ostream& out, const model::Model& model) {
  HtmlPage page(fmt::format("Calibration of {}", model.valve.name));
  page.html(fmt::format("<p class=\"verdict\">Calibrated for {}.</p>",
                        model.observer ? "the full sensor and the condensed one" : "the condensed sensor"));
  page.heading("Maps");
  show_flow_force_map(page, model);
  show_magnetic_force_map(page, model);
  show_sensitivity(page, model);
  describe_valve(page, model);
  out << page.str();
}

}  // namespace spoolflow::report
