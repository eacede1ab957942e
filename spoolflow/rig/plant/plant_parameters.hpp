#pragma once
/// Everything about one valve that its plant needs.
#include "spoolflow/rig/hydraulics/flow_force.hpp"
#include "spoolflow/rig/hydraulics/load.hpp"
#include "spoolflow/rig/hydraulics/metering_edge.hpp"
#include "spoolflow/rig/hydraulics/oil.hpp"
#include "spoolflow/rig/hydraulics/supply.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/plant/solenoid.hpp"
#include "spoolflow/rig/plant/spool.hpp"
#include "spoolflow/rig/plant/spring.hpp"

namespace spoolflow::rig {

/// What stands on the bench.
enum class Arrangement {
  valve,             ///< the whole valve
  solenoid_bench,    ///< solenoid b alone, its armature moved by a carriage against a load cell
  axial_force_bench  ///< valve without solenoids, its spool moved by an external drive through a load cell
};

/// Internal steps (plant_integrator.hpp): halved until the estimated error of each is within the tolerance.
template <class Scalar>
struct IntegrationOf {
  Scalar longest_step_s = 1e-4;
  Scalar shortest_step_s = 1.5e-6;
  Scalar tolerance = 5e-5;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"longest_step_s", "s", 1e-7, 2e-4, "one electronics period"}, self.longest_step_s);
    visit(Parameter{"shortest_step_s", "s", 1e-8, 1e-4, "taken whatever its error: contacts are stepped over by it"},
          self.shortest_step_s);
    visit(Parameter{"tolerance", "1", 1e-9, 1e-2, "error of one step over full scale of stroke, flux, 100 bar"},
          self.tolerance);
  }
};
using Integration = IntegrationOf<double>;

template <class Scalar>
struct PlantParametersOf {
  Arrangement arrangement = Arrangement::valve;
  SolenoidOf<Scalar> solenoid_a;
  SolenoidOf<Scalar> solenoid_b;
  SpoolOf<Scalar> spool;
  SpringOf<Scalar> spring_a;  ///< compressed for x < 0
  SpringOf<Scalar> spring_b;  ///< compressed for x > 0
  FrictionOf<Scalar> spool_friction;
  MeteringEdgeOf<Scalar> edge_PA;
  MeteringEdgeOf<Scalar> edge_PB;
  MeteringEdgeOf<Scalar> edge_AT;
  MeteringEdgeOf<Scalar> edge_BT;
  FlowForceOf<Scalar> flow_force;
  OilOf<Scalar> oil;
  SupplyOf<Scalar> supply;
  LoadOf<Scalar> load;
  IntegrationOf<Scalar> integration;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("solenoid_a", self.solenoid_a);
    visit("solenoid_b", self.solenoid_b);
    visit("spool", self.spool);
    visit("spring_a", self.spring_a);
    visit("spring_b", self.spring_b);
    visit("spool_friction", self.spool_friction);
    visit("edge_PA", self.edge_PA);
    visit("edge_PB", self.edge_PB);
    visit("edge_AT", self.edge_AT);
    visit("edge_BT", self.edge_BT);
    visit("flow_force", self.flow_force);
    visit("oil", self.oil);
    visit("supply", self.supply);
    visit("load", self.load);
    visit("integration", self.integration);
  }
};
using PlantParameters = PlantParametersOf<double>;

}  // namespace spoolflow::rig
