#pragma once
/// The parts of a page that show a model and what it was made from.
#include "spoolflow/model/model.hpp"
#include "spoolflow/report/html_page.hpp"

namespace spoolflow::report {

/// Valve, oil, ranges, residuals, input files with checksums.
void describe_valve(HtmlPage& page, const model::Model& model);
/// Flow over axial force for lines of position (paper Fig 5).
void show_flow_force_map(HtmlPage& page, const model::Model& model);
/// Magnetic force over position per current, both directions (paper Fig 8).
void show_magnetic_force_map(HtmlPage& page, const model::Model& model);
/// Where a newton of force error costs much flow, and why.
void show_sensitivity(HtmlPage& page, const model::Model& model);

}  // namespace spoolflow::report
