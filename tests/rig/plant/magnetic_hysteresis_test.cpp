#include "spoolflow/rig/plant/magnetic_hysteresis.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

/// Iron driven through flux densities in small steps, with its energies.
struct Iron {
  MagneticMaterial material;
  StopElements stops;
  HysteresisState elements{};
  double flux_density_T = 0.0;
  double work = 0.0;         ///< integral of H dB
  double dissipation = 0.0;  ///< by the elements

  explicit Iron(const MagneticHysteresis& hysteresis = {}) : stops(stop_elements(hysteresis)) {}

  [[nodiscard]] double field() const {
    return anhysteretic_field(anhysteretic_curve(material), flux_density_T).field_A_per_m +
           hysteretic_field(stops, elements, 0.0).field_A_per_m;
  }
  [[nodiscard]] double stored() const {
    return anhysteretic_energy(material, flux_density_T) + hysteretic_energy(stops, elements);
  }
  void drive_to(double target_T) {
    const int count = 16000;
    const double change = (target_T - flux_density_T) / count;
    for (int i = 0; i < count; ++i) {
      const double before = field();
      dissipation += hysteresis_loss(stops, elements, change);
      elements = advanced(stops, elements, change);
      flux_density_T += change;
      work += 0.5 * (before + field()) * change;
    }
  }
};

TEST(RigMagneticHysteresis, LoopAreaIsTheDissipatedEnergy) {
  Iron iron;
  iron.drive_to(1.6);
  iron.drive_to(-1.6);
  iron.drive_to(1.6);
  iron.work = iron.dissipation = 0.0;
  iron.drive_to(-1.6);
  iron.drive_to(1.6);
  EXPECT_GT(iron.work, 0.0);
  EXPECT_NEAR(iron.work / iron.dissipation, 1.0, 1e-5);
  // Fully yielded, each element loses kappa over the swing less its elastic part: 2 Hc (2 B - 0.6 width) here.
  EXPECT_NEAR(iron.dissipation, 4.0 * 110.0 * (1.6 - 0.6 * 0.30), 1e-6 * iron.dissipation + 0.1);
}

TEST(RigMagneticHysteresis, FirstLawHoldsAlongAnyPath) {
  Iron iron;
  for (const double target_T : {0.4, -0.1, 1.9, 0.7, 0.75, 0.6, -1.2, 2.3, 0.0}) {
    iron.drive_to(target_T);
    EXPECT_NEAR(iron.work, iron.stored() + iron.dissipation, 1e-5 * std::abs(iron.work) + 1e-3) << target_T;
  }
}

TEST(RigMagneticHysteresis, MinorLoopsClose) {
  Iron iron;
  iron.drive_to(1.5);
  iron.drive_to(0.3);
  const double reversal = iron.field();
  iron.drive_to(0.8);
  iron.drive_to(0.3);
  EXPECT_NEAR(iron.field(), reversal, 1e-6);
}

TEST(RigMagneticHysteresis, LargerExcursionsWipeOutSmallerOnes) {
  Iron straight, detour;
  straight.drive_to(1.5);
  detour.drive_to(0.5);
  detour.drive_to(0.2);
  detour.drive_to(1.5);
  EXPECT_NEAR(detour.field(), straight.field(), 1e-6);
}

TEST(RigMagneticHysteresis, CoerciveFieldIsHalfTheLoopWidth) {
  Iron iron;
  iron.drive_to(1.8);
  iron.drive_to(0.0);
  EXPECT_NEAR(iron.field(), -110.0, 1e-6);
}

TEST(RigMagneticMaterial, RunsFromItsPermeabilityIntoThatOfAir) {
  const AnhystereticCurve curve = anhysteretic_curve({});
  EXPECT_NEAR(anhysteretic_field(curve, 4.0).slope_m_per_H * vacuum_permeability_H_per_m, 1.0, 1e-2);
  EXPECT_LT(anhysteretic_field(curve, 0.0).slope_m_per_H * vacuum_permeability_H_per_m, 2e-3);
  for (double flux = -2.5; flux < 2.5; flux += 0.05) {  // slope and energy belong to the field
    const double d = 1e-5;
    const double difference =
        anhysteretic_field(curve, flux + d).field_A_per_m - anhysteretic_field(curve, flux - d).field_A_per_m;
    EXPECT_NEAR(difference / (2 * d) / anhysteretic_field(curve, flux).slope_m_per_H, 1.0, 1e-4) << flux;
    const double energy = (anhysteretic_energy({}, flux + d) - anhysteretic_energy({}, flux - d)) / (2 * d);
    EXPECT_NEAR(energy, anhysteretic_field(curve, flux).field_A_per_m, 1e-3 * std::abs(energy) + 0.5) << flux;
  }
}

}  // namespace
}  // namespace spoolflow::rig
