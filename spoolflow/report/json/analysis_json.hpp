#pragma once
#include <iosfwd>

#include "spoolflow/analysis/analysis.hpp"
#include "spoolflow/analysis/ishigami.hpp"

namespace spoolflow::report {

/// All figures of an analysis as JSON; the keys are described in docs/formats/analysis.md.
void write_analysis_json(std::ostream& out, const model::Model& model, const analysis::Analysis& analysis);

/// The self-check of the Sobol indices, likewise.
void write_self_check_json(std::ostream& out, const analysis::SelfCheck& check);

}  // namespace spoolflow::report
