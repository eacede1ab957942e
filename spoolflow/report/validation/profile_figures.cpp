#include <array>
#include <string>

#include <fmt/format.h>

#include "spoolflow/report/validation/validation_figures.hpp"

namespace spoolflow::report {
namespace {

/// What stands below the errors, of each of `quantities`.
struct Presentation {
  const char* name;
  const char* axis;
  units::Kind kind;
};

constexpr std::array<Presentation, validation::quantities.size()> presentations{
    {{"measured flow rate", "Measured flow rate", units::Kind::flow},
     {"position", "Position", units::Kind::length},
     {"measured pressure difference", "Measured pressure difference", units::Kind::pressure},
     {"oil temperature", "Oil temperature", units::Kind::temperature}}};

Mark profile_line(const std::vector<validation::ProfileBin>& bins, double percent, bool p95,
                  const std::string& estimator) {
  Mark mark{
      .shape = p95 ? Shape::line : Shape::dashed,
      .tone = estimator,
      .name = estimator + (p95 ? ", 95 % of errors below" : ", median"),
      .width_px = p95 ? 1.8 : 1.1,
  };
  for (const validation::ProfileBin& bin : bins) {
    mark.x.push_back(0.5 * (bin.from + bin.to));
    mark.y.push_back((p95 ? bin.p95_m3_per_s : bin.median_m3_per_s) * percent);
  }
  return mark;
}

Panel coverage_panel(const validation::Validation& validation, std::size_t quantity) {
  Panel panel{.title = "Inside the 95 % band [%]", .height_px = 80, .lowest = 0.0, .highest = 100.0};
  Mark promised{.shape = Shape::dashed, .tone = "muted", .width_px = 1};
  for (const validation::PooledResult& pooled : validation.pooled) {
    Mark mark{.tone = std::string(estimation::name(pooled.estimator)), .width_px = 1.6};
    for (const validation::ProfileBin& bin : pooled.profiles[quantity].bins()) {
      mark.x.push_back(0.5 * (bin.from + bin.to));
      mark.y.push_back(100 * bin.band_coverage);
    }
    if (mark.x.size() > promised.x.size()) promised.x = mark.x;
    panel.marks.push_back(std::move(mark));
  }
  promised.y.assign(promised.x.size(), 95);
  panel.marks.push_back(std::move(promised));
  return panel;
}

}  // namespace

std::vector<CaptionedFigure> profile_figures(const validation::Validation& validation, double full_scale_m3_per_s) {
  std::vector<CaptionedFigure> out;
  for (std::size_t q = 0; q < validation::quantities.size(); ++q) {
    const Presentation& as = presentations[q];
    Panel panel{.title = "Error [% FS]", .height_px = 220, .lowest = 0.0};
    std::size_t most_bins = 0;
    for (const validation::PooledResult& pooled : validation.pooled) {
      const auto bins = pooled.profiles[q].bins();
      most_bins = std::max(most_bins, bins.size());
      for (const bool p95 : {true, false}) {
        panel.marks.push_back(
            profile_line(bins, 100 / full_scale_m3_per_s, p95, std::string(estimation::name(pooled.estimator))));
      }
    }
    if (most_bins < 3) continue;
    Panel coverage = coverage_panel(validation, q);
    out.push_back(
        {{.description = fmt::format("Error over {}", as.name),
          .x_title = as.axis,
          .x_quantity = as.kind,
          .panels = {std::move(panel), std::move(coverage)}},
         fmt::format("Size of the error over {}, all runs; below it the share of the samples inside the 95 % band.",
                     as.name),
         {}});
  }
  return out;
}

}  // namespace spoolflow::report
