#include "spoolflow/report/analysis/study_figure.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {

CaptionedChart study_figure(const analysis::Study& study, std::size_t output) {
  const analysis::SobolIndices& found = study.indices[output];
  const analysis::StudyOutput& about = analysis::study_output_list()[output];
  std::vector<std::size_t> order(found.factors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return found.factors[a].total.value > found.factors[b].total.value;
  });
  const std::string error = about.p95 ? "95th percentile of the error" : "RMS error";
  BarChart chart{.description = fmt::format("Sobol indices of the {}'s {}", sensor_name(about.estimator), error),
                 .axis = "Share of the variance from one valve to the next",
                 .bars = {},
                 .lowest = -0.2,
                 .highest = 1.2};
  for (const std::size_t f : order) {
    const analysis::FactorIndices& indices = found.factors[f];
    const analysis::Factor& factor = analysis::valve_factors()[f];
    const auto length = [](const analysis::Index& index) { return Bar::Length{index.value, index.lower, index.upper}; };
    chart.bars.push_back(
        {.name = factor.name,
         .tone = factor.kind == analysis::FactorKind::instrument ? "condensed" : "observer",
         .solid = length(indices.first_order),
         .pale = length(indices.total),
         .text = fmt::format("{} / {}", fixed(indices.first_order.value, 2), fixed(indices.total.value, 2))});
  }
  return {std::move(chart),
          fmt::format("{} of the {}: first-order index (solid; alone) / total index (pale; with all "
                      "interactions), whiskers 95 % confidence. Over the series the error is {} \u00b1 {} % FS "
                      "(mean, standard deviation).",
                      error, sensor_name(about.estimator), fixed(100 * found.mean, 2),
                      fixed(100 * found.standard_deviation, 2))};
}

}  // namespace spoolflow::report
