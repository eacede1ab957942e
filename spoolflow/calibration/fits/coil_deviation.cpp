#include "spoolflow/calibration/fits/coil_deviation.hpp"

#include "spoolflow/numerics/dual.hpp"
#include "spoolflow/parallel/for_each.hpp"

namespace spoolflow::calibration {
namespace {

using Dual = numerics::Dual<coil_unknowns>;

template <class T>
sensor::Coil<T> coil_of(const CoilTask& task, const T* unknowns) {
  const auto axis_of = [](const sensor::Axis<double>& axis) {
    return sensor::Axis<T>{T(axis.first), T(axis.spacing), T(axis.per_spacing)};
  };
  sensor::Coil<T> out;
  const auto& map = task.coil.flux_linkage.map;
  out.flux_linkage.map.row_axis = axis_of(map.row_axis);
  out.flux_linkage.map.column_axis = axis_of(map.column_axis);
  for (std::size_t k = 0; k < map.values.size(); ++k) out.flux_linkage.map.values[k] = T(map.values[k]);
  for (int k = 0; k < sensor::hysteresis_elements; ++k) {
    const auto e = static_cast<std::size_t>(k);
    const double threshold = task.coil.hysteresis.threshold[e];
    out.hysteresis.threshold[e] = T(threshold);
    out.hysteresis.stiffness[e] = unknowns[k] / T(threshold);
    out.hysteresis.stiffness_increase[e] = (unknowns[sensor::hysteresis_elements + k] - unknowns[k]) / T(threshold);
  }
  out.hysteresis.per_full_flux = T(task.coil.hysteresis.per_full_flux);
  out.eddy_currents = {unknowns[2 * sensor::hysteresis_elements], unknowns[2 * sensor::hysteresis_elements + 1],
                       T(task.coil.eddy_currents.smallest_rate_V)};
  return out;
}

/// The magnetising current at each sample while the armature is held.
template <class T, class Take>
void run(const CoilTask& task, const HeldArmature& held, const T* unknowns, const Take& take) {
  const sensor::Coil<T> coil = coil_of(task, unknowns);
  sensor::CoilState<T> state;
  const auto position =
      sensor::locate<sensor::flux_map_positions>(coil.flux_linkage.map.column_axis, T(held.position_m));
  for (std::size_t k = held.begin; k < held.end; ++k) {
    const auto& sample = task.samples.samples[k];
    sensor::follow_current(coil, state, {T(sample.time_step_s), T(sample.current_A)}, position, k == held.begin);
    take(k, state.magnetising_current_A);
  }
}

CoilDeviation deviation_while_held(const CoilTask& task, std::size_t h, const CoilUnknowns& unknowns,
                                   const Eigen::VectorXd& corrections_N) {
  constexpr int local = coil_unknowns + map_corrections;
  const HeldArmature& held = task.held[h];
  const auto& force_map = task.magnetic_force.map;
  const double largest_A = force_map.row_axis.at(sensor::force_map_currents - 1);
  const auto first = static_cast<Eigen::Index>(map_corrections * h);
  CoilDeviation out{0, Eigen::VectorXd::Zero(local), Eigen::MatrixXd::Zero(local, local), {}};
  Eigen::Matrix<double, local, 1> row;
  std::array<Dual, coil_unknowns> seeded;
  for (std::size_t n = 0; n < seeded.size(); ++n) {
    seeded[n] = Dual(unknowns[n]);
    seeded[n].slope[n] = 1;
  }
  run<Dual>(task, held, seeded.data(), [&](std::size_t k, const Dual& current_A) {
    if (!(task.weight[k] > 0)) return;
    const auto force = force_map.at(current_A.value, held.position_m);
    double deviation_N = force.value - task.samples.force_N[k];
    row.head<coil_unknowns>() =
        force.row_slope * Eigen::Map<const Eigen::Matrix<double, coil_unknowns, 1>>(current_A.slope.data());
    double power = 1;
    for (int c = 0; c < map_corrections; ++c) {
      deviation_N += corrections_N(first + c) * power;
      row(coil_unknowns + c) = power;
      power *= current_A.value / largest_A;
    }
    out.parts[task.samples.test[k]].add(deviation_N);
    row *= task.weight[k];
    deviation_N *= task.weight[k];
    out.sum_of_squares += deviation_N * deviation_N;
    out.gradient += deviation_N * row;
    out.curvature.selfadjointView<Eigen::Lower>().rankUpdate(row);
  });
  out.curvature.triangularView<Eigen::StrictlyUpper>() = out.curvature.transpose();
  return out;
}

}  // namespace

std::vector<HeldArmature> held_armature(const SolenoidSamples& samples) {
  std::vector<HeldArmature> out;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (samples.restarts[k] != 0) out.push_back({k, k, 0});
    out.back().end = k + 1;
    out.back().position_m += samples.samples[k].position_m;
  }
  for (HeldArmature& held : out) held.position_m /= static_cast<double>(held.end - held.begin);
  return out;
}

sensor::Coil<double> coil_with(const CoilTask& task, const CoilUnknowns& unknowns) {
  return coil_of<double>(task, unknowns.data());
}

CoilDeviation coil_deviation(const CoilTask& task, const CoilUnknowns& unknowns, const Eigen::VectorXd& corrections_N) {
  std::vector<CoilDeviation> parts(task.held.size());
  parallel::for_each(parts.size(), parallel::cores(),
                     [&](std::size_t h) { parts[h] = deviation_while_held(task, h, unknowns, corrections_N); });

  const Eigen::Index all = coil_unknowns + corrections_N.size();
  CoilDeviation out{0, Eigen::VectorXd::Zero(all), Eigen::MatrixXd::Zero(all, all), {}};
  for (std::size_t h = 0; h < parts.size(); ++h) {
    const Eigen::Index own = coil_unknowns + static_cast<Eigen::Index>(map_corrections * h);
    const CoilDeviation& part = parts[h];
    out.sum_of_squares += part.sum_of_squares;
    for (const auto& [test, left] : part.parts) out.parts[test] += left;
    out.gradient.head(coil_unknowns) += part.gradient.head(coil_unknowns);
    out.gradient.segment(own, map_corrections) = part.gradient.tail(map_corrections);
    out.curvature.topLeftCorner(coil_unknowns, coil_unknowns) +=
        part.curvature.topLeftCorner(coil_unknowns, coil_unknowns);
    out.curvature.block(0, own, coil_unknowns, map_corrections) =
        part.curvature.topRightCorner(coil_unknowns, map_corrections);
    out.curvature.block(own, 0, map_corrections, coil_unknowns) =
        part.curvature.bottomLeftCorner(map_corrections, coil_unknowns);
    out.curvature.block(own, own, map_corrections, map_corrections) =
        part.curvature.bottomRightCorner(map_corrections, map_corrections);
  }
  return out;
}

}  // namespace spoolflow::calibration
