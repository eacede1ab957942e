#pragma once
#include <iosfwd>

#include "spoolflow/analysis/series_study.hpp"

namespace spoolflow::report {

/// All figures of a series study as JSON; the keys are described in docs/formats/analysis.md.
void write_series_study_json(std::ostream& out, const model::Model& type, const analysis::SeriesStudy& study);

}  // namespace spoolflow::report
