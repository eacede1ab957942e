#pragma once
/// Flow force, spool friction and flow over position, pressure difference and oil temperature, for the full sensor.
#include <string>
#include <vector>

#include "spoolflow/calibration/fits/axial_force.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/sensor/force_maps.hpp"
#include "spoolflow/sensor/metering_edge.hpp"

namespace spoolflow::calibration {

/// Of two recordings of oil that differs by less, one counts.
inline constexpr double same_oil_temperature_K = 1;

/// Maps of one oil temperature hold so far to either side of it.
inline constexpr double about_one_temperature_K = 5;

/// One position over the pressure differences that were held, from none on: there is no force, the conductance that of
/// the lowest level, and the friction to be found.
struct EdgeLevels {
  std::vector<double> pressure_Pa;
  std::vector<double> force_N;     ///< of the flow; does not fall
  std::vector<double> friction_N;  ///< the first is 0
  std::vector<double> conductance;
};
[[nodiscard]] EdgeLevels levels_at(const AxialForceFit& fit, std::size_t position, double spring_N);

struct MeteringEdgeFit {
  sensor::MeteringEdge<double> edge;
  double lowest_temperature_K;
  double highest_temperature_K;
  std::vector<model::Fit> known;  ///< each map at three quarters of the stroke, as a law of pressure and temperature
};

/// One fit an oil temperature, any order, positions free of drift. With one temperature the layers are alike
/// (other_oil.hpp); between temperatures they are interpolated linearly. Levels are interpolated onto equally spaced
/// pressure differences from zero, where there is neither flow nor flow force and friction is that of the spring
/// recording.
[[nodiscard]] MeteringEdgeFit fit_metering_edge(std::vector<AxialForceFit> fits, const sensor::Spring<double>& spring,
                                                const std::vector<double>& unloaded_friction_N);

[[nodiscard]] inline bool is_of_one_temperature(const MeteringEdgeFit& fit) {
  return fit.highest_temperature_K - fit.lowest_temperature_K < same_oil_temperature_K;
}

/// A sentence for each of the recordings of one edge that fit_metering_edge() leaves aside, or another for its sake: of
/// the same oil temperature, or of one that nobody recorded.
[[nodiscard]] std::vector<std::string> maps_left_aside(const std::vector<const recording::Recording*>& maps);

}  // namespace spoolflow::calibration
