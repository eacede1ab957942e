#pragma once
/// The calibrated model beside what the bench measured: current loops, and what the maps leave over position.
#include "spoolflow/model/model.hpp"
#include "spoolflow/report/page/html_page.hpp"

namespace spoolflow::report {

/// Loops of `solenoid_dynamic` with the model's, and residuals of both maps; nothing where the model has none of them.
void show_model_against_bench(HtmlPage& page, const model::Model& model);

}  // namespace spoolflow::report
