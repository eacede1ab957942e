#include "spoolflow/report/validation/validation_report.hpp"

#include <algorithm>
#include <ostream>
#include <span>

#include <fmt/format.h>

#include "spoolflow/report/analysis/budget_sections.hpp"
#include "spoolflow/report/calibration/model_sections.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/report/validation/requirements_table.hpp"
#include "spoolflow/report/validation/results_table.hpp"
#include "spoolflow/report/validation/validation_figures.hpp"
#include "spoolflow/report/validation/verdict.hpp"

namespace spoolflow::report {
namespace {

/// What the words of the verdict mean, where they first stand.
void show_terms(HtmlPage& page, const validation::Validation& validation) {
  std::string text;
  for (const validation::PooledResult& pooled : validation.pooled) {
    text +=
        pooled.estimator == estimation::Estimator::condensed
            ? "Condensed: the sensor of the paper, two maps averaged over both directions of motion. "
            : "Observer: the full sensor, which follows friction, hysteresis, dynamics and oil temperature sample by "
              "sample. ";
  }
  page.note(text + "Errors are estimate less reference meter; the band is stated to hold 95 % of them.");
}

/// The run of the largest error, else the first: flow, band and meter.
void show_first_run(HtmlPage& page, const validation::Validation& validation) {
  const validation::RunResult* run = run_of_largest_error(validation);
  if (run == nullptr && !validation.runs.empty()) run = &validation.runs.front();
  if (run != nullptr && run->samples > 0) page.figure(run_flow_figure(*run));
}

void tile(HtmlPage& page, const std::string& value, const std::string& meaning) {
  page.html(fmt::format("<div class=\"tile\"><b>{}</b><span>{}</span></div>", html_text(value), html_text(meaning)));
}

void show_tiles(HtmlPage& page, const validation::Validation& validation, double percent) {
  const validation::PooledResult& leading = validation.pooled.back();
  if (!leading.metrics) return;
  page.html("<div class=\"tiles\">");
  for (std::size_t e = validation.pooled.size(); e-- > 0;) {
    const validation::PooledResult& pooled = validation.pooled[e];
    tile(page, two_digits(pooled.metrics->all.error.p95 * percent) + " % FS",
         fmt::format("95 % of the {}'s errors below{}", sensor_name(pooled.estimator),
                     validation::pools_several_runs(validation) ? ", mean over runs" : ""));
  }
  tile(page, two_digits(leading.metrics->all.error.largest * percent) + " % FS",
       fmt::format("largest error of the {}", sensor_name(leading.estimator)));
  tile(page, fixed(100 * leading.metrics->all.band_coverage, 1) + " %",
       fmt::format("of the samples inside its 95 % band, {} % FS wide on average",
                   two_digits(leading.metrics->all.band_mean_width_m3_per_s * percent)));
  page.html("</div>\n");
}

std::string run_facts(const validation::RunResult& run) {
  const double rate_Hz = run.duration_s > 0 ? static_cast<double>(run.samples - 1) / run.duration_s : 0;
  std::string out = fmt::format("{} samples over {} s", run.samples, fixed(run.duration_s, 1));
  if (rate_Hz > 0) out += fmt::format(" ({} Hz)", three_digits(rate_Hz));
  if (run.missing_values > 0) out += fmt::format("; {} values missing", run.missing_values);
  if (run.duplicate_times > 0) out += fmt::format("; {} repeated time stamps", run.duplicate_times);
  if (!run.resampled.empty()) out += "; " + run.resampled;
  if (!run.has_reference) out += "; no reference flow: estimation only";
  if (run.calibrated_with) out += "; also an input of the calibration";
  return out + ".";
}

/// How the reference's scale and zero stand to the estimate.
Text reference_text(const validation::RunResult& run) {
  if (!run.reference_scale) return {};
  const validation::ReferenceScale& found = *run.reference_scale;
  return phrase(" The reference reads {} \u00b1 {} times the estimate {} {} \u00b1 {} (95 %); reported, not applied.",
                fixed(found.scale, 3), fixed(2 * found.scale_uncertainty, 3),
                found.offset_m3_per_s < 0 ? "less" : "plus",
                bare(fixed(units::flow(std::abs(found.offset_m3_per_s)), 2)),
                fixed(units::flow(2 * found.offset_uncertainty_m3_per_s), 2));
}

void show_run(HtmlPage& page, const validation::RunResult& run, double full_scale_m3_per_s) {
  page.section("Run " + run.name);
  Text facts = run_facts(run);
  facts += reference_text(run);
  page.note(facts);
  if (run.samples == 0) return;
  page.figure(run_figure(run, full_scale_m3_per_s));
  std::vector<CaptionedFigure> details;
  if (run.results.back().worst) details.push_back(worst_moment_figure(run, full_scale_m3_per_s));
  details.push_back(force_figure(run));
  page.pair(details);
  const std::vector<CaptionedFigure> dynamics = dynamics_figures(run);
  if (!dynamics.empty()) page.pair(dynamics);
}

/// Each run's meter.
std::string meters(const validation::Validation& validation) {
  std::string out = "each run:";
  for (const validation::RunResult& run : validation.runs) {
    if (!run.has_reference) continue;
    out += fmt::format(" {} {},", run.name, reference_meter_text(run));
  }
  out.pop_back();
  return out;
}

void show_definitions(HtmlPage& page, const validation::Validation& validation, double full_scale_m3_per_s) {
  page.subsection("How the figures are made");
  page.paragraph(phrase(
      "Error: estimate less reference, sample by sample. Full scale (FS): {}. \u201c95 % of errors below\u201d: "
      "the "
      "95th percentile of the errors' magnitudes. Of reading: error over reference, where the reference is above a "
      "tenth of full scale.",
      three_digits(units::flow(full_scale_m3_per_s))));
  page.paragraph(
      "Moving: the spool itself, by its measured position, goes faster than 1 % of the stroke a second, whatever was "
      "commanded. At rest: not moving, and more than 1 % open. Around reversal: within 2 s of a change of direction, "
      "or of a start or stop above half of the stroke.");
  page.paragraph(
      "Figures of several runs, in the verdict and in the requirements of all runs, are means over runs; \u201call "
      "samples\u201d is the mean over samples.");
  page.paragraph(fmt::format("The reference meter lags by {} ms (first order; {}; \u00b1: 95 %). The estimate was {}.",
                             fixed(1e3 * validation.reference_lag_s, 0), meters(validation),
                             validation.reference_lag_applied
                                 ? "delayed and lagged likewise before it was compared: the answer itself is that of "
                                   "the instant"
                                 : "compared as it is, so that in fast changes the meter's lag counts as error "
                                   "(--apply-reference-lag takes it out)"));
}

/// Of the runs only where they worked on the side of the centre that opens one direction of flow, in that direction's
/// positions.
std::vector<validation::RunResult> on_side(const std::vector<validation::RunResult>& runs, bool side_a) {
  std::vector<validation::RunResult> out;
  for (const validation::RunResult& run : runs) {
    validation::RunResult& each = out.emplace_back();
    for (validation::OperatingPoint point : run.operating_points) {
      if (side_a) point.position_m = -point.position_m;
      if (point.position_m >= 0) each.operating_points.push_back(point);
    }
  }
  return out;
}

/// One direction of a whole valve: its maps, where they are blind and what makes the uncertainty.
void show_direction(HtmlPage& page, const model::Model& of_one, const std::vector<validation::RunResult>& runs) {
  page.part(flow_name(of_one));
  show_maps(page, of_one);
  show_blindness(page, of_one, on_side(runs, of_one.valve.direction == "a"));
  budget_section(page, of_one);
  show_residuals(page, of_one);
  page.end_part();
}

/// Residuals, maps and fits of a model of one direction.
void show_calibration(HtmlPage& page, const model::Model& model) {
  show_quantities(page, model);
  show_residuals(page, model);
  show_maps(page, model);
  show_temperatures(page, model);
  show_model_against_bench(page, model);
  show_fits(page, model);
  show_blindness(page, model, {});
}

/// Verdict, one plot, then tables.
void show_opening(HtmlPage& page, const Verdict& said, const validation::Validation& validation, double full_scale) {
  const std::vector<validation::JudgedLimit> limits = shown_limits(validation, full_scale);
  const std::span<const Text> remarks(said.limits);
  page.verdict(said.sentence);
  show_requirements(page, validation, limits);
  page.remarks(remarks.first(std::min(said.doubts, remarks.size())));
  show_terms(page, validation);
  show_first_run(page, validation);
  page.remarks(remarks.subspan(std::min(said.doubts, remarks.size())));
  show_tiles(page, validation, 100 / full_scale);
  page.table(results_table(validation, full_scale));
  show_limits(page, limits);
  page.contents();
}

}  // namespace

void write_validation_report(std::ostream& out, const model::Model& model, const validation::Validation& validation,
                             const std::vector<ComparedValidation>& others, const ReaderUnits& units) {
  const double full_scale = model.valve.rated_flow_m3_per_s;
  HtmlPage page("spoolflow validation report", "Flow rate of " + model.valve.name, origin_of(model), units);
  page.headline(headline_of(model));
  show_opening(page, verdict(model, validation), validation, full_scale);
  show_valve(page, model, validation.runs);
  show_envelope(page, model, validation.runs);
  if (!model.whole()) show_maps(page, model);
  for (const validation::RunResult& run : validation.runs) show_run(page, run, full_scale);
  const std::vector<CaptionedFigure> profiles = profile_figures(validation, full_scale);
  if (!profiles.empty()) {
    page.section("Where the errors are");
    page.pair(profiles);
    page.pair(direction_and_distribution_figures(validation, full_scale));
    page.table(direction_table(validation, full_scale));
  }
  show_comparison(page, model, validation, others);
  if (model.whole()) {
    for (const char* direction : {"b", "a"})
      show_direction(page, model::of_direction(model, direction), validation.runs);
  } else {
    show_blindness(page, model, validation.runs);
    budget_section(page, model);
  }
  page.section("What the sensor said of itself");
  page.table(status_table(validation));
  page.section("All figures");
  const HtmlTable figures = all_figures_table(validation, full_scale);
  if (!figures.empty()) page.table(figures);
  show_definitions(page, validation, full_scale);
  if (!model.whole()) show_residuals(page, model);
  show_inputs(page, model, validation.runs);
  out << page.str();
}

void write_calibration_report(std::ostream& out, const model::Model& model, const ReaderUnits& units) {
  HtmlPage page("spoolflow calibration report", model.valve.name, origin_of(model), units);
  page.headline(headline_of(model));
  const Verdict said = calibration_verdict(model);
  page.verdict(said.sentence);
  page.remarks(said.limits);
  show_valve(page, model, {});
  if (model.whole()) {
    for (const char* direction : {"b", "a"}) {
      const model::Model of_one = model::of_direction(model, direction);
      page.part(flow_name(of_one));
      show_calibration(page, of_one);
    }
    page.end_part();
    page.section("The recordings");
  } else {
    show_calibration(page, model);
  }
  show_inputs(page, model, {});
  out << page.str();
}

}  // namespace spoolflow::report
