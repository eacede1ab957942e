#pragma once
/// The answer where the pressures at the ports are measured: they take the place of the estimated pressure difference.
#include "spoolflow/sensor/band.hpp"
#include "spoolflow/sensor/whole_valve/port_pressures.hpp"

namespace spoolflow::sensor {

/// The measured pressure difference is the estimate.
template <class T>
constexpr void use_measured(const ObserverParameters<T>& valve, PressureState<T>& pressure, const PathDrops<T>& drops) {
  const T measured_Pa = limited(drops.forcing_Pa(), T(0), valve.highest_pressure_difference_Pa());
  pressure.pressure_difference_Pa = pressure.observed_Pa = measured_Pa;
  pressure.variance_Pa2 = squared(T(2 * port_pressure_deviation_Pa));
  pressure.covariance_Pa = pressure.constrained_correction_Pa = T(0);
  pressure.drift_variance_Pa2 = pressure.unobserved_variance_Pa2 = T(0);
}

/// What is measured of the open path, and the inlet edge's share of its drop.
template <class T>
struct MeasuredPath {
  const PathDrops<T>& drops;
  T inlet_share;
};

/// The oil and where the spool is, in the direction's signs.
template <class T>
struct EdgePlace {
  const Cell<T>& oil_layer;
  T position_m;
};

/// The flow rate by measured port pressures, signed in the direction's own sense.
template <class T>
constexpr void answer_measured(const ObserverParameters<T>& valve, const MeasuredPath<T>& path, const EdgePlace<T>& at,
                               Estimate<T>& out) {
  const DrivingDrop<T> drop = driving_drop(path.drops, path.inlet_share);
  const T conductance = valve.edge.at(at.oil_layer, magnitude(drop.drop_Pa), at.position_m).conductance;
  const T uncertain_Pa = valve.band.coverage_factor * drop.deviation_Pa;
  out.flow_m3_per_s = conductance * signed_root(drop.drop_Pa);
  band_of_flow(valve, conductance * signed_root(drop.drop_Pa - uncertain_Pa),
               conductance * signed_root(drop.drop_Pa + uncertain_Pa), out);
  out.pressure_difference_Pa = path.drops.inlet_Pa + path.drops.outlet_Pa;
  mark(out.status, flow_reversed(path.drops), Status::flow_reversed);
}

}  // namespace spoolflow::sensor
