/// What a virtual campaign states of its series is what the series is drawn with.
#include "spoolflow/rig/bench/manufacturing_spread.hpp"

#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "spoolflow/rig/bench/valve_under_test.hpp"

namespace spoolflow::rig {
namespace {

/// The number behind a key.
double stated(const std::string& text, const std::string& key) {
  const std::size_t at = text.find("\n" + key + " = ");
  if (at == std::string::npos) return NAN;
  return std::stod(text.substr(at + key.size() + 4));
}

double drawn_deviation(const std::function<double(const ValveUnderTest&)>& figure) {
  constexpr int units = 500;
  static const ValveUnderTest nominal = valve_preset("size_6");
  double sum = 0, squares = 0;
  for (int k = 1; k <= units; ++k) {
    ValveUnderTest unit = nominal;
    unit.spread.amount = 1;
    unit.spread_seed = static_cast<std::uint64_t>(k);
    const double value = figure(as_built(unit));
    sum += value;
    squares += value * value;
  }
  return std::sqrt(squares / units - sum * sum / units / units);
}

TEST(ManufacturingSpread, IsStatedByTheStandardDeviationsOfUnitsThatAreDrawn) {
  const ValveUnderTest nominal = valve_preset("size_6");
  const std::string text = tolerances_text(nominal.spread, nominal.plant);
  const auto conductance = [](const MeteringEdge& edge) { return edge.notch_width_m * edge.discharge_coefficient; };
  const double width = drawn_deviation(
      [&](const ValveUnderTest& unit) { return conductance(unit.plant.edge_PB) / conductance(nominal.plant.edge_PB); });
  EXPECT_NEAR(stated(text, "edge_width") / width, 1, 0.1);
  const double edge_um = drawn_deviation([](const ValveUnderTest& unit) { return 1e6 * unit.plant.edge_PB.overlap_m; });
  EXPECT_NEAR(stated(text, "edge_position_um") / edge_um, 1, 0.1);
  const double preload_N = drawn_deviation([](const ValveUnderTest& unit) { return unit.plant.spring_b.preload_N; });
  const Spring& spring = nominal.plant.spring_b;
  const double mean_N = spring.preload_N + spring.rate_N_per_m * nominal.plant.spool.stroke_m / 2;
  EXPECT_NEAR(stated(text, "spring_preload") / (preload_N / mean_N), 1, 0.1);
  const double ageing =
      drawn_deviation([](const ValveUnderTest& unit) { return std::log(unit.plant.spool_friction.ageing_time_s); });
  EXPECT_NEAR(stated(text, "ageing_time") / ageing, 1, 0.1);
}

TEST(ManufacturingSpread, IsStatedByItsAmountAndNamesNothingThatIsNotDrawn) {
  ValveUnderTest valve = valve_preset("size_6");
  const std::string usual = tolerances_text(valve.spread, valve.plant);
  valve.spread.amount = 0.5;
  valve.spread.ageing_time = 1;
  const std::string half = tolerances_text(valve.spread, valve.plant);
  EXPECT_NEAR(stated(half, "spring_rate"), 0.5 * stated(usual, "spring_rate"), 1e-6);
  EXPECT_TRUE(std::isnan(stated(half, "ageing_time")));
}

}  // namespace
}  // namespace spoolflow::rig
