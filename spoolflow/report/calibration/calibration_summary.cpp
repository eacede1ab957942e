#include "spoolflow/report/calibration/calibration_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// Values in the unit that is shown; a range that is open to one side has an infinite end.
SummaryLine line(std::string of, double value, std::string unit, double lowest, double highest) {
  std::string usually = std::isinf(highest)  ? fmt::format("above {:.3g} {}", lowest, unit)
                        : std::isinf(lowest) ? fmt::format("below {:.3g} {}", highest, unit)
                                             : fmt::format("{:.3g} to {:.3g} {}", lowest, highest, unit);
  const bool usual = value >= lowest && value <= highest;
  return {std::move(of), fmt::format("{:.3g}", value), std::move(unit), usual, std::move(usually)};
}

template <class Values>
double largest_of(const Values& values) {
  return *std::ranges::max_element(values);
}

/// What residuals of this unit are measured by: the valve's own largest force or flow.
double scale_of(const model::Residual& residual, double largest_force_N, double largest_flow_m3_per_s) {
  if (residual.unit == "m3/s") return largest_flow_m3_per_s;
  return residual.unit == "N" ? largest_force_N : no_limit;
}

}  // namespace

std::vector<SummaryLine> calibration_summary(const model::Model& model) {
  const sensor::CondensedParameters<double>& valve = model.condensed.parameters;
  const double stroke_m = model.valve.stroke_m;
  const double closed_N = valve.spring.at(0.0).value, open_N = valve.spring.at(stroke_m).value;
  double largest_force_N = 0, largest_flow_force_N = 0;
  for (const model::MagneticForceLoop& loop : model.evidence.magnetic_force)
    largest_force_N = std::max({largest_force_N, largest_of(loop.opening_N), largest_of(loop.closing_N)});
  for (const model::AxialForceLoop& loop : model.evidence.axial_force) {
    for (std::size_t k = 0; k < loop.position_m.size(); ++k) {
      const double axial_N = 0.5 * (loop.opening_N[k] + loop.closing_N[k]);
      largest_flow_force_N = std::max(largest_flow_force_N, axial_N - valve.spring.at(loop.position_m[k]).value);
    }
  }
  double friction_N = 0;
  constexpr int places = 20;
  for (int k = 0; k <= places; ++k)
    friction_N = std::max(friction_N, valve.friction_half_width_N.at(stroke_m * k / places).value);
  std::vector<SummaryLine> out{
      line("spring rate", 1e-3 * (open_N - closed_N) / stroke_m, "N/mm", 0.5, 200),
      line("spring preload", closed_N, "N", 0, 200),
      line("friction, half width, largest", friction_N, "N", 0, 0.3 * std::max(open_N, largest_flow_force_N)),
      line("magnetic force, largest", largest_force_N, "N", open_N, no_limit),
      line("flow force, largest", largest_flow_force_N, "N", 3 * friction_N, no_limit)};
  if (model.observer && model.observer->parameters.actuator.coil_resistance.resistance_Ohm > 0)
    out.push_back(
        line("coil resistance", model.observer->parameters.actuator.coil_resistance.resistance_Ohm, "Ohm", 0.5, 100));
  constexpr double usual_share = 0.02;
  const auto known = [&](const std::string& of) {
    return std::ranges::any_of(model.condensed.residuals, [&](const model::Residual& other) { return other.of == of; });
  };
  const auto add_residuals = [&](const std::vector<model::Residual>& residuals, bool observer) {
    for (const model::Residual& residual : residuals) {
      if ((observer && known(residual.of)) || residual.unit == "m" || residual.of.find(", with ") != std::string::npos)
        continue;  // a fit's alternatives, and what has no scale
      const bool flow = residual.unit == "m3/s";
      const double scale = flow ? units::litre_per_minute_per_m3_per_s : 1.0;
      const double most = usual_share * scale_of(residual, largest_force_N, model.valve.rated_flow_m3_per_s) * scale;
      out.push_back(line(fmt::format("residual of {}, RMS", residual.of), residual.rms * scale,
                         flow ? "L/min" : residual.unit, -no_limit, most));
    }
  };
  add_residuals(model.condensed.residuals, false);
  if (model.observer) add_residuals(model.observer->residuals, true);
  return out;
}

}  // namespace spoolflow::report
