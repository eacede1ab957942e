#include "spoolflow/calibration/type/series.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/type/type_model.hpp"

namespace spoolflow::calibration {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const model::Model& series_type() {
  static const model::Model model = type_model(model::read_model(SPOOLFLOW_EXAMPLE_MODEL), tolerances_from({}));
  return model;
}

/// A unit that deviates so, as recordings would show it that know each direction to `share` of its tolerance.
SeriesUnit measured(const std::string& name, const Deviations& deviations, double share, std::mt19937& random) {
  const KnownDeviations type = known_of_type(series_type(), "type.json");
  SeriesUnit out{name, NAN, {}, type, 0, 1, ""};
  for (std::size_t k = 0; k < variations; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const double spread = std::sqrt(type.covariance(row, row)), open = share * spread;
    const double read = deviations[k] + open * std::normal_distribution<>()(random);
    const double left2 = 1 / (1 / (spread * spread) + 1 / (open * open));
    out.known.mean(row) = left2 * read / (open * open);
    out.known.covariance(row, row) = left2;
    const double away = out.known.mean(row) / spread;
    out.parameters.push_back({std::string(all_variations()[k].name), std::string(all_variations()[k].unit), spread,
                              out.known.mean(row), std::sqrt(left2), away, true, std::abs(away) > marginal_deviations});
  }
  return out;
}

/// Fifty units: the spring force falls by two of its tolerances from the first to the last, flow force spreads by
/// twice its tolerance, all else by half of it.
std::vector<SeriesUnit> fifty() {
  std::mt19937 random(4);
  std::vector<SeriesUnit> out;
  constexpr int count = 50;
  for (int serial = 1; serial <= count; ++serial) {
    Deviations deviations{};
    for (std::size_t k = 0; k < variations; ++k) {
      const double wide = k == at(Variation::flow_force) ? 2 : 0.5;
      deviations[k] = wide * all_variations()[k].tolerance * std::normal_distribution<>()(random);
    }
    deviations[at(Variation::spring_preload)] += (1 - 2.0 * serial / count) * 0.03;
    out.push_back(measured("NG6 serial " + std::to_string(serial), deviations, 0.3, random));
  }
  return out;
}

const Series& series() {
  static const Series made = compare_series(series_type(), "type.json", fifty());
  return made;
}
const SeriesParameter& of(Variation variation) {
  return series().parameters[at(variation)];
}

TEST(Series, FindsTheSpreadBetweenUnitsWithoutWhatTheirRecordingsLeaveOpen) {
  const auto with_tolerances = [](double share) {  // that count as four units beside the fifty
    return std::sqrt((tolerances_as_units + 50 * share * share) / (tolerances_as_units + 50));
  };
  constexpr double of_fifty = 0.3;  // three standard deviations of a spread of fifty draws
  EXPECT_NEAR(of(Variation::permeance).spread / 0.015, with_tolerances(0.5), of_fifty * with_tolerances(0.5));
  EXPECT_NEAR(of(Variation::flow_force).spread / 0.02, with_tolerances(2), of_fifty * with_tolerances(2));
  EXPECT_NEAR(of(Variation::permeance).mean, 0, 3 * of(Variation::permeance).mean_uncertainty);
}

TEST(Series, CapabilityIsBelowOneWhereUnitsSpreadBeyondTheirTolerance) {
  EXPECT_LT(of(Variation::flow_force).capability, 0.7);
  EXPECT_GT(of(Variation::permeance).capability, 1.4);
}

TEST(Series, CapabilityOfFewUnitsIsNotKnown) {
  std::vector<SeriesUnit> units = fifty();
  units.resize(least_for_capability);
  EXPECT_FALSE(std::isnan(compare_series(series_type(), "type.json", units).parameters.front().capability));
  units.pop_back();
  const Series few = compare_series(series_type(), "type.json", units);
  for (const SeriesParameter& each : few.parameters) {
    EXPECT_TRUE(std::isnan(each.capability)) << each.name;
    EXPECT_FALSE(std::isnan(each.spread)) << each.name;
  }
}

TEST(Series, ASpringThatWeakensFromUnitToUnitDriftsAndNothingElseDoes) {
  for (const SeriesParameter& each : series().parameters)
    EXPECT_EQ(each.drifts, each.name == "spring_preload") << each.name;
  EXPECT_NEAR(of(Variation::spring_preload).drift_per_serial, -2 * 0.03 / 50, 0.3 * 2 * 0.03 / 50);
}

TEST(Series, SerialNumbersAreThoseOfTheNamesOrWhereTheyHaveNoneTheOrder) {
  std::mt19937 random(1);
  std::vector<SeriesUnit> units{measured("U 12", {}, 1, random), measured("U 9", {}, 1, random)};
  EXPECT_THAT(serial_numbers(units), ElementsAre(12, 9));
  EXPECT_EQ(compare_series(series_type(), "type.json", units).units.front().name, "U 9");
  units[1].name = "spare";
  EXPECT_THAT(serial_numbers(units), ElementsAre(1, 2));
}

TEST(Series, AForeignUnitIsCountedAndMovesNoSpread) {
  std::vector<SeriesUnit> units = fifty();
  std::mt19937 random(2);
  Deviations far{};
  far[at(Variation::edge_position)] = 50e-6;
  units.push_back(measured("NG6 serial 51", far, 0.1, random));
  units.back().refusal = "not of the type";
  const Series with = compare_series(series_type(), "type.json", units);
  EXPECT_EQ(with.refused(), 1U);
  EXPECT_DOUBLE_EQ(with.parameters[at(Variation::edge_position)].spread, of(Variation::edge_position).spread);
}

TEST(Series, TheUpdatedTypeHasTheMiddleOfItsUnitsAndTheirSpread) {
  std::mt19937 random(3);
  std::vector<SeriesUnit> units;
  for (int serial = 1; serial <= 30; ++serial) {
    Deviations deviations{};
    deviations[at(Variation::spring_preload)] = 0.03 + 0.01 * std::normal_distribution<>()(random);
    units.push_back(measured("U" + std::to_string(serial), deviations, 0.2, random));
  }
  const model::Model updated =
      updated_type(series_type(), compare_series(series_type(), "type.json", std::move(units)));
  EXPECT_NEAR(updated.observer->parameters.spring.at(1.2e-3).value,
              1.03 * series_type().observer->parameters.spring.at(1.2e-3).value, 0.15);
  EXPECT_LT(updated.type->deviations[at(Variation::spring_preload)].tolerance, 0.02);
  EXPECT_LT(updated.observer->parameters.environment.force_N, series_type().observer->parameters.environment.force_N);
  EXPECT_NO_THROW((void)known_of_type(updated, "updated.json"));
}

/// Units of which the recordings say next to nothing of coercivity, and that twice as far off as it is sure.
TEST(Series, KeepsTheToleranceOfWhatTheRecordingsOfNoUnitShow) {
  std::mt19937 random(6);
  constexpr auto row = static_cast<Eigen::Index>(at(Variation::coercivity));
  std::vector<SeriesUnit> units;
  for (int serial = 1; serial <= 12; ++serial) {
    SeriesUnit unit = measured("U" + std::to_string(serial), {}, 0.2, random);
    const double spread = all_variations()[at(Variation::coercivity)].tolerance, open = 5 * spread;
    const double left2 = 1 / (1 / (spread * spread) + 1 / (open * open));
    const double read = 2 * open * (serial % 2 == 0 ? 1 : -1);
    unit.known.mean(row) = left2 * read / (open * open);
    unit.known.covariance(row, row) = left2;
    unit.parameters[at(Variation::coercivity)].seen = false;
    units.push_back(unit);
  }
  const model::Model updated =
      updated_type(series_type(), compare_series(series_type(), "type.json", std::move(units)));
  const double before = series_type().type->deviations[at(Variation::coercivity)].tolerance;
  EXPECT_NEAR(updated.type->deviations[at(Variation::coercivity)].tolerance, before, 0.15 * before);
}

TEST(Series, OfTwoUnitsNoTypeIsUpdated) {
  std::mt19937 random(5);
  const Series two =
      compare_series(series_type(), "type.json", {measured("U1", {}, 0.2, random), measured("U2", {}, 0.2, random)});
  try {
    (void)updated_type(series_type(), two);
    FAIL() << "two units made a type";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("3 units"));
  }
}

}  // namespace
}  // namespace spoolflow::calibration
