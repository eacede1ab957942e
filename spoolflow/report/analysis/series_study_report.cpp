#include "spoolflow/report/analysis/series_study_report.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include <fmt/format.h>

#include "spoolflow/report/calibration/model_sections.hpp"
#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/report/text/text.hpp"

namespace spoolflow::report {
namespace {

using analysis::all_known_by;
using analysis::KnownBy;
using analysis::SeriesFigures;
using analysis::SeriesStudy;

/// "1.23 (0.80 to 2.10)": the median, and where nine of ten units lie.
std::string quantiles(const SeriesStudy& study, KnownBy by, std::size_t run, double SeriesFigures::*figure,
                      int decimals) {
  const analysis::SeriesQuantiles over = study.over_units(by, run, figure);
  if (std::isnan(over.median)) return "–";
  return fmt::format("{} ({} to {})", fixed(100 * over.median, decimals), fixed(100 * over.low, decimals),
                     fixed(100 * over.high, decimals));
}

HtmlTable quantile_table(const SeriesStudy& study, std::size_t run) {
  HtmlTable table({{"Unit known by", Set::text},
                   {"95 % [% FS]"},
                   {"Largest [% FS]"},
                   {"In the band [%]"},
                   {"Width [% FS]"},
                   {"Units held [%]"}});
  for (const KnownBy by : all_known_by) {
    const double holding = study.holding(by, run);
    table.row({known_by_name(by), quantiles(study, by, run, &SeriesFigures::p95, 2),
               quantiles(study, by, run, &SeriesFigures::largest, 1),
               quantiles(study, by, run, &SeriesFigures::in_band, 1),
               quantiles(study, by, run, &SeriesFigures::band_width, 1),
               std::isnan(holding) ? "–" : fixed(100 * holding, 0)});
  }
  return table;
}

/// One panel a run: what share of the units has no larger error.
CaptionedFigure error_curves(const SeriesStudy& study) {
  static constexpr std::array known_by_tones{"soft", "condensed", "observer", "d"};
  CaptionedFigure out{{.description = "Errors of all units, in their order of size",
                       .x_title = "95th percentile of the unit's errors [% FS]",
                       .x_lowest = 0.0}};
  for (std::size_t run = 0; run < analysis::series_runs; ++run) {
    Panel panel{
        .title = fmt::format("Units [%]: {}", series_run_name(run)), .height_px = 150, .lowest = 0.0, .highest = 100.0};
    for (const KnownBy by : all_known_by) {
      std::vector<double> errors;
      for (const analysis::SeriesStudyUnit& unit : study.units) {
        if (unit.judged(by).refusal.empty()) errors.push_back(100 * unit.judged(by).runs[run].p95);
      }
      std::ranges::sort(errors);
      Mark mark{.shape = by == KnownBy::type ? Shape::dashed : Shape::line,
                .tone = known_by_tones[static_cast<std::size_t>(by)],
                .name = run == 0 ? known_by_name(by) : ""};
      for (std::size_t k = 0; k < errors.size(); ++k) {  // a step up at every unit
        for (const std::size_t below : {k, k + 1}) {
          mark.x.push_back(errors[k]);
          mark.y.push_back(100.0 * static_cast<double>(below) / static_cast<double>(errors.size()));
        }
      }
      panel.marks.push_back(std::move(mark));
    }
    out.figure.panels.push_back(std::move(panel));
  }
  out.caption = "Share of the units whose error is not larger.";
  return out;
}

void show_refused(HtmlPage& page, const SeriesStudy& study) {
  HtmlTable table({{"Spread seed", Set::text}, {"Known by", Set::text}, {"Why there is no model", Set::sentence}});
  for (const analysis::SeriesStudyUnit& unit : study.units) {
    for (const KnownBy by : all_known_by) {
      const std::string& refusal = unit.judged(by).refusal;
      if (!refusal.empty()) table.row({std::to_string(unit.spread_seed), known_by_name(by), html_text(refusal)});
    }
  }
  page.section("Refused by calibration");
  if (table.empty()) {
    page.paragraph("None.");
  } else {
    page.table(table);
  }
}

}  // namespace

const char* known_by_name(KnownBy by) {
  static constexpr std::array names{"type alone", "bare minute", "measured minute", "own campaign"};
  return names[static_cast<std::size_t>(by)];
}

std::string series_run_name(std::size_t run) {
  return spaced(analysis::series_run_names[run]);
}

std::string series_verdict(const SeriesStudy& study) {
  std::string errors, refused;
  for (const KnownBy by : all_known_by) {
    const double median = study.over_units(by, 0, &SeriesFigures::p95).median;
    if (!std::isnan(median))
      errors += fmt::format("{}{} % FS by {}", errors.empty() ? "" : ", ", fixed(100 * median, 2), known_by_name(by));
    if (study.refused(by) > 0) refused += fmt::format(" Refused: {} by {}.", study.refused(by), known_by_name(by));
  }
  return fmt::format("95 % of the errors on slow ramps stay within {} (medians of {} units).{}", errors,
                     study.units.size(), refused);
}

void write_series_study_report(std::ostream& out, const model::Model& type, const SeriesStudy& study,
                               const ReaderUnits& units) {
  HtmlPage page("spoolflow series study", "Units of " + type.type->name, origin_of(type), units);
  page.headline(fmt::format("{} virtual units of {}, seed {}", study.units.size(), study.valve, study.seed));
  page.verdict(series_verdict(study));
  page.section("What is known of a unit, and what it buys");
  for (std::size_t run = 0; run < analysis::series_runs; ++run) {
    page.subsection(fmt::format("{}, {} s", series_run_name(run), fixed(study.run_s[run], 0)));
    page.table(quantile_table(study, run));
  }
  page.note(fmt::format(
      "Medians over the units, and in brackets where 5 % and 95 % of them lie: below what 95 % of a unit's errors "
      "stay, "
      "its largest error, its samples whose true flow the 95 % band holds, the band's mean width from end to end; and "
      "how many units' bands hold {:g} % of the samples or more. Every unit is drawn with the rig's manufacturing "
      "spread and judged by the plant's true flow on the same runs. The measured minute has flow meter and pressure "
      "difference, {} s as planned for the type; the bare one has neither, beside strokes with the pump off. A unit's "
      "own campaign has four pressure differences.",
      100 * analysis::held_share, fixed(study.minute_s, 0)));
  page.section("From unit to unit");
  page.figure(error_curves(study));
  show_refused(page, study);
  show_inputs(page, type, {});
  out << page.str();
}

}  // namespace spoolflow::report
