#pragma once
/// The parts of a page that show a model and what it was made from.
#include "spoolflow/model/model.hpp"
#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/validation/run_result.hpp"

namespace spoolflow::report {

/// When and by what the model was made; the line below a page's title.
[[nodiscard]] std::string origin_of(const model::Model& model);
/// What a page on the model says beside its title: full scale, and that the model is of simulated recordings.
[[nodiscard]] Text headline_of(const model::Model& model);
/// "Flow P to B" or "Flow P to A", of a model of one direction.
[[nodiscard]] const char* flow_name(const model::Model& model);
/// Valve and oil; what was calibrated beside what the runs used.
void show_valve(HtmlPage& page, const model::Model& model, const std::vector<validation::RunResult>& runs);
/// How well the maps hold on the samples they were made from.
void show_residuals(HtmlPage& page, const model::Model& model);
/// Which quantities were measured, which inferred, which assumed; nothing where the model does not say.
void show_quantities(HtmlPage& page, const model::Model& model);
/// Input files with their checksums.
void show_inputs(HtmlPage& page, const model::Model& model, const std::vector<validation::RunResult>& runs);
/// The measured maps and what averaging removed (paper Figs 5 and 8).
void show_maps(HtmlPage& page, const model::Model& model);
/// Where a newton of force error costs much flow, and why.
void show_blindness(HtmlPage& page, const model::Model& model, const std::vector<validation::RunResult>& runs);

/// Loops of `solenoid_dynamic` with the model's, and residuals of both maps; nothing where the model has none of them.
void show_model_against_bench(HtmlPage& page, const model::Model& model);

/// Parameters with uncertainties, and the closest correlations; nothing where the model has no such fits.
void show_fits(HtmlPage& page, const model::Model& model);
/// Flow force and friction over position at the lowest, middle and highest calibrated oil temperature, at two thirds of
/// the highest pressure difference; nothing where the model has no observer or only one temperature.
void show_temperatures(HtmlPage& page, const model::Model& model);

}  // namespace spoolflow::report
