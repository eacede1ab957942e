/// Plants of many valves at once: each as the plant alone.
#include "spoolflow/rig/plants/plant_group.hpp"

#include <array>
#include <bit>
#include <cstdint>

#include <gtest/gtest.h>

#include "spoolflow/rig/electronics/electronics.hpp"
#include "spoolflow/rig/numerics/noise.hpp"

namespace spoolflow::rig {
namespace {

struct Case {
  const char* name;
  Arrangement arrangement = Arrangement::valve;
  LoadKind load = LoadKind::held_difference;
  HysteresisKind hysteresis = HysteresisKind::preisach;
  bool ideal_hold = false, return_to_tank = false;
};

constexpr std::array cases{
    Case{.name = "held difference"},
    Case{.name = "Jiles and Atherton", .hysteresis = HysteresisKind::jiles_atherton},
    Case{.name = "ideal hold", .ideal_hold = true},
    Case{.name = "orifice", .load = LoadKind::orifice},
    Case{.name = "cylinder", .load = LoadKind::cylinder},
    Case{.name = "motor to tank", .load = LoadKind::motor, .return_to_tank = true},
    Case{.name = "solenoid bench", .arrangement = Arrangement::solenoid_bench},
    Case{.name = "held path", .arrangement = Arrangement::axial_force_bench, .load = LoadKind::held_path},
    Case{.name = "held return", .arrangement = Arrangement::axial_force_bench, .load = LoadKind::held_return},
};

/// Valves of a series, one of them without hysteresis, one that is integrated finer.
std::vector<PlantParameters> series(const Case& which, std::size_t valves) {
  std::vector<PlantParameters> out;
  Noise numbers(7, which.name);
  for (std::size_t k = 0; k < valves; ++k) {
    PlantParameters p;
    p.arrangement = which.arrangement;
    p.load.kind = which.load;
    p.load.ideal_hold = which.ideal_hold;
    p.load.return_to_tank = which.return_to_tank;
    for (Solenoid* solenoid : {&p.solenoid_a, &p.solenoid_b}) {
      solenoid->hysteresis.kind = which.hysteresis;
      solenoid->hysteresis.coercive_field_A_per_m = k == 2 ? 0.0 : numbers.uniform(60, 200);
    }
    p.spool_friction.base_N *= numbers.uniform(0.5, 1.5);
    p.spool_friction.viscosity_exponent = k == 1 ? 0.0 : p.spool_friction.viscosity_exponent;
    p.edge_PB.overlap_m *= numbers.uniform(0.5, 1.5);
    p.spring_b.rate_N_per_m *= numbers.uniform(0.9, 1.1);
    if (k % 3 == 1) {  // silted, with a film at speed and a scratch, among valves without
      p.spool_friction.silt_factor = 2;
      p.spool_friction.silt_rest_s = 0.05;
      p.spool_friction.falls_to = 0.6;
      p.edge_PB.scratch_m3_per_s_Pa = 8e-13;
    }
    if (k == 3) p.integration.longest_step_s = 3e-5;
    out.push_back(p);
  }
  return out;
}

/// What drives one valve during a period: jumps, reversals, noise on the idle coil; from standstill to the end stop.
PlantInput drive(const Case& which, std::size_t valve, int tick, Noise& noise) {
  PlantInput input;
  const int part = (tick + 37 * static_cast<int>(valve)) / 250 % 5;
  input.voltage_b_V = std::array{0.0, 6.0, 3.0, 14.0, -5.0}[static_cast<std::size_t>(part)] + 0.3 * noise.normal();
  input.voltage_a_V = part == 4 ? 8.0 : 0.2 * noise.normal();
  input.supply_pressure_Pa = 90e5 + 20e5 * noise.uniform();
  input.held_pressure_difference_Pa = (20 + 5 * static_cast<double>(valve)) * 1e5;
  input.load_force_N = 300.0 * part;
  input.foreign_force_N = valve % 2 == 0 ? 1.5 * sine_of_turns(35e-4 * tick) : 0.0;
  input.oil_temperature_C = 40 + 10 * (tick / 400 % 3);
  if (which.arrangement != Arrangement::valve) {
    const auto place_m = [&](int at) { return 1.1e-3 * sine_of_turns((at + 11.0 * static_cast<double>(valve)) / 800); };
    input.motion = PrescribedMotion{.position_m = place_m(tick + 1),
                                    .velocity_m_per_s = (place_m(tick + 1) - place_m(tick)) / electronics_period_s};
  }
  return input;
}

/// Bits of all figures of a valve.
std::vector<std::uint64_t> bits(const PlantOutput& output, const PlantState& state) {
  std::vector<std::uint64_t> out;
  const auto put = [&](double value) { out.push_back(std::bit_cast<std::uint64_t>(value)); };
  for (const double value : std::bit_cast<std::array<double, sizeof(PlantOutput) / sizeof(double)>>(output)) {
    put(value);
  }
  for (const double value :
       {state.time_s, state.position_m, state.velocity_m_per_s, state.solenoid_a.flux_Wb,
        state.solenoid_a.flux_linkage_Wb, state.solenoid_b.flux_Wb, state.solenoid_b.flux_linkage_Wb}) {
    put(value);
  }
  return out;
}

/// A group of so many valves follows those that are stepped alone.
void expect_as_alone(const Case& which, std::size_t valves) {
  const std::vector<PlantParameters> plants = series(which, valves);
  std::vector<const PlantParameters*> parameters;
  std::vector<PlantState> alone;
  std::vector<Noise> noises;
  for (std::size_t k = 0; k < valves; ++k) {
    parameters.push_back(&plants[k]);
    noises.emplace_back(k, "drive");
    Noise first(k, "start");
    alone.push_back(plant_at_rest(plants[k], drive(which, k, 0, first)));
  }
  PlantGroup group(parameters, alone);
  std::vector<PlantInput> inputs(valves);
  std::vector<PlantOutput> together(valves);
  for (int tick = 0; tick < 3000; ++tick) {
    for (std::size_t k = 0; k < valves; ++k) inputs[k] = drive(which, k, tick, noises[k]);
    group.step(inputs, electronics_period_s);
    if (tick % 7 == 0) group.observe(inputs, together);
    for (std::size_t k = 0; k < valves; ++k) {
      step(plants[k], alone[k], inputs[k], electronics_period_s);
      if (tick % 7 != 0) continue;
      ASSERT_EQ(bits(together[k], group.state(k)), bits(observe(plants[k], alone[k], inputs[k]), alone[k]))
          << which.name << ", valve " << k << " of " << valves << ", tick " << tick;
    }
  }
}

class PlantsAtOnce : public testing::TestWithParam<std::size_t> {};

TEST_P(PlantsAtOnce, AreToTheLastBitWhatEachIsAlone) {
  for (const std::size_t valves : {5U, 7U}) expect_as_alone(cases[GetParam()], valves);  // beyond one set: one, three
}

INSTANTIATE_TEST_SUITE_P(Cases, PlantsAtOnce, testing::Range<std::size_t>(0, cases.size()), [](const auto& which) {
  std::string name = cases[which.param].name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

TEST(PlantGroup, RefusesPlantsThatAreNotAlike) {
  PlantParameters one, other;
  other.load.kind = LoadKind::orifice;
  const std::array<const PlantParameters*, 2> both{&one, &other};
  const std::array<PlantState, 2> states{plant_at_rest(one, {}), plant_at_rest(other, {})};
  EXPECT_THROW(PlantGroup(both, states), std::invalid_argument);
}

TEST(PlantGroup, ReportsAPlantWithoutFiniteStateAsThePlantAloneDoes) {
  PlantParameters p;
  const std::vector<const PlantParameters*> all(5, &p);
  std::vector<PlantInput> inputs(5);
  PlantState alone = plant_at_rest(p, inputs[0]);
  PlantGroup group(all, std::vector<PlantState>(5, alone));
  inputs[3].voltage_b_V = std::nan("");
  const auto message = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  EXPECT_EQ(message([&] { group.step(inputs, 1e-4); }), message([&] { step(p, alone, inputs[3], 1e-4); }));
}

}  // namespace
}  // namespace spoolflow::rig
