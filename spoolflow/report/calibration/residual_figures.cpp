#include <algorithm>
#include <functional>
#include <map>
#include <span>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/report/calibration/model_sections.hpp"

namespace spoolflow::report {
namespace {

using model::MapResidual;
using model::SolenoidTrace;

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out;
  for (std::size_t k = 0; k < a.size(); ++k) out.push_back(a[k] - b[k]);
  return out;
}

/// How far the force lies from the averaged map, over current: measured, and what the model makes of it.
CaptionedFigure loops_figure(const std::vector<SolenoidTrace>& traces) {
  constexpr std::size_t most_parts = 6;
  const std::span<const SolenoidTrace> parts(traces.data(), std::min(most_parts, traces.size()));
  Figure figure{.description = "Magnetic force less the averaged map over coil current, measured and modelled",
                .x_title = "Coil current",
                .x_quantity = units::Kind::current};
  calibration::FitResidual map_N, model_N;
  for (const SolenoidTrace& part : parts) {
    const std::vector<double> measured_N = difference(part.measured_N, part.map_N);
    const std::vector<double> modelled_N = difference(part.model_N, part.map_N);
    const bool first = &part == &parts.front();
    Panel panel{.title = part.test == 0 ? "Force less the averaged map"
                                        : fmt::format("Part {}: force less the averaged map", part.test),
                .quantity = units::Kind::force,
                .height_px = 170};
    panel.marks.push_back({.shape = Shape::dots,
                           .tone = "condensed",
                           .name = first ? "measured" : "",
                           .width_px = 4.5,
                           .x = part.current_A,
                           .y = measured_N});
    panel.marks.push_back({.shape = Shape::dots,
                           .tone = "observer",
                           .name = first ? "model with hysteresis and eddy currents" : "",
                           .width_px = 2.2,
                           .x = part.current_A,
                           .y = modelled_N});
    figure.panels.push_back(std::move(panel));
    for (std::size_t k = 0; k < measured_N.size(); ++k) {
      map_N.add(measured_N[k]);
      model_N.add(measured_N[k] - modelled_N[k]);
    }
  }
  return {std::move(figure),
          phrase("The solenoid at {}, armature held: how far the magnetic force lies from the averaged map. The "
                 "map alone leaves {} (RMS), the model with hysteresis and eddy currents {}.",
                 fixed(units::length(parts.front().position_m), 2), three_digits(units::force(map_N.rms())),
                 three_digits(units::force(model_N.rms())))};
}

/// Mean deviations of one family of strokes as lines, RMS in the caption.
Panel residual_panel(Text title, const std::vector<const MapResidual*>& family,
                     const std::function<QuantityText(const MapResidual&)>& name, bool named) {
  Panel panel{.title = std::move(title), .quantity = units::Kind::force, .height_px = 200};
  for (std::size_t k = 0; k < family.size(); ++k) {
    panel.marks.push_back({.ramp = ramp(k, family.size()),
                           .name = named ? Text(name(*family[k])) : Text(),
                           .width_px = 1.2,
                           .x = family[k]->position_m,
                           .y = family[k]->mean_N});
  }
  return panel;
}

double rms_of(const std::vector<MapResidual>& residuals) {
  calibration::FitResidual all_N;
  for (const MapResidual& each : residuals)
    for (const double rms_N : each.rms_N) all_N.add(rms_N);
  return all_N.rms();
}

CaptionedFigure magnetic_residual_figure(const std::vector<MapResidual>& residuals) {
  std::vector<const MapResidual*> family;
  for (const MapResidual& each : residuals) family.push_back(&each);
  Figure figure{.description = "What the magnetic force map leaves of the strokes, over position",
                .x_title = "Position",
                .x_quantity = units::Kind::length};
  figure.panels.push_back(residual_panel(
      "Magnetic force less model", family, [](const MapResidual& each) { return fixed(units::current(each.held), 2); },
      true));
  return {std::move(figure),
          phrase("What magnetic force, hysteresis and armature friction leave of the force map's strokes, averaged "
                 "at each position; single samples deviate by {} (RMS).",
                 three_digits(units::force(rms_of(residuals))))};
}

CaptionedFigure axial_residual_figure(const std::vector<MapResidual>& residuals) {
  std::map<double, std::vector<const MapResidual*>> by_temperature;
  for (const MapResidual& each : residuals) by_temperature[each.oil_temperature_K].push_back(&each);
  Figure figure{.description = "What spring, flow force and friction leave of the axial-force strokes, over position",
                .x_title = "Position",
                .x_quantity = units::Kind::length};
  for (const auto& [temperature_K, family] : by_temperature) {
    const Text warm = temperature_K > 0 ? phrase("{}: ", fixed(units::temperature(temperature_K), 0)) : Text();
    figure.panels.push_back(residual_panel(
        phrase("{}axial force less model", warm), family,
        [](const MapResidual& each) { return three_digits(units::pressure(each.held)); }, figure.panels.empty()));
  }
  return {std::move(figure),
          phrase("What spring, flow force and friction leave of the axial-force strokes, averaged at each position; "
                 "single samples deviate by {} (RMS).",
                 three_digits(units::force(rms_of(residuals))))};
}

}  // namespace

void show_model_against_bench(HtmlPage& page, const model::Model& model) {
  const model::Evidence& evidence = model.evidence;
  std::vector<CaptionedFigure> residuals;
  if (!evidence.bench.axial_force.empty()) residuals.push_back(axial_residual_figure(evidence.bench.axial_force));
  if (!evidence.bench.magnetic_force.empty())
    residuals.push_back(magnetic_residual_figure(evidence.bench.magnetic_force));
  if (residuals.empty() && evidence.bench.solenoid.empty()) return;
  page.section("The model against the bench");
  if (!evidence.bench.solenoid.empty()) page.figure(loops_figure(evidence.bench.solenoid));
  if (!residuals.empty()) page.pair(residuals);
}

}  // namespace spoolflow::report
