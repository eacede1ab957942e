#pragma once
/// The part of the calibration page that shows what the fits know of their parameters, and how the maps change with the
/// oil's temperature.
#include "spoolflow/model/model.hpp"
#include "spoolflow/report/page/html_page.hpp"

namespace spoolflow::report {

/// Parameters with uncertainties, and the closest correlations; nothing where the model has no such fits.
void show_fits(HtmlPage& page, const model::Model& model);
/// Flow force and friction over position at the lowest, middle and highest calibrated oil temperature, at two thirds of
/// the highest pressure difference; nothing where the model has no observer or only one temperature.
void show_temperatures(HtmlPage& page, const model::Model& model);

}  // namespace spoolflow::report
