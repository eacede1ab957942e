#pragma once
#include <iosfwd>
#include <string>

#include "spoolflow/analysis/series_study.hpp"
#include "spoolflow/report/text/reader_units.hpp"

namespace spoolflow::report {

/// In words, for tables and legends.
[[nodiscard]] const char* known_by_name(analysis::KnownBy by);
[[nodiscard]] std::string series_run_name(std::size_t run);

/// What the minute buys over the series, in one sentence.
[[nodiscard]] std::string series_verdict(const analysis::SeriesStudy& study);

/// One page about the units of a type: quantiles over them, their errors as curves, and what calibration refused.
void write_series_study_report(std::ostream& out, const model::Model& type, const analysis::SeriesStudy& study,
                               const ReaderUnits& units = {});

}  // namespace spoolflow::report
