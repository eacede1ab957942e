#include "spoolflow/calibration/known_quantities.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace spoolflow::calibration {
namespace {

using recording::Channel;

model::Model calibrated() {
  model::Model out{};
  out.valve.direction = "b";
  out.observer.emplace();
  out.observer->residuals = {{"magnetic force", "N", 0.1, 1},
                             {"spring force", "N", 0.2, 1},
                             {"axial force", "N", 0.3, 1},
                             {"flow rate", "m3/s", 1e-6, 1e-5}};
  return out;
}

recording::Recording map_at(double oil_temperature_K) {
  recording::Recording out;
  out.column(Channel::oil_temperature) = {oil_temperature_K, oil_temperature_K};
  return out;
}

model::KnownQuantity of(const std::vector<model::KnownQuantity>& rows, const std::string& quantity) {
  const auto found = std::ranges::find(rows, quantity, &model::KnownQuantity::of);
  EXPECT_NE(found, rows.end()) << quantity;
  return found == rows.end() ? model::KnownQuantity{} : *found;
}

TEST(KnownQuantities, OnForceBenchesEveryForceIsMeasured) {
  const recording::Recording spring, map, cold = map_at(303), warm = map_at(343);
  model::Model model = calibrated();
  model.instruments.force_N = 0.25;
  model.observer->fits = {{"coil", {{"classical_eddy_current_A_per_V", 4e-3, 1e-4}}, {1}},
                          {"operation", {{"friction_ageing_ratio", 4, 0.5}}, {1}}};
  model.observer->defaults = {"moving_mass_kg"};
  const auto rows = known_quantities({spring, map, {&map}, {{&cold, &warm}, {}, {}, 1, {}}, {}, nullptr}, model);
  for (const char* force : {"scale of all forces", "magnetic force", "magnetic hysteresis", "eddy currents",
                            "armature friction", "spring force", "flow force", "spool friction", "conductance"})
    EXPECT_EQ(of(rows, force).how, "measured") << force;
  EXPECT_EQ(of(rows, "scale of all forces").uncertainty_95, 0.25);
  EXPECT_DOUBLE_EQ(of(rows, "spring force").uncertainty_95.value(), 0.4);
  EXPECT_DOUBLE_EQ(of(rows, "eddy currents").uncertainty_95.value(), 0.05);
  EXPECT_EQ(of(rows, "influence of the oil temperature").from, "recordings at 30 to 70 °C");
  EXPECT_EQ(of(rows, "friction at rest").how, "inferred");
  EXPECT_DOUBLE_EQ(of(rows, "friction at rest").uncertainty_95.value(), 0.25);
  EXPECT_EQ(of(rows, "moving mass").how, "assumed");
  EXPECT_FALSE(of(rows, "moving mass").uncertainty_95);
  model.valve.moving_mass_kg = 0.3;
  const auto declared = known_quantities({spring, map, {&map}, {{&cold, &warm}, {}, {}, 1, {}}, {}, nullptr}, model);
  EXPECT_EQ(of(declared, "moving mass").from, "moving_mass_g of campaign.toml");
}

TEST(KnownQuantities, OnAFlowBenchOnlyWhatItsMetersShowIsMeasured) {
  EquivalentBenches bench{};
  bench.force_scale_95 = 0.2;
  bench.axial_force_maps.push_back(map_at(323));
  const recording::Recording& map = bench.axial_force_maps.front();
  const auto rows =
      known_quantities({bench.spring, bench.solenoid_force_map, {}, {{&map}, {}, {}, 1, {}}, {}, &bench}, calibrated());
  for (const char* force : {"scale of all forces", "magnetic force", "magnetic hysteresis", "eddy currents",
                            "spring force", "flow force", "spool friction"})
    EXPECT_EQ(of(rows, force).how, "inferred") << force;
  EXPECT_EQ(of(rows, "scale of all forces").uncertainty_95, 0.2);
  EXPECT_EQ(of(rows, "force of the jet").how, "assumed");
  EXPECT_EQ(of(rows, "armature friction").how, "assumed");
  EXPECT_EQ(of(rows, "conductance").how, "measured");
  EXPECT_EQ(of(rows, "influence of the oil temperature").how, "assumed");  // at one oil temperature
}

TEST(KnownQuantities, OneForceRecordingBesideAFlowBenchIsMeasuredAndGivesTheScale) {
  EquivalentBenches bench{};
  bench.force_scale_95 = 0.02;
  bench.spring_was_measured = true;
  bench.axial_force_maps.push_back(map_at(323));
  const recording::Recording& metered = bench.axial_force_maps.front();
  const CampaignRecordings mixed{bench.spring, bench.solenoid_force_map, {}, {{&metered}, {}, {}, 1, {}}, {}, &bench};
  const auto with_spring = known_quantities(mixed, calibrated());
  EXPECT_EQ(of(with_spring, "spring force").how, "measured");
  EXPECT_EQ(of(with_spring, "scale of all forces").from, "spring");
  EXPECT_EQ(of(with_spring, "scale of all forces").uncertainty_95, 0.02);
  EXPECT_EQ(of(with_spring, "flow force").how, "inferred");
  bench.spring_was_measured = false;
  bench.axial_force_was_measured = true;
  const auto with_axial = known_quantities(mixed, calibrated());
  EXPECT_EQ(of(with_axial, "flow force").how, "measured");
  EXPECT_EQ(of(with_axial, "scale of all forces").from, "axial_force_map");
  EXPECT_EQ(of(with_axial, "spring force").how, "inferred");
  EXPECT_EQ(of(with_axial, "conductance").from, "metering");
}

}  // namespace
}  // namespace spoolflow::calibration
