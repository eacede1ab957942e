#include "spoolflow/report/validation/comparison.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

/// The validation at hand in the form of the others.
ComparedValidation at_hand(const model::Model& model, const validation::Validation& validation) {
  const double percent = 100 / model.valve.rated_flow_m3_per_s;
  ComparedValidation out{model.valve.name, "this report", model.valve.rated_flow_m3_per_s, validation.runs.size()};
  for (const validation::PooledResult& pooled : validation.pooled) {
    if (!pooled.metrics) continue;
    const validation::GroupFigures& all = pooled.metrics->all;
    ComparedEstimator each{std::string(estimation::name(pooled.estimator)),
                           all.error.p95 * percent,
                           all.error.rms * percent,
                           all.error.largest * percent,
                           all.error.bias * percent,
                           100 * all.band_coverage,
                           all.band_mean_width_m3_per_s * percent};
    constexpr auto pressure = static_cast<std::size_t>(validation::Quantity::pressure_difference);
    for (const validation::ProfileBin& bin : pooled.profiles[pressure].bins()) {
      each.pressure_difference_Pa.push_back(0.5 * (bin.from + bin.to));
      each.p95_over_pressure.push_back(bin.p95_m3_per_s * percent);
    }
    out.estimators.push_back(std::move(each));
  }
  return out;
}

HtmlTable comparison_table(const std::vector<ComparedValidation>& all) {
  HtmlTable table({{"Valve", Set::text},
                   {"From", Set::text},
                   {"runs"},
                   {"full scale"},
                   {"Estimator", Set::text},
                   {"95 % of errors<br>below, % FS"},
                   {"RMS<br>% FS"},
                   {"largest<br>% FS"},
                   {"bias<br>% FS"},
                   {"in band<br>%"},
                   {"band width<br>% FS"}});
  double longest = 0;
  for (const ComparedValidation& each : all) {
    for (const ComparedEstimator& estimator : each.estimators) longest = std::max(longest, estimator.p95);
  }
  constexpr double full_px = 90;
  for (const ComparedValidation& each : all) {
    bool first = true;
    for (const ComparedEstimator& estimator : each.estimators) {
      const std::string tone = html_text(estimator.name);
      table.row({first ? html_text(each.valve) : "", first ? html_text(each.file) : "",
                 first ? fmt::format("{}", each.runs) : "",
                 first ? Text(three_digits(units::flow(each.full_scale_m3_per_s))) : Text(),
                 fmt::format(R"(<i class="dot {0}"></i>{0})", tone),
                 fmt::format(R"(<i class="bar {}" style="width:{:.0f}px"></i>{})", tone,
                             longest > 0 ? full_px * estimator.p95 / longest : 0.0, fixed(estimator.p95, 2)),
                 fixed(estimator.rms, 2), fixed(estimator.largest, 1), signed_fixed(estimator.bias, 2),
                 fixed(estimator.band_coverage_percent, 1), fixed(estimator.band_mean_width, 1)},
                first);
      first = false;
    }
  }
  return table;
}

/// The leading estimators' errors; the validation at hand stands out.
CaptionedFigure pressure_figure(const std::vector<ComparedValidation>& all) {
  Panel panel{.title = "95 % of errors below [% FS]", .height_px = 240, .lowest = 0.0};
  for (std::size_t k = all.size(); k-- > 0;) {
    const ComparedEstimator& leading = all[k].estimators.back();
    Mark mark{.name = fmt::format("{} ({}), {}", all[k].valve, all[k].file, leading.name),
              .x = leading.pressure_difference_Pa,
              .y = leading.p95_over_pressure};
    if (k == 0) {
      mark.tone = leading.name;
      mark.width_px = 2.4;
    } else {
      const double others = static_cast<double>(all.size() - 1);
      mark.ramp = static_cast<double>(k) / others;
      mark.shape = Shape::dashed;
    }
    panel.marks.push_back(std::move(mark));
  }
  return {{.description = "Error over pressure difference of several validations",
           .x_title = "Measured pressure difference",
           .x_quantity = units::Kind::pressure,
           .panels = {std::move(panel)}},
          "Size of the error over the pressure difference, side by side."};
}

}  // namespace

void show_comparison(HtmlPage& page, const model::Model& model, const validation::Validation& validation,
                     const std::vector<ComparedValidation>& others) {
  if (others.empty()) return;
  std::vector<ComparedValidation> all{at_hand(model, validation)};
  if (all.front().estimators.empty()) all.clear();
  all.insert(all.end(), others.begin(), others.end());
  page.section("Side by side");
  page.table(comparison_table(all));
  page.figure(pressure_figure(all));
}

}  // namespace spoolflow::report
