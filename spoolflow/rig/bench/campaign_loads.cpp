#include "spoolflow/rig/bench/campaign_loads.hpp"

#include <cmath>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {

ValveUnderTest dithered(ValveUnderTest valve, const CampaignSettings& settings) {
  if (valve.electronics.dither.amplitude_A == 0) {
    valve.electronics.dither.amplitude_A = settings.dither_amplitude_A;
    valve.electronics.dither.frequency_Hz = settings.dither_frequency_Hz;
  }
  return valve;
}

ValveUnderTest loaded(ValveUnderTest valve, LoadKind kind, double supply_bar) {
  constexpr double turned_rad_per_s = 105;  // 1000 turns a minute at rated flow
  constexpr double torque_share = 0.4;      // of what the supply pressure could hold
  constexpr double run_up_s = 0.1;          // with what is left of it
  constexpr double discharge = 0.7;         // that of load.hpp
  const double supply_Pa = units::Pa_from_bar(supply_bar);
  const double rated_m3_per_s = units::m3_per_s_from_L_per_min(valve.rating.flow_L_per_min);
  const double edge = rated_m3_per_s / std::sqrt(units::Pa_from_bar(valve.rating.pressure_difference_bar));
  Load& load = valve.plant.load;
  load.kind = kind;
  load.return_to_tank = !valve.whole;
  load.orifice_area_m2 = edge / std::sqrt(3.0) / discharge * std::sqrt(0.5 * valve.plant.oil.density_15C_kg_per_m3);
  load.motor_displacement_m3_per_rad = rated_m3_per_s / turned_rad_per_s;
  load.motor_torque_N_m = torque_share * supply_Pa * load.motor_displacement_m3_per_rad;
  load.motor_inertia_kg_m2 =
      (1 - torque_share) * supply_Pa * load.motor_displacement_m3_per_rad * run_up_s / turned_rad_per_s;
  load.motor_drag_N_m_s = 0.05 * load.motor_torque_N_m / turned_rad_per_s;
  return valve;
}

ValveUnderTest with_cylinder(ValveUnderTest valve) {
  constexpr double travel_s = 75;         // from end to end at rated flow
  constexpr double mass_kg_per_m2 = 3e5;  // swings at some 10 Hz on its oil, mid-stroke
  Load& load = valve.plant.load;
  if (load.kind == LoadKind::cylinder) return valve;
  load.kind = LoadKind::cylinder;
  load.cylinder_stroke_m = 2.5;
  load.piston_area_B_m2 = load.piston_area_A_m2 =
      units::m3_per_s_from_L_per_min(valve.rating.flow_L_per_min) * travel_s / load.cylinder_stroke_m;
  load.cylinder_mass_kg = mass_kg_per_m2 * load.piston_area_B_m2;
  load.cylinder_drag_N_s_per_m = 2.0e4;  // seals of that size: 1 bar at rated speed
  return valve;
}

}  // namespace spoolflow::rig
