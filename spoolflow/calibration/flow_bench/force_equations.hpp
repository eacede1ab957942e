#pragma once
/// What the valve's own solenoid shows of all forces while the spool slides on the flow bench:
///
///     F_mag(i_m, x) - F_spring(x) - dp g(x, T) - s (a(x, T) + dp b(x, T)) - m dv/dt = 0
///
/// s is the direction of motion, i_m the magnetising current: the coil current less hysteresis and eddy currents. Flow
/// force and friction are linear in the pressure difference (paper section 2.1.3 and eq. (2) at a given opening). The
/// magnetic force is that of the coenergy times 1 + c(i, x), c small and smooth. Everything is linear in the unknowns
/// but the coil, which is linearised about where it stands.
#include <array>
#include <vector>

#include <Eigen/Core>

#include "spoolflow/calibration/flow_bench/tracked_run.hpp"
#include "spoolflow/sensor/coil.hpp"
#include "spoolflow/sensor/force_maps.hpp"

namespace spoolflow::calibration {

/// Linear between `count` equally spaced knots from 0 to `end`.
struct Knots {
  int count;
  double end;

  struct Place {
    int lower;
    double share;
  };
  [[nodiscard]] Place at(double x) const;
};

/// Sizes of hysteresis and eddy currents, from which the coil follows.
inline constexpr int coil_sizes = 4;
using CoilSizes = std::array<double, coil_sizes>;

/// The unknowns and their places in one vector.
struct ForceLayout {
  double largest_current_A;
  double stroke_m;
  std::vector<double> temperatures_K;  ///< rising; one at least
  int edges;                           ///< 2 where inlet and outlet were metered one at a time, each with its layers

  Knots currents{9, 1}, places{9, 1}, spring{17, 1}, force{33, 1}, dry{4, 1}, loaded{9, 1};

  ForceLayout(double largest_current, double stroke, std::vector<double> temperatures, int edges_apart = 1);
  [[nodiscard]] int layers_of_edge() const { return static_cast<int>(temperatures_K.size()); }
  [[nodiscard]] int layers() const { return edges * layers_of_edge(); }
  [[nodiscard]] int map_at(int current, int place) const { return current * places.count + place; }
  [[nodiscard]] int spring_at(int k) const { return currents.count * places.count + k; }
  [[nodiscard]] int force_at(int layer, int k) const { return spring_at(spring.count) + layer * force.count + k; }
  [[nodiscard]] int dry_at(int layer, int k) const { return force_at(layers(), 0) + layer * dry.count + k; }
  [[nodiscard]] int loaded_at(int layer, int k) const { return dry_at(layers(), 0) + layer * loaded.count + k; }
  [[nodiscard]] int mass() const { return loaded_at(layers(), 0); }
  [[nodiscard]] int coil_at(int k) const { return mass() + 1 + k; }
  [[nodiscard]] int unknowns() const { return coil_at(coil_sizes); }
};

/// A force rig moved the spool there: spring and flow force, mean of both directions.
struct MeasuredForce {
  double position_m, pressure_difference_Pa, oil_temperature_K, force_N;
};

/// What is known beforehand.
struct ForcePriors {
  double map_share = 0.08;  ///< by which the coenergy's force may be wrong at a knot
  double map_scale = 0.03;  ///< by which it may be wrong on the average, where no force rig says so
  double map_bend = 0.01;   ///< by which its share may bend from knot to knot
  CoilSizes coil{}, coil_deviation{};
  std::vector<MeasuredForce> measured{};
  double mass_kg = 0.11;
  double mean_travel_m = 0;  ///< samples of one way over so much travel count as their mean; 0: each by itself
};

struct ForceSolution {
  Eigen::VectorXd unknowns;
  Eigen::MatrixXd covariance;
  double residual_N;  ///< RMS, robust
  double largest_N;
  std::size_t samples;
};

/// A run with the magnetising current of its sliding samples, and what the coil's sizes change of it.
struct RunForces {
  const TrackedRun* run;
  const std::vector<SlidingSample>* samples;  ///< the run's that count
  std::vector<double> magnetising_A;
  std::vector<std::array<double, coil_sizes>> per_size;
  std::vector<double> armature_friction_N;  ///< where it was measured apart; else empty
};

/// Solves about `before` (empty at first), where the coil had the sizes `at`.
[[nodiscard]] ForceSolution solve_forces(const ForceLayout& layout, const ForcePriors& priors,
                                         const sensor::MagneticForce<double>& coenergy_force,
                                         const std::vector<RunForces>& runs, const CoilSizes& at,
                                         const Eigen::VectorXd& before);

/// The coenergy's map with the solution's correction.
[[nodiscard]] sensor::MagneticForce<double> corrected_map(const ForceLayout& layout,
                                                          const sensor::MagneticForce<double>& coenergy_force,
                                                          const Eigen::VectorXd& unknowns);

}  // namespace spoolflow::calibration
