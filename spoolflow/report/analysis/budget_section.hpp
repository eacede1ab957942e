#pragma once
#include "spoolflow/model/model.hpp"
#include "spoolflow/report/page/html_page.hpp"

namespace spoolflow::report {

/// The uncertainty budget in short, for pages about something else: what makes the uncertainty at three levels of
/// pressure, with default figures for the instruments and without Monte Carlo.
void budget_section(HtmlPage& page, const model::Model& model);

}  // namespace spoolflow::report
