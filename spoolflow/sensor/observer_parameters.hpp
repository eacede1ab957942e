#pragma once
/// Parameters and state of the observer (observer.hpp), whose stages each read a part of them.
#include <type_traits>

#include "spoolflow/sensor/actuator.hpp"
#include "spoolflow/sensor/dither.hpp"
#include "spoolflow/sensor/friction.hpp"
#include "spoolflow/sensor/metering_edge.hpp"
#include "spoolflow/sensor/position_track.hpp"
#include "spoolflow/sensor/pressure_difference.hpp"
#include "spoolflow/sensor/sample.hpp"
#include "spoolflow/sensor/spring.hpp"

namespace spoolflow::sensor {

/// How sure the observer may be, beyond what its parts tell; see band.hpp.
template <class T>
struct BandParameters {
  T friction_share{};    ///< standard deviation of sliding friction about its map, as a share of it
  T force_residual_N{};  ///< standard deviation of all maps together
  T flow_residual_m3_per_s{};
  T coverage_factor{};  ///< standard deviations in the 95 % band
  T force_share{};      ///< how much of the force errors that the parts tell the band counts while the spool slides
  T rest_share{};       ///< the same at rest
  T tolerance_N{};    ///< standard deviation of where the band's ends at rest lie, told by the pre-sliding displacement
  T creep_per_s{};    ///< growth of that tolerance with the time at rest, as a share of it
  T unseen_factor{};  ///< standard deviation of unobserved changes of pressure over the resting drift's, at its most
};

/// How the open path's pressure difference lies over its two edges while both pass the flows of the calibrated load.
/// Asked for only where a whole valve's port pressures are measured.
template <class T>
struct InletShare {
  T share = T(0.5);   ///< that lies over the inlet edge, P to B or P to A
  T range = T(0.25);  ///< measured pressures may tell one that differs from it by so much
};

/// Everything about one valve that the observer needs; trivially copyable, fit for constexpr flash.
template <class T>
struct ObserverParameters {
  ActuatorParameters<T> actuator;
  Spring<T> spring;
  MeteringEdge<T> edge;
  PositionSensor<T> position_sensor;
  FrictionParameters<T> friction;
  PressureParameters<T> pressure;
  BandParameters<T> band;
  InletShare<T> inlet;
  T unsettled_load_share{};  ///< of a whole valve: half the width that a flow takes which its load has not settled to,
                             ///< over the change still to settle; 0 where both edges always pass the load's flows
  T moving_mass_kg{};        ///< spool, push rod and armature together
  T closed_below_m{};
  T largest_current_A{};
  T largest_voltage_V{};  ///< of the coil, as calibration saw it; 0: not known. The step reads no limit from it.
};

template <class T>
struct ObserverState {
  ActuatorState<T> actuator;
  PositionState<T> position;
  FrictionState<T> friction;
  PressureState<T> pressure;
  DitherState<T> dither;
  FrictionSwingState<T> swing;
  T oil_temperature_K{};  ///< smoothed
  T oil_fault_s{};        ///< for how long its sensor has read what no oil has
  T force_noise_N{};      ///< one standard deviation of all forces together, as the parts tell it
  bool started{};         ///< a sample came in
  Estimate<T> last{};
};

static_assert(std::is_trivially_copyable_v<ObserverParameters<float>>);
static_assert(std::is_trivially_copyable_v<ObserverState<float>>);
static_assert(sizeof(ObserverState<float>) < 2048);

}  // namespace spoolflow::sensor
