#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/report/validation/validation_figures.hpp"

namespace spoolflow::report {
namespace {

using validation::Direction;

std::optional<CaptionedFigure> hysteresis_figure(const validation::Validation& validation, double percent) {
  Panel panel{.title = "Mean error [% FS]", .height_px = 220};
  Text caption =
      "Mean error over position while the spool opens and closes, all runs; the gap between both is "
      "the residual of hysteresis.";
  for (const validation::PooledResult& pooled : validation.pooled) {
    if (!pooled.direction) continue;
    const std::vector<validation::DirectionBin> bins = pooled.direction->bins();
    if (bins.size() < 3) continue;
    const std::string name(estimation::name(pooled.estimator));
    Mark opening{.shape = Shape::line, .tone = name, .name = name + ", opening", .width_px = 1.7};
    Mark closing{.shape = Shape::dashed, .tone = name, .name = name + ", closing", .width_px = 1.7};
    for (const validation::DirectionBin& bin : bins) {
      const double position_m = 0.5 * (bin.from_m + bin.to_m);
      opening.x.push_back(position_m);
      closing.x.push_back(position_m);
      opening.y.push_back(bin.opening_m3_per_s * percent);
      closing.y.push_back(bin.closing_m3_per_s * percent);
    }
    panel.marks.push_back(std::move(opening));
    panel.marks.push_back(std::move(closing));
    const validation::Hysteresis widest = *pooled.direction->hysteresis();
    caption += phrase(" {}: at most {} % FS, at {}.", name, fixed(std::abs(widest.difference_m3_per_s) * percent, 1),
                      fixed(units::length(widest.position_m), 2));
  }
  if (panel.marks.empty()) return std::nullopt;
  return CaptionedFigure{{.description = "Mean error over position, opening and closing",
                          .x_title = "Position",
                          .x_quantity = units::Kind::length,
                          .panels = {std::move(panel)}},
                         caption};
}

Mark distribution(const validation::ErrorProfile& profile, const std::string& estimator, double percent) {
  Mark mark{.tone = estimator, .width_px = 0.8};
  for (const validation::DistributionPoint& point : profile.distribution()) {
    mark.x.push_back(point.error_m3_per_s * percent);
    mark.y.push_back(100 * point.share);
  }
  return mark;
}

CaptionedFigure distribution_figure(const validation::Validation& validation, double percent) {
  Panel panel{.title = "Samples with a smaller error [%]", .height_px = 220, .lowest = 0.0, .highest = 100.0};
  if (validation.runs.size() > 1) {
    for (const validation::RunResult& run : validation.runs) {
      for (const validation::EstimatorResult& result : run.results) {
        if (result.profiles.empty()) continue;
        panel.marks.push_back(
            distribution(result.profiles.front(), std::string(estimation::name(result.estimator)), percent));
      }
    }
  }
  double nearly_all = 0;
  for (const validation::PooledResult& pooled : validation.pooled) {
    Mark mark = distribution(pooled.profiles.front(), std::string(estimation::name(pooled.estimator)), percent);
    mark.name = std::string(estimation::name(pooled.estimator));
    mark.width_px = 2.2;
    for (std::size_t k = 0; k < mark.x.size() && mark.y[k] < 99.5; ++k) nearly_all = std::max(nearly_all, mark.x[k]);
    panel.marks.push_back(std::move(mark));
  }
  return {{.description = "Distribution of the errors",
           .x_title = "Size of the error [% FS]",
           .x_lowest = 0.0,
           .x_highest = std::max(nearly_all, 0.1),
           .panels = {std::move(panel)}},
          validation.runs.size() > 1 ? "How the errors are distributed: all runs together, and thin each run by itself."
                                     : "How the errors are distributed."};
}

}  // namespace

std::vector<CaptionedFigure> direction_and_distribution_figures(const validation::Validation& validation,
                                                                double full_scale_m3_per_s) {
  const double percent = 100 / full_scale_m3_per_s;
  std::vector<CaptionedFigure> out;
  if (auto hysteresis = hysteresis_figure(validation, percent)) out.push_back(std::move(*hysteresis));
  out.push_back(distribution_figure(validation, percent));
  return out;
}

HtmlTable direction_table(const validation::Validation& validation, double full_scale_m3_per_s) {
  const double percent = 100 / full_scale_m3_per_s;
  HtmlTable table({{"Estimator", Set::text},
                   {"Spool", Set::text},
                   {"samples"},
                   {"half of the errors<br>below, % FS"},
                   {"95 % of the errors<br>below, % FS"}});
  for (const validation::PooledResult& pooled : validation.pooled) {
    if (!pooled.direction) continue;
    bool first = true;
    for (const Direction direction : validation::directions) {
      const auto figures = pooled.direction->magnitudes(direction);
      if (!figures) continue;
      const char* name =
          direction == Direction::opening ? "opens" : (direction == Direction::closing ? "closes" : "rests");
      table.row(
          {first ? std::string(estimation::name(pooled.estimator)) : "", name, fmt::format("{}", figures->samples),
           fixed(figures->median_m3_per_s * percent, 2), fixed(figures->p95_m3_per_s * percent, 2)},
          first);
      first = false;
    }
  }
  return table;
}

}  // namespace spoolflow::report
