#include "spoolflow/report/validation/results_table.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

using validation::Metrics;

std::string estimator_cell(estimation::Estimator estimator) {
  return fmt::format(R"(<i class="dot {0}"></i>{0})", estimation::name(estimator));
}

double largest_p95(const validation::Validation& validation) {
  double out = 0;
  for (const validation::RunResult& run : validation.runs) {
    for (const validation::EstimatorResult& result : run.results) {
      if (result.metrics) out = std::max(out, result.metrics->all.error.p95);
    }
  }
  return out;
}

/// The number with a bar whose full length is `longest`.
std::string bar_cell(double value, double longest, std::string_view tone) {
  constexpr double full_px = 90;
  return fmt::format(R"(<i class="bar {}" style="width:{:.0f}px"></i>{})", tone,
                     longest > 0 ? full_px * value / longest : 0.0, two_digits(value));
}

/// A figure where there were samples for it.
std::string figure_cell(const validation::ErrorFigures& figures, double value) {
  return figures.samples == 0 ? "\u2013" : two_digits(value);
}

std::vector<HtmlTable::Cell> result_cells(const std::string& run, estimation::Estimator estimator, const Metrics& m,
                                          double percent, double longest) {
  return {run,
          estimator_cell(estimator),
          bar_cell(m.all.error.p95 * percent, longest * percent, estimation::name(estimator)),
          figure_cell(m.moving.error, m.moving.error.p95 * percent),
          figure_cell(m.rest.error, m.rest.error.p95 * percent),
          figure_cell(m.reversal.error, m.reversal.error.p95 * percent),
          two_digits(m.all.error.rms * percent),
          two_digits(m.all.error.largest * percent),
          signed_two_digits(m.all.error.bias * percent),
          figure_cell(m.share_of_reading, 100 * m.share_of_reading.p95),
          fixed(100 * m.all.band_coverage, 1),
          two_digits(m.all.band_mean_width_m3_per_s * percent)};
}

void add_all_figures(HtmlTable& table, const std::string& run, const std::string& estimator, const Metrics& metrics,
                     double percent) {
  struct Group {
    const char* name;
    const validation::GroupFigures& figures;
  };
  const auto both = [&](double value, bool with_sign) {
    const units::Quantity flow = units::flow(value);
    return with_sign ? phrase("{} / {}", bare(signed_fixed(flow, 2)), signed_fixed(value * percent, 2))
                     : phrase("{} / {}", bare(fixed(flow, 2)), fixed(value * percent, 2));
  };
  bool first = true;
  for (const Group& group : {Group{"all", metrics.all}, Group{"moving", metrics.moving}, Group{"at rest", metrics.rest},
                             Group{"reversal", metrics.reversal}, Group{"flow P to B", metrics.p_to_b},
                             Group{"flow P to A", metrics.p_to_a}}) {
    const validation::ErrorFigures& error = group.figures.error;
    if (error.samples == 0) continue;
    table.row({first ? run : "", first ? estimator : "", group.name, fmt::format("{}", error.samples),
               both(error.p95, false), both(error.rms, false), both(error.largest, false), both(error.bias, true),
               fixed(100 * group.figures.band_coverage, 1), both(group.figures.band_mean_width_m3_per_s, false),
               error.rms > 0 ? fixed(group.figures.band_mean_width_m3_per_s / error.rms, 1) : ""},
              first);
    first = false;
  }
}

}  // namespace

HtmlTable results_table(const validation::Validation& validation, double full_scale_m3_per_s) {
  const double percent = 100 / full_scale_m3_per_s;
  const double longest = largest_p95(validation);
  HtmlTable table({{"Run", Set::text},
                   {"Estimator", Set::text},
                   {"95 % of errors<br>below, % FS"},
                   {"moving"},
                   {"at rest"},
                   {"around<br>reversal"},
                   {"RMS<br>% FS"},
                   {"largest<br>% FS"},
                   {"bias<br>% FS"},
                   {"95 % below,<br>% of reading"},
                   {"in band<br>%"},
                   {"band width<br>% FS"}});
  for (const validation::RunResult& run : validation.runs) {
    bool first = true;
    for (const validation::EstimatorResult& result : run.results) {
      const std::string name = first ? html_text(run.name) : "";
      if (result.metrics) {
        table.row(result_cells(name, result.estimator, *result.metrics, percent, longest), first);
      } else {
        table.row({name, estimator_cell(result.estimator), "no reference flow"}, first);
      }
      first = false;
    }
  }
  if (!validation::pools_several_runs(validation)) return table;
  bool first = true;
  for (const validation::PooledResult& pooled : validation.pooled) {
    if (!pooled.metrics) continue;
    table.row(result_cells(first ? "<b>all runs</b>" : "", pooled.estimator, *pooled.metrics, percent, longest), first);
    first = false;
  }
  first = true;
  for (const validation::PooledResult& pooled : validation.pooled) {
    if (!pooled.by_sample) continue;
    table.row(result_cells(first ? "all samples" : "", pooled.estimator, *pooled.by_sample, percent, longest), first);
    first = false;
  }
  return table;
}

HtmlTable all_figures_table(const validation::Validation& validation, double full_scale_m3_per_s) {
  const auto flow_and_share = [](const char* heading) {
    return HtmlTable::Column{heading, Set::number, units::Kind::flow, "% FS"};
  };
  HtmlTable table({{"Run", Set::text},
                   {"Estimator", Set::text},
                   {"Samples", Set::text},
                   {"number"},
                   flow_and_share("95 % below"),
                   flow_and_share("RMS"),
                   flow_and_share("largest"),
                   flow_and_share("bias"),
                   {"in band<br>%"},
                   flow_and_share("band width"),
                   {"width<br>/ RMS"}});
  const double percent = 100 / full_scale_m3_per_s;
  for (const validation::RunResult& run : validation.runs) {
    for (const validation::EstimatorResult& result : run.results) {
      if (!result.metrics) continue;
      add_all_figures(table, html_text(run.name), estimator_cell(result.estimator), *result.metrics, percent);
    }
  }
  for (const validation::PooledResult& pooled : validation.pooled) {
    if (!pooled.metrics || !validation::pools_several_runs(validation)) continue;
    add_all_figures(table, "<b>all runs</b>", estimator_cell(pooled.estimator), *pooled.metrics, percent);
    if (!pooled.by_sample) continue;
    add_all_figures(table, "all samples", estimator_cell(pooled.estimator), *pooled.by_sample, percent);
  }
  return table;
}

HtmlTable status_table(const validation::Validation& validation) {
  struct Said {
    std::string meaning;
    std::map<estimation::Estimator, double> samples;
  };
  std::vector<std::pair<std::string, Said>> statuses;
  double total = 0;
  for (const validation::RunResult& run : validation.runs) {
    total += static_cast<double>(run.samples);
    for (const validation::EstimatorResult& result : run.results) {
      for (const validation::StatusRow& row : result.status) {
        auto found = std::ranges::find_if(statuses, [&](auto& each) { return each.first == row.name; });
        if (found == statuses.end()) found = statuses.insert(statuses.end(), {row.name, {row.meaning, {}}});
        found->second.samples[result.estimator] += row.share * static_cast<double>(run.samples);
      }
    }
  }
  std::vector<HtmlTable::Column> columns{{"Status", Set::text}};
  for (const validation::PooledResult& pooled : validation.pooled) {
    columns.push_back({std::string(estimation::name(pooled.estimator)) + "<br>% of samples"});
  }
  columns.push_back({"What it says", Set::sentence});
  HtmlTable table(std::move(columns));
  for (auto& [name, said] : statuses) {
    std::vector<HtmlTable::Cell> cells{"<code>" + html_text(name) + "</code>"};
    for (const validation::PooledResult& pooled : validation.pooled) {
      const double share = 100 * said.samples[pooled.estimator] / total;
      cells.emplace_back(share > 0 ? fixed(share, share < 1 ? 2 : 1) : "");
    }
    cells.emplace_back(html_text(said.meaning));
    table.row(cells);
  }
  return table;
}

}  // namespace spoolflow::report
