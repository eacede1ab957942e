#pragma once
/// The parts of a page that show one validated run.
#include "spoolflow/report/html_page.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// Measured, estimated with band, error over time (paper Figs 9, 10); forces; error over flow, position, temperature;
/// status.
void show_run(HtmlPage& page, const validation::ValidatedRun& run, double full_scale_m3_per_s);

}  // namespace spoolflow::report
