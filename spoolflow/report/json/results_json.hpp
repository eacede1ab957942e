#pragma once
/// The figures of each command as JSON.
#include <iosfwd>
#include <vector>

#include "spoolflow/analysis/analysis.hpp"
#include "spoolflow/analysis/dither_study.hpp"
#include "spoolflow/analysis/ishigami.hpp"
#include "spoolflow/analysis/series_study.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/report/monitor/monitored_run.hpp"
#include "spoolflow/validation/estimate_summary.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// Of each recording: samples, mean flow and width of the band [L/min], share of samples with each status (0 to 1),
/// what was met while reading, doubts.
void write_estimate_summary(std::ostream& out, const std::vector<validation::EstimateSummary>& summaries);

/// All figures of a validation as JSON; the keys are described in docs/formats/metrics.md.
void write_metrics(std::ostream& out, const model::Model& model, const validation::Validation& validation);

/// All figures of an analysis as JSON; the keys are described in docs/formats/analysis.md.
void write_analysis_json(std::ostream& out, const model::Model& model, const analysis::Analysis& analysis);

/// The self-check of the Sobol indices, likewise.
void write_self_check_json(std::ostream& out, const analysis::SelfCheck& check);

/// All figures of a dither study as JSON; the keys are described in docs/formats/analysis.md.
void write_dither_json(std::ostream& out, const model::Model& model, const analysis::DitherStudy& study);

/// All figures of a series study as JSON; the keys are described in docs/formats/analysis.md.
void write_series_study_json(std::ostream& out, const model::Model& type, const analysis::SeriesStudy& study);

/// Condition, causes and indicators of a valve as JSON, with the baseline learnt; the keys are described in
/// docs/monitoring.md. A figure that is not known is null.
void write_monitor_json(std::ostream& out, const model::Model& model, const monitor::Monitor& watch,
                        const std::vector<MonitoredRun>& runs, const DoubtFigures& doubt);

}  // namespace spoolflow::report
