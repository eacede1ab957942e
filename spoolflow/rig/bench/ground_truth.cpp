#include "spoolflow/rig/bench/ground_truth.hpp"

#include <array>
#include <stdexcept>
#include <string>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {
namespace {

constexpr double degree_per_radian = 57.295779513082321;

/// The edge that the spool opens: P to B for x >= 0, P to A below.
const EdgeOutput& inlet(const PlantOutput& plant) {
  return plant.position_m >= 0 ? plant.edge_PB : plant.edge_PA;
}

double transient_force_N_of(const PlantOutput& plant) {
  return plant.edge_PA.transient_force_N + plant.edge_PB.transient_force_N + plant.edge_AT.transient_force_N +
         plant.edge_BT.transient_force_N;
}

std::span<const TruthQuantity> of_one_direction() {
  using units::bar_from_Pa, units::L_per_min_from_m3_per_s, units::mm_from_m;
  using P = const PlantOutput&;
  static const std::array quantities = std::to_array<TruthQuantity>({
      {"time_s", 4, [](P p) { return p.time_s; }},
      {"position_mm", 6, [](P p) { return mm_from_m(p.position_m); }},
      {"velocity_mm_per_s", 4, [](P p) { return mm_from_m(p.velocity_m_per_s); }},
      {"current_A", 6, [](P p) { return p.solenoid_b.current_A - p.solenoid_a.current_A; }},
      {"flux_linkage_Wb", 7, [](P p) { return p.solenoid_b.flux_linkage_Wb; }},
      {"eddy_current_A", 4, [](P p) { return p.solenoid_b.eddy_current_A; }},
      {"winding_temperature_C", 3, [](P p) { return p.solenoid_b.winding_temperature_C; }},
      {"pressure_difference_bar", 4, [](P p) { return bar_from_Pa(p.pressure_difference_Pa); }},
      {"flow_L_min", 5, [](P p) { return L_per_min_from_m3_per_s(p.flow_m3_per_s); }},
      {"jet_angle_deg", 3, [](P p) { return degree_per_radian * inlet(p).jet_angle_rad; }},
      {"magnetic_force_N", 5, [](P p) { return p.magnetic_force_N; }},
      {"armature_friction_force_N", 5, [](P p) { return p.armature_friction_force_N; }},
      {"axial_force_N", 5, [](P p) { return p.axial_force_N; }},
      {"spring_force_N", 5, [](P p) { return p.spring_force_N; }},
      {"flow_force_N", 5, [](P p) { return p.flow_force_N; }},
      {"transient_flow_force_N", 5, transient_force_N_of},
      {"lateral_flow_force_N", 5, [](P p) { return inlet(p).lateral_force_N; }},
      {"spool_friction_force_N", 5, [](P p) { return p.spool_friction_force_N; }},
      {"drag_force_N", 5, [](P p) { return p.drag_force_N; }},
      {"end_stop_force_N", 5, [](P p) { return p.end_stop_force_N; }},
      {"oil_density_kg_per_m3", 3, [](P p) { return p.oil_density_kg_per_m3; }},
      {"oil_viscosity_mm2_per_s", 4, [](P p) { return 1e6 * p.oil_viscosity_m2_per_s; }},
  });
  return quantities;
}

std::span<const TruthQuantity> of_whole_valve() {
  using units::bar_from_Pa, units::L_per_min_from_m3_per_s, units::mm_from_m;
  using P = const PlantOutput&;
  static const std::array quantities = std::to_array<TruthQuantity>({
      {"time_s", 4, [](P p) { return p.time_s; }},
      {"position_mm", 6, [](P p) { return mm_from_m(p.position_m); }},
      {"velocity_mm_per_s", 4, [](P p) { return mm_from_m(p.velocity_m_per_s); }},
      {"flow_L_min", 5, [](P p) { return L_per_min_from_m3_per_s(p.path.flow_m3_per_s); }},
      {"flow_PB_L_min", 5, [](P p) { return L_per_min_from_m3_per_s(p.edge_PB.flow_m3_per_s); }},
      {"flow_AT_L_min", 5, [](P p) { return L_per_min_from_m3_per_s(p.edge_AT.flow_m3_per_s); }},
      {"flow_PA_L_min", 5, [](P p) { return L_per_min_from_m3_per_s(p.edge_PA.flow_m3_per_s); }},
      {"flow_BT_L_min", 5, [](P p) { return L_per_min_from_m3_per_s(p.edge_BT.flow_m3_per_s); }},
      {"pressure_difference_bar", 4, [](P p) { return bar_from_Pa(p.path.pressure_difference_Pa); }},
      {"pressure_p_bar", 4, [](P p) { return bar_from_Pa(p.pressure_P_Pa); }},
      {"pressure_a_bar", 4, [](P p) { return bar_from_Pa(p.pressure_A_Pa); }},
      {"pressure_b_bar", 4, [](P p) { return bar_from_Pa(p.pressure_B_Pa); }},
      {"pressure_t_bar", 4, [](P p) { return bar_from_Pa(p.pressure_T_Pa); }},
      {"current_a_A", 6, [](P p) { return p.solenoid_a.current_A; }},
      {"current_b_A", 6, [](P p) { return p.solenoid_b.current_A; }},
      {"flux_linkage_a_Wb", 7, [](P p) { return p.solenoid_a.flux_linkage_Wb; }},
      {"flux_linkage_b_Wb", 7, [](P p) { return p.solenoid_b.flux_linkage_Wb; }},
      {"eddy_current_a_A", 4, [](P p) { return p.solenoid_a.eddy_current_A; }},
      {"eddy_current_b_A", 4, [](P p) { return p.solenoid_b.eddy_current_A; }},
      {"winding_temperature_a_C", 3, [](P p) { return p.solenoid_a.winding_temperature_C; }},
      {"winding_temperature_b_C", 3, [](P p) { return p.solenoid_b.winding_temperature_C; }},
      {"magnetic_force_N", 5, [](P p) { return p.magnetic_force_N; }},
      {"magnetic_force_a_N", 5, [](P p) { return p.solenoid_a.magnetic_force_N; }},
      {"magnetic_force_b_N", 5, [](P p) { return p.solenoid_b.magnetic_force_N; }},
      {"armature_friction_force_N", 5, [](P p) { return p.armature_friction_force_N; }},
      {"axial_force_N", 5, [](P p) { return p.axial_force_N; }},
      {"spring_force_N", 5, [](P p) { return p.spring_force_N; }},
      {"flow_force_N", 5, [](P p) { return p.flow_force_N; }},
      {"flow_force_PB_N", 5, [](P p) { return p.edge_PB.steady_force_N; }},
      {"flow_force_AT_N", 5, [](P p) { return p.edge_AT.steady_force_N; }},
      {"flow_force_PA_N", 5, [](P p) { return p.edge_PA.steady_force_N; }},
      {"flow_force_BT_N", 5, [](P p) { return p.edge_BT.steady_force_N; }},
      {"transient_flow_force_N", 5, transient_force_N_of},
      {"spool_friction_force_N", 5, [](P p) { return p.spool_friction_force_N; }},
      {"drag_force_N", 5, [](P p) { return p.drag_force_N; }},
      {"end_stop_force_N", 5, [](P p) { return p.end_stop_force_N; }},
      {"oil_density_kg_per_m3", 3, [](P p) { return p.oil_density_kg_per_m3; }},
      {"oil_viscosity_mm2_per_s", 4, [](P p) { return 1e6 * p.oil_viscosity_m2_per_s; }},
      {"load_position_mm", 4, [](P p) { return mm_from_m(p.cylinder_position_m); }},
      {"load_velocity_mm_per_s", 4, [](P p) { return mm_from_m(p.cylinder_velocity_m_per_s); }},
  });
  return quantities;
}

}  // namespace

std::span<const TruthQuantity> truth_quantities(bool whole_valve) {
  return whole_valve ? of_whole_valve() : of_one_direction();
}

const std::vector<double>& GroundTruth::operator[](std::string_view header) const {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (quantities[k].header == header) {
      return columns[k];
    }
  }
  throw std::out_of_range("the ground truth has no column " + std::string(header));
}

}  // namespace spoolflow::rig
