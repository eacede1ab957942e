#pragma once
#include <iosfwd>

#include "spoolflow/analysis/analysis.hpp"
#include "spoolflow/report/text/reader_units.hpp"

namespace spoolflow::report {

/// One page about an analysis: what to improve next, the budget, its check, the maps, and the global study.
void write_analysis_report(std::ostream& out, const model::Model& model, const analysis::Analysis& analysis,
                           const ReaderUnits& units = {});

}  // namespace spoolflow::report
