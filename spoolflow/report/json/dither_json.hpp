#pragma once
#include <iosfwd>

#include "spoolflow/analysis/dither_study.hpp"

namespace spoolflow::report {

/// All figures of a dither study as JSON; the keys are described in docs/formats/analysis.md.
void write_dither_json(std::ostream& out, const model::Model& model, const analysis::DitherStudy& study);

}  // namespace spoolflow::report
