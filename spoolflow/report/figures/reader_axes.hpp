#pragma once
/// Descriptions of drawings in the units in which they are drawn: every axis that names a quantity has its unit written
/// out and its values turned into it, every text is written out.
#include "spoolflow/report/figures/bar_chart.hpp"
#include "spoolflow/report/figures/figure.hpp"

namespace spoolflow::report {

[[nodiscard]] Figure in_units(Figure figure, const ReaderUnits& units);
[[nodiscard]] BarChart in_units(BarChart chart, const ReaderUnits& units);

}  // namespace spoolflow::report
