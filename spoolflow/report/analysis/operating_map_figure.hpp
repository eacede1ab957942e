#pragma once
#include <string>

#include "spoolflow/analysis/point_analysis.hpp"
#include "spoolflow/report/text/reader_units.hpp"

namespace spoolflow::report {

/// How uncertain an estimator is over position and pressure difference, and which group of inputs makes the most of it
/// there: two maps beside each other, as markup.
[[nodiscard]] std::string operating_map_figures(const analysis::OperatingMap& map, double full_scale_m3_per_s,
                                                const ReaderUnits& units);

}  // namespace spoolflow::report
