#pragma once
/// What was measured on the bench, drawn from the model's evidence.
#include "spoolflow/model/model.hpp"
#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/validation/run_result.hpp"

namespace spoolflow::report {

/// Flow rate over axial force, both directions, with lines of equal position (paper Fig 5).
[[nodiscard]] CaptionedFigure flow_force_figure(const model::Evidence& evidence);
/// Magnetic force over position at held currents, both directions (paper Fig 8).
[[nodiscard]] CaptionedFigure magnetic_force_figure(const model::Evidence& evidence);
/// Half the width of the axial-force loops: spool friction.
[[nodiscard]] CaptionedFigure friction_figure(const model::Evidence& evidence);
/// Half the width of the magnetic-force loops: magnetic hysteresis and armature friction.
[[nodiscard]] CaptionedFigure hysteresis_figure(const model::Evidence& evidence);
/// What a newton of force error costs, by position and pressure difference; with the points at which `runs` worked.
[[nodiscard]] CaptionedFigure sensitivity_figure(const model::Model& model,
                                                 const std::vector<validation::RunResult>& runs);

}  // namespace spoolflow::report
