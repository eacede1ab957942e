#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "spoolflow/analysis/dither_study.hpp"
#include "spoolflow/report/text/reader_units.hpp"
#include "spoolflow/report/text/text.hpp"

namespace spoolflow::report {

/// How to dither, in plain words; `remarks` say what it brings and what the figures rest on.
struct DitherVerdict {
  Text sentence;
  std::vector<Text> remarks;
};
[[nodiscard]] DitherVerdict dither_verdict(const model::Model& model, const analysis::DitherStudy& study);

/// One page about dither: the recommended setting, band and ripple over amplitude and frequency, and every point.
void write_dither_report(std::ostream& out, const model::Model& model, const analysis::DitherStudy& study,
                         const ReaderUnits& units = {});

}  // namespace spoolflow::report
