#pragma once
/// Parameters and state of the whole 4/3 valve (whole_valve.hpp): one spool, and for each direction of flow a
/// solenoid, springs and metering edges.
#include <type_traits>

#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::sensor {

/// The two directions of a whole valve, each as calibrated by itself: position from the centre, opening > 0. Both must
/// outlive what refers to them.
template <class T>
struct WholeValveParameters {
  const ObserverParameters<T>* b;  ///< flow P to B, opened by solenoid b
  const ObserverParameters<T>* a;  ///< flow P to A; opened by solenoid a
};

/// The solenoid and the path of the side on which the spool does not stand.
template <class T>
struct IdleSide {
  ActuatorState<T> actuator;
  PressureState<T> pressure;
  DitherState<T> dither;
  T magnetic_force_N{};  ///< that its iron still holds, >= 0
  T quiet_s{};           ///< since its current fell silent
  T closed_s{};          ///< since the spool left its side
  T waiting_s{};         ///< since its solenoid was last stepped
  T charge_As{};         ///< through its coil since
  T inlet_share{};       ///< as of the open path
  T current_A{};         ///< the last credible one of its coil
  int held_currents{};   ///< samples in a row whose current was implausible and replaced
};

template <class T>
struct WholeValveState {
  ObserverState<T> open;  ///< of the side on which the spool stands, in that direction's signs, but for the position
                          ///< track and the last answer, which keep the valve's: flow P to B > 0
  IdleSide<T> idle;
  T zero_m{};            ///< of the position sensor, found at rest in the centre
  T centred_s{};         ///< for how long the spool has rested there
  T inlet_share{};       ///< of the open path's pressure drop, as measured port pressures have shown it
  T settled_m3_per_s{};  ///< flow through the open path to which the load has settled, in that direction's sign
  bool opens_a{};        ///< it stands on the side that opens P to A
};

static_assert(std::is_trivially_copyable_v<WholeValveParameters<float>>);
static_assert(std::is_trivially_copyable_v<WholeValveState<float>>);
static_assert(sizeof(WholeValveState<float>) < 1536);

}  // namespace spoolflow::sensor
