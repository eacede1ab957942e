#pragma once
/// Parameters and state of the observer (observer.hpp), whose stages each read a part of them.
#include <type_traits>

#include "spoolflow/sensor/actuator.hpp"
#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/force_maps.hpp"
#include "spoolflow/sensor/friction.hpp"
#include "spoolflow/sensor/metering_edge.hpp"
#include "spoolflow/sensor/pressure_difference.hpp"
#include "spoolflow/sensor/signals/current_guard.hpp"
#include "spoolflow/sensor/signals/dither.hpp"
#include "spoolflow/sensor/signals/oil_temperature.hpp"
#include "spoolflow/sensor/signals/position_track.hpp"

namespace spoolflow::sensor {

/// How sure the observer may be, beyond the uncertainty of its parts; see band.hpp.
template <class T>
struct BandParameters {
  T friction_share{};    ///< standard deviation of sliding friction about its map, as a share of it
  T force_residual_N{};  ///< standard deviation of all maps together
  T flow_residual_m3_per_s{};
  T coverage_factor{};    ///< standard deviations in the 95 % band
  T force_share{};        ///< share of the parts' force errors that the band counts while the spool slides
  T rest_share{};         ///< the same at rest
  T tolerance_N{};        ///< standard deviation of the band's ends at rest, from the pre-sliding displacement
  T creep_per_s{};        ///< growth of that tolerance with the time at rest, as a share of it
  T unobserved_factor{};  ///< standard deviation of unobserved changes of pressure over the resting drift's, at its
                          ///< most
};

/// How the open path's pressure difference lies over its two edges while both pass the flows of the calibrated load.
/// Asked for only where a whole valve's port pressures are measured.
template <class T>
struct InletShare {
  T share = T(0.5);   ///< that lies over the inlet edge, P to B or P to A
  T range = T(0.25);  ///< measured pressures may show one that differs from it by so much
};

/// What the machine around the valve leaves unknown, one standard deviation each; {} is the bench (band.hpp).
template <class T>
struct Environment {
  T position_m{};           ///< of the position's zero
  T position_share{};       ///< of the position's gain
  T oil_temperature_K{};    ///< of the oil temperature, or what another viscosity comes to
  T current_share{};        ///< of the current's gain, or of its mean over a sample
  T force_N{};              ///< that acts on the spool beside those of the model: acceleration of the valve
  T friction_share{};       ///< of friction about what was calibrated
  T dithered_loop_A{};      ///< of the magnetic loop under dither
  T ripple_Pa{};            ///< amplitude of the pressure difference's ripple
  T flow_share{};           ///< of the conductance: oil
  T leakage_m3_per_s{};     ///< past the metering edge
  T highest_pressure_Pa{};  ///< pressure difference up to which the model answers, at least the calibrated one
};

/// No spool gets there [m]: the open stop of a valve of which none is known.
inline constexpr double no_open_stop_m = 1;

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
  T stopped_above_m{no_open_stop_m};  ///< positions above this count as on the open stop
  T largest_current_A{};
  T largest_voltage_V{};  ///< of the coil, as calibration saw it; 0: not known. The step reads no limit from it.
  CurrentLimits<T> current_limits;
  Environment<T> environment;

  /// The highest pressure difference that the observer answers [Pa]: the declared one, or the calibrated one.
  [[nodiscard]] constexpr T highest_pressure_difference_Pa() const {
    return larger(environment.highest_pressure_Pa, edge.highest_pressure_difference_Pa());
  }
};

/// How wrong the forces may be that the pressure difference is estimated from [N], one standard deviation each.
template <class T>
struct ForceErrors {
  T environment_N{};  ///< that the machine around the valve leaves open
  T noise_N{};        ///< of all forces together, as their parts say
};

template <class T>
struct ObserverState {
  ActuatorState<T> actuator;
  PositionState<T> position;
  FrictionState<T> friction;
  PressureState<T> pressure;
  DitherState<T> dither;
  FrictionSwingState<T> swing;
  OilState<T> oil;
  Cell<T> oil_layer{};  ///< of its temperature in the edge's tables
  T drift_m{};          ///< of the position's zero at that temperature
  Status oil_status{};  ///< what must be said of it with each answer
  ForceErrors<T> force_errors;
  T unmoved_s{};        ///< for how long the forces have contradicted a closed position (closed_evidence.hpp)
  int held_currents{};  ///< samples in a row whose current was implausible and replaced
  Sample<T> held{};     ///< the last of them, with the current that stood in
  bool started{};       ///< a sample came in
  Estimate<T> last{};
};

static_assert(std::is_trivially_copyable_v<ObserverParameters<float>>);
static_assert(std::is_trivially_copyable_v<ObserverState<float>>);
static_assert(sizeof(ObserverState<float>) < 2048);

}  // namespace spoolflow::sensor
