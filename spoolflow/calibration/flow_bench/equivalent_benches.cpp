#include "spoolflow/calibration/flow_bench/equivalent_benches.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/flow_bench/conductance_fit.hpp"
#include "spoolflow/calibration/flow_bench/flow_bench_fit.hpp"
#include "spoolflow/calibration/numerics/fitted_parameters.hpp"
#include "spoolflow/numerics/largest_magnitude.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using recording::Recording;

constexpr int samples_a_stroke = 481;
constexpr double time_step_s = 0.05;
constexpr int held_currents = 17;

/// A recording that is written sample by sample.
class Strokes {
 public:
  Strokes(std::filesystem::path file, double stroke_m) : stroke_m_(stroke_m) { recording_.file = std::move(file); }

  /// One stroke to and fro, with a rest at the closed end. `at(x, direction)` gives channels and values in SI.
  template <class At>
  void stroke(const At& at) {
    constexpr int rest = 8;
    for (int k = -rest; k < 2 * samples_a_stroke; ++k) {
      const int way = std::min(std::max(k, 0), 2 * samples_a_stroke - 1 - std::max(k, 0));
      const double x = stroke_m_ * way / (samples_a_stroke - 1);
      put(Channel::time, time_step_s * static_cast<double>(written_++));
      put(Channel::position, x);
      for (const auto& [channel, value] : at(x, k < samples_a_stroke ? 1.0 : -1.0)) put(channel, value);
    }
  }
  [[nodiscard]] Recording take() { return std::move(recording_); }

 private:
  void put(Channel channel, double value) { recording_.column(channel).push_back(value); }

  Recording recording_{};
  double stroke_m_;
  std::size_t written_ = 0;
};

using Values = std::vector<std::pair<Channel, double>>;

/// The fitted forces at one oil temperature.
class Forces {
 public:
  Forces(const FlowBenchFit& fit, double temperature_K, int edge) : fit_(fit) {
    const std::vector<double>& known = fit.layout.temperatures_K;
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < known.size(); ++k) {
      if (std::abs(known[k] - temperature_K) < std::abs(known[nearest] - temperature_K)) nearest = k;
    }
    layer_ = edge * fit.layout.layers_of_edge() + static_cast<int>(nearest);
  }
  [[nodiscard]] double spring_N(double x) const {
    return at(fit_.layout.spring, x, [&](int k) { return fit_.layout.spring_at(k); });
  }
  [[nodiscard]] double flow_force_N(double x, double pressure_Pa) const {
    return 1e-5 * pressure_Pa * at(fit_.layout.force, x, [&](int k) { return fit_.layout.force_at(layer_, k); });
  }
  [[nodiscard]] double friction_N(double x, double pressure_Pa) const {
    const double dry_N = at(fit_.layout.dry, x, [&](int k) { return fit_.layout.dry_at(layer_, k); });
    const double loaded = at(fit_.layout.loaded, x, [&](int k) { return fit_.layout.loaded_at(layer_, k); });
    return std::max(0.0, dry_N + 1e-5 * pressure_Pa * loaded);
  }

 private:
  template <class Place>
  [[nodiscard]] double at(const Knots& knots, double x, const Place& place) const {
    const Knots::Place here = knots.at(x);
    const Eigen::VectorXd& unknowns = fit_.forces.unknowns;
    return (1 - here.share) * unknowns(place(here.lower)) + here.share * unknowns(place(here.lower + 1));
  }

  const FlowBenchFit& fit_;
  int layer_;
};

Recording spring_of(const FlowBenchFit& fit, double temperature_K, double stroke_m) {
  Strokes out("spring, from strokes without pressure", stroke_m);
  const Forces forces(fit, temperature_K, 0);
  out.stroke([&](double x, double direction) {
    return Values{{Channel::axial_force, forces.spring_N(x) + direction * forces.friction_N(x, 0)},
                  {Channel::oil_temperature, temperature_K}};
  });
  return out.take();
}

Recording force_map_of(const FlowBenchFit& fit, double stroke_m) {
  Strokes out("magnetic force, from the flow bench", stroke_m);
  for (int level = 0; level < held_currents; ++level) {
    const double current_A = fit.layout.largest_current_A * level / (held_currents - 1);
    out.stroke([&](double x, double) {
      return Values{{Channel::current_set, current_A},
                    {Channel::current, current_A},
                    {Channel::force, fit.magnetic_force.at(current_A, x).value}};
    });
  }
  return out.take();
}

double interpolated(const std::vector<double>& values, double share) {
  const double raw = std::clamp(share, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const std::size_t lower = std::min(static_cast<std::size_t>(raw), values.size() - 2);
  const double of_upper = raw - static_cast<double>(lower);
  return (1 - of_upper) * values[lower] + of_upper * values[lower + 1];
}

Recording axial_force_of(const FlowBenchFit& fit, const ConductanceFit& flow, const std::filesystem::path& file,
                         double stroke_m, int edge = 0) {
  Strokes out(file, stroke_m);
  const Forces forces(fit, flow.oil_temperature_K, edge);
  for (const ConductanceLevel& level : flow.levels) {
    const double pressure_Pa = level.pressure_difference_Pa;
    out.stroke([&](double x, double direction) {
      const double conductance = interpolated(level.conductance_m3_per_s_per_rootPa, x / stroke_m);
      Values values{{Channel::axial_force, forces.spring_N(x) + forces.flow_force_N(x, pressure_Pa) +
                                               direction * forces.friction_N(x, pressure_Pa)},
                    {Channel::pressure_difference_set, pressure_Pa},
                    {Channel::pressure_difference, pressure_Pa},
                    {Channel::flow_reference, conductance * std::sqrt(pressure_Pa)}};
      if (!std::isnan(flow.oil_temperature_K)) values.emplace_back(Channel::oil_temperature, flow.oil_temperature_K);
      return values;
    });
  }
  return out.take();
}

/// Of the coil's sizes and the moving mass, with their covariance.
model::Fit known_of_coil(const FlowBenchFit& fit) {
  const std::vector<std::string> names{"coercive_current_without_flux_A", "coercive_current_increase_at_full_flux_A",
                                       "classical_eddy_current_A_per_V", "excess_eddy_current_A_per_rootV"};
  const Eigen::Index first = fit.layout.coil_at(0);
  return known_from("magnetic hysteresis and eddy currents, from motion on the flow bench", names,
                    {fit.coil_sizes.begin(), fit.coil_sizes.end()},
                    fit.forces.covariance.block(first, first, coil_sizes, coil_sizes));
}

/// Forces where the valve is three quarters open, and the flow force over that of a jet at 69 degrees.
model::Fit known_of_forces(const FlowBenchFit& fit, const ConductanceFit& flow, double stroke_m) {
  constexpr double at_stroke_share = 0.75, density_kg_per_m3 = 860, cosine_of_69_degrees = 0.358;
  const ForceLayout& layout = fit.layout;
  const double x = at_stroke_share * stroke_m;
  int layer = 0;
  while (layer + 1 < layout.layers_of_edge() &&
         layout.temperatures_K[static_cast<std::size_t>(layer)] < flow.oil_temperature_K - 3)
    ++layer;
  const auto knot = [&](const Knots& knots) { return static_cast<int>(std::lround(x / stroke_m * (knots.count - 1))); };
  const double conductance = interpolated(flow.levels.back().conductance_m3_per_s_per_rootPa, at_stroke_share);
  const double jet_N_per_bar = 1e5 * conductance * std::sqrt(2 * density_kg_per_m3) * cosine_of_69_degrees;
  const std::array<Eigen::Index, 4> at{
      layout.spring_at(knot(layout.spring)), layout.force_at(layer, knot(layout.force)),
      layout.dry_at(layer, knot(layout.dry)), layout.loaded_at(layer, knot(layout.loaded))};
  const std::array<double, 4> unit{1, 1e-5, 1, 1e-5};
  std::vector<double> values;
  Eigen::MatrixXd covariance(5, 5);
  covariance.setZero();
  for (Eigen::Index r = 0; r < 4; ++r) {
    const auto k = static_cast<std::size_t>(r);
    values.push_back(unit[k] * fit.forces.unknowns(at[k]));
    for (Eigen::Index c = 0; c < 4; ++c)
      covariance(r, c) =
          unit[k] * unit[static_cast<std::size_t>(c)] * fit.forces.covariance(at[k], at[static_cast<std::size_t>(c)]);
  }
  values.push_back(fit.forces.unknowns(at[1]) / jet_N_per_bar);
  covariance(4, 4) = fit.forces.covariance(at[1], at[1]) / (jet_N_per_bar * jet_N_per_bar);
  return known_from("forces from the flow bench, three quarters open",
                    {"spring_force_N", "flow_force_per_pressure_N_per_Pa", "friction_without_pressure_N",
                     "friction_per_pressure_N_per_Pa", "flow_force_over_that_of_a_jet_at_69_degrees"},
                    values, covariance);
}

/// By how much all forces may be wrong in proportion. Where no force rig says so, coenergy and the momentum of the jet
/// each give their scale, and what parts them is counted in full beside what the jet's angle is unknown by.
double scale_uncertainty(const EquivalentBenches& benches, const FlowBenchFit& fit, const MeasuredForces& measured) {
  if (measured.spring || !measured.axial.empty()) {
    const Eigen::Index middle = fit.layout.map_at(fit.layout.currents.count / 2, fit.layout.places.count / 2);
    return 2 * std::sqrt(std::max(0.0, fit.forces.covariance(middle, middle)));
  }
  const double share = force_over_jet(benches);
  return std::isnan(share) ? coenergy_scale_95 : std::abs(share - 1) + jet_force_95;
}

double largest_voltage_V(const FlowBenchRecordings& recordings) {
  double out = 0;
  for (const auto& all : {recordings.unpressurised, recordings.all_metering()}) {
    for (const Recording* recording : all)
      out = std::max(out, numerics::largest_magnitude(recording->column(Channel::voltage)));
  }
  return out;
}

ActuatorFit actuator_of(const FlowBenchFit& fit) {
  ActuatorFit out{};
  out.flux_linkage = fit.flux_linkage;
  out.actuator.magnetic_force = fit.magnetic_force;
  out.actuator.coil = fit.coil;
  out.actuator.coil_resistance = fit.flux_linkage.coil_resistance;
  out.actuator.friction_N.row_axis = fit.magnetic_force.map.row_axis;
  out.actuator.friction_N.column_axis = fit.magnetic_force.map.column_axis;
  out.actuator.coercive_current_A =
      std::max(sensor::saturated_output(fit.coil.hysteresis, 0.0), sensor::saturated_output(fit.coil.hysteresis, 1.0));
  out.actuator.per_wiping_flux = 0.5 / fit.coil.hysteresis.threshold.back();
  out.actuator.force_uncertainty_N = fit.forces.residual_N;
  const auto deviation = [&](int k) {
    const Eigen::Index at = fit.layout.coil_at(k);
    return std::sqrt(std::max(0.0, fit.forces.covariance(at, at)));
  };
  // The loop's size is inferred, the path within it assumed.
  out.actuator.current_uncertainty_A = std::hypot(0.3 * out.actuator.coercive_current_A, deviation(0), deviation(1));
  out.actuator.eddy_uncertainty = 0.1;
  out.friction = known_of_coil(fit);
  return out;
}

}  // namespace

void widen(std::vector<model::Residual>& residuals, const EquivalentBenches& flow_bench) {
  for (model::Residual& each : residuals) {
    const double least = each.unit == "N"      ? flow_bench.force_residual_N
                         : each.unit == "m3/s" ? flow_bench.flow_residual_m3_per_s
                                               : 0;
    each.rms = std::max(each.rms, least);
    each.largest = std::max(each.largest, each.rms);
  }
}

EquivalentBenches equivalent_benches(const FlowBenchRecordings& recordings, const MeasuredForces& measured,
                                     double stroke_m) {
  const FlowBenchFit fit = fit_flow_bench(recordings, measured, stroke_m);
  double temperature_K = std::nan("");
  for (const Recording* dry : recordings.unpressurised) temperature_K = mean_oil_temperature_K(*dry);
  if (std::isnan(temperature_K)) temperature_K = fit.layout.temperatures_K[fit.layout.temperatures_K.size() / 2];
  std::vector<const Recording*> of_valve = recordings.all_metering();
  of_valve.insert(of_valve.end(), recordings.unpressurised.begin(), recordings.unpressurised.end());
  EquivalentBenches out{spring_of(fit, temperature_K, stroke_m),
                        force_map_of(fit, stroke_m),
                        {},
                        {},
                        actuator_of(fit),
                        fit_position_sensor(of_valve, stroke_m),
                        fit.forces.residual_N,
                        0,
                        largest_voltage_V(recordings),
                        {},
                        measured.actuator.has_value(),
                        measured.spring.has_value(),
                        !measured.axial.empty(),
                        0};
  std::vector<ConductanceFit> flows;
  for (const Recording* metering : recordings.metering) {
    const ConductanceFit& flow = flows.emplace_back(fit_conductance(*metering, stroke_m));
    out.flow_residual_m3_per_s = std::max(out.flow_residual_m3_per_s, flow.residual_m3_per_s);
    out.axial_force_maps.push_back(axial_force_of(fit, flow, metering->file, stroke_m));
    if (out.known.empty()) out.known.push_back(known_of_forces(fit, flow, stroke_m));
  }
  for (const Recording* metering : recordings.metering_outlet) {
    const ConductanceFit flow = fit_conductance(*metering, stroke_m);
    out.flow_residual_m3_per_s = std::max(out.flow_residual_m3_per_s, flow.residual_m3_per_s);
    out.outlet_force_maps.push_back(axial_force_of(fit, flow, metering->file, stroke_m, 1));
  }
  const auto metered = [&](const AxialForceFit& map) {
    return std::ranges::any_of(flows, [&](const ConductanceFit& flow) {
      return !(std::abs(flow.oil_temperature_K - map.oil_temperature_K) > same_oil_K);
    });
  };
  for (const AxialForceFit& map : measured.axial) {
    if (!measured.actuator && !metered(map))
      out.axial_force_maps.push_back(
          axial_force_of(fit, conductance_of(map), "axial force, from force rig and flow bench", stroke_m));
  }
  out.force_scale_95 = scale_uncertainty(out, fit, measured);
  return out;
}

double force_over_jet(const EquivalentBenches& benches) {
  if (benches.spring_was_measured || benches.axial_force_was_measured || benches.known.empty()) return std::nan("");
  return benches.known.back().parameters.back().value;
}

std::string doubtful_scale(double share) {
  constexpr double most = 1.6;  // valves of the rig and of other simulators have 0.8 to 1.11
  if (std::isnan(share) || (share < most && share > 1 / most)) return {};
  return fmt::format(
      "the coil's coenergy makes the flow force {:.2g} times that of a jet at 69 degrees, {:.2g} to {:.2g} is usual: "
      "the scale of the voltage, of the current or of the flow meter is wrong, or the spool is compensated; a spring "
      "or axial_force_map of a force rig would tell",
      share, 1 / most, most);
}

}  // namespace spoolflow::calibration
