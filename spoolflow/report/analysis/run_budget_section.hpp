#pragma once
#include "spoolflow/analysis/run_analysis.hpp"
#include "spoolflow/report/page/html_page.hpp"

namespace spoolflow::report {

/// The budget along a recording: intervals over time, what makes them, and how many samples lie where they should.
void show_run_budget(HtmlPage& page, const analysis::RunAnalysis& run, double full_scale_m3_per_s);

}  // namespace spoolflow::report
