#include "spoolflow/plausibility/known_valve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "spoolflow/plausibility/bench_relations.hpp"
#include "spoolflow/plausibility/block_means.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

/// Strokes to and fro as a recording at an even speed.
class Strokes {
 public:
  void add(const std::vector<double>& position_m, bool opening) {
    std::vector<double>& x = strokes_.column(Channel::position);
    x.insert(x.end(), position_m.begin(), position_m.end());
    if (!opening) std::reverse(x.end() - static_cast<std::ptrdiff_t>(position_m.size()), x.end());
  }
  void add(Channel channel, const std::vector<double>& values, bool opening) {
    std::vector<double>& column = strokes_.column(channel);
    column.insert(column.end(), values.begin(), values.end());
    if (!opening) std::reverse(column.end() - static_cast<std::ptrdiff_t>(values.size()), column.end());
  }
  [[nodiscard]] Recording done() {
    std::vector<double>& time_s = strokes_.column(Channel::time);
    for (std::size_t k = 0; k < strokes_.column(Channel::position).size(); ++k)
      time_s.push_back(static_cast<double>(k));
    return std::move(strokes_);
  }

 private:
  Recording strokes_;
};

KnownValve direction_of(const model::Evidence& evidence, double stroke_m) {
  Strokes axial, magnetic;
  for (const model::AxialForceLoop& loop : evidence.axial_force) {
    for (const bool opening : {true, false}) {
      axial.add(loop.position_m, opening);
      axial.add(Channel::axial_force, opening ? loop.opening_N : loop.closing_N, opening);
      axial.add(Channel::flow, loop.flow_m3_per_s, opening);
      axial.add(Channel::pressure_difference, loop.pressure_difference_Pa, opening);
    }
  }
  for (const model::MagneticForceLoop& loop : evidence.magnetic_force) {
    for (const bool opening : {true, false}) {
      magnetic.add(loop.position_m, opening);
      magnetic.add(Channel::force, opening ? loop.opening_N : loop.closing_N, opening);
      magnetic.add(Channel::current, std::vector<double>(loop.position_m.size(), loop.current_A), opening);
    }
  }
  const Recording axial_strokes = axial.done();
  constexpr double any_density_kg_per_m3 = 870;  // the jet's momentum is not asked for
  return {.hydraulics = fit_hydraulics(nullptr, {&axial_strokes}, stroke_m, any_density_kg_per_m3),
          .magnetics = fit_magnetics(magnetic.done(), stroke_m),
          .coil = {},
          .opening = OpeningCurve({&axial_strokes}, stroke_m)};
}

}  // namespace

std::vector<KnownValve> known_valve(const model::Model& model) {
  std::vector<KnownValve> out{direction_of(model.evidence, model.valve.stroke_m)};
  const auto add_observed = [&](const std::optional<model::Observer>& observer) {
    if (!observer) return;
    out.back().coil.resistance_Ohm = observer->parameters.actuator.coil_resistance.resistance_Ohm;
    // What a machine has that declares nothing leaves no room for a recording error to hide in.
    if (model::declares_pressure(observer->parameters))
      out.back().hydraulics.bounding_pressure_Pa = observer->parameters.highest_pressure_difference_Pa();
    out.back().position_noise_m = observer->parameters.position_sensor.noise_m;
    out.back().oil_temperature_K = observer->oil_temperature_K;
    out.back().closed_below_m = observer->parameters.closed_below_m;
    out.back().open_stop_is_known = model.valve.open_stop_m.has_value();
    if (model.whole()) return;
    out.back().coil.flux_Wb = [map = observer->parameters.actuator.coil.flux_linkage.map](
                                  double current_A, double position_m) { return map.at(current_A, position_m).value; };
  };
  add_observed(model.observer);
  if (model.whole()) {
    out.push_back(direction_of(model.p_to_a->evidence, model.valve.stroke_m));
    add_observed(model.p_to_a->observer);
  }
  return out;
}

KnownValve known_valve(const Benches& benches) {
  constexpr std::size_t most = 1000;
  std::vector<Recording> maps;
  for (const Recording* map : benches.axial_force_maps) maps.push_back(block_means(*map, most));
  std::vector<const Recording*> of;
  for (const Recording& map : maps) of.push_back(&map);
  const Recording spring = block_means(*benches.spring, most);
  const Recording force_map = block_means(*benches.solenoid_force_map, most);
  const double resistance_Ohm = coil_resistance(force_map);
  return {.hydraulics = fit_hydraulics(&spring, of, benches.stroke_m, benches.density_kg_per_m3),
          .magnetics = fit_magnetics(force_map, benches.stroke_m),
          .coil = {std::isfinite(resistance_Ohm) ? resistance_Ohm : 0},
          .opening = OpeningCurve(of, benches.stroke_m)};
}

}  // namespace spoolflow::plausibility
