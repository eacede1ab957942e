#include <utility>

#include <nlohmann/json.hpp>

#include "spoolflow/report/analysis/series_study_report.hpp"
#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

using analysis::KnownBy;
using analysis::SeriesFigures;
using analysis::SeriesStudy;
using Ordered = nlohmann::ordered_json;

constexpr std::array series_figures{std::pair{"p95_percent_FS", &SeriesFigures::p95},
                                    std::pair{"largest_percent_FS", &SeriesFigures::largest},
                                    std::pair{"in_band_percent", &SeriesFigures::in_band},
                                    std::pair{"band_width_percent_FS", &SeriesFigures::band_width}};

Ordered over_units(const SeriesStudy& study, KnownBy by) {
  Ordered runs = Ordered::object();
  for (std::size_t run = 0; run < analysis::series_runs; ++run) {
    Ordered& figures = runs[analysis::series_run_names[run]] = Ordered::object();
    for (const auto& [name, figure] : series_figures) {
      const analysis::SeriesQuantiles over = study.over_units(by, run, figure);
      figures[name] = {{"median", 100 * over.median}, {"low_5", 100 * over.low}, {"high_95", 100 * over.high}};
    }
    figures["units_holding_93_percent"] = 100 * study.holding(by, run);
  }
  return {{"known_by", analysis::name(by)},
          {"units", study.units.size() - study.refused(by)},
          {"refused", study.refused(by)},
          {"runs", std::move(runs)}};
}

Ordered unit_row(const analysis::SeriesStudyUnit& unit) {
  Ordered out{{"spread_seed", unit.spread_seed}};
  for (const KnownBy by : analysis::all_known_by) {
    const analysis::SeriesJudged& judged = unit.judged(by);
    Ordered& row = out[analysis::name(by)] = Ordered::object();
    if (!judged.refusal.empty()) {
      row["refusal"] = judged.refusal;
      continue;
    }
    for (std::size_t run = 0; run < analysis::series_runs; ++run) {
      Ordered& figures = row[analysis::series_run_names[run]] = Ordered::object();
      for (const auto& [name, figure] : series_figures) figures[name] = 100 * judged.runs[run].*figure;
    }
  }
  return out;
}

}  // namespace

void write_series_study_json(std::ostream& out, const model::Model& type, const SeriesStudy& study) {
  Ordered file{{"format", "spoolflow series study"},
               {"version", 1},
               {"type", type.type->name},
               {"valve", study.valve},
               {"full_scale_L_min", units::L_per_min_from_m3_per_s(type.valve.rated_flow_m3_per_s)},
               {"seed", study.seed},
               {"units", study.units.size()},
               {"minute_s", study.minute_s},
               {"verdict", series_verdict(study)}};
  Ordered& runs = file["runs"] = Ordered::array();
  for (std::size_t run = 0; run < analysis::series_runs; ++run)
    runs.push_back({{"run", analysis::series_run_names[run]}, {"length_s", study.run_s[run]}});
  Ordered& over = file["over_units"] = Ordered::array();
  for (const KnownBy by : analysis::all_known_by) over.push_back(over_units(study, by));
  Ordered& rows = file["unit_rows"] = Ordered::array();
  for (const analysis::SeriesStudyUnit& unit : study.units) rows.push_back(unit_row(unit));
  out << file.dump(1) << '\n';
}

}  // namespace spoolflow::report
