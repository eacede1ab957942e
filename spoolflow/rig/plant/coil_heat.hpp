#pragma once
/// Self-heating of a solenoid: two thermal masses, winding and housing.
///
///     C_w dT_w/dt = R i^2 - G_wh (T_w - T_h)
///     C_h dT_h/dt = P_iron + G_wh (T_w - T_h) - G_ha (T_h - T_ambient) - G_ho (T_h - T_oil)
///
/// Time constants are minutes, so the plant integrates it once a step, exactly enough by the explicit midpoint rule.
/// Leaves out the temperature field inside the winding.
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct CoilHeatOf {
  Scalar winding_heat_capacity_J_per_K = 130.0;
  Scalar housing_heat_capacity_J_per_K = 350.0;
  Scalar winding_to_housing_W_per_K = 1.2;
  Scalar housing_to_ambient_W_per_K = 0.35;
  Scalar housing_to_oil_W_per_K = 0.4;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"winding_heat_capacity_J_per_K", "J/K", 10, 2000, "0.33 kg of copper at 385 J/(kg K)"},
          self.winding_heat_capacity_J_per_K);
    visit(Parameter{"housing_heat_capacity_J_per_K", "J/K", 30, 10000, "0.75 kg of steel at 465 J/(kg K)"},
          self.housing_heat_capacity_J_per_K);
    visit(Parameter{"winding_to_housing_W_per_K", "W/K", 0.05, 20, "winding some 20 K above the housing at 25 W"},
          self.winding_to_housing_W_per_K);
    visit(
        Parameter{"housing_to_ambient_W_per_K", "W/K", 0.02, 10, "0.03 m2 of surface in still air, 10 to 12 W/(m2 K)"},
        self.housing_to_ambient_W_per_K);
    visit(Parameter{"housing_to_oil_W_per_K", "W/K", 0, 20, "wet armature tube screwed into the valve body"},
          self.housing_to_oil_W_per_K);
  }
};

template <class Scalar>
struct CoilHeatStateOf {
  Scalar winding_temperature_C = 25.0;
  Scalar housing_temperature_C = 25.0;
};

/// Advances both temperatures with the losses held; explicit midpoint.
template <class Scalar>
inline void heat_up(const CoilHeatOf<Scalar>& heat, CoilHeatStateOf<Scalar>& state, Scalar winding_loss_W,
                    Scalar iron_loss_W, Scalar ambient_C, Scalar oil_C, Scalar dt_s) {
  const auto rates = [&](const CoilHeatStateOf<Scalar>& at) {
    const Scalar exchange_W = heat.winding_to_housing_W_per_K * (at.winding_temperature_C - at.housing_temperature_C);
    return CoilHeatStateOf<Scalar>{
        (winding_loss_W - exchange_W) / heat.winding_heat_capacity_J_per_K,
        (iron_loss_W + exchange_W - heat.housing_to_ambient_W_per_K * (at.housing_temperature_C - ambient_C) -
         heat.housing_to_oil_W_per_K * (at.housing_temperature_C - oil_C)) /
            heat.housing_heat_capacity_J_per_K};
  };
  const CoilHeatStateOf<Scalar> first = rates(state);
  const CoilHeatStateOf<Scalar> second =
      rates({state.winding_temperature_C + 0.5 * dt_s * first.winding_temperature_C,
             state.housing_temperature_C + 0.5 * dt_s * first.housing_temperature_C});
  state.winding_temperature_C += dt_s * second.winding_temperature_C;
  state.housing_temperature_C += dt_s * second.housing_temperature_C;
}

}  // namespace spoolflow::rig
