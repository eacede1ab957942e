/// A type of a whole valve, and its units.
#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/type/calibrate_unit.hpp"
#include "spoolflow/calibration/type/one_side.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/calibration/type/virtual_unit.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using testing::HasSubstr;

const model::Model& whole_type() {
  static const model::Model model = [] {
    model::Model valve = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
    valve.observer->parameters.position_sensor.drift_m_per_K = 0;  // positions of virtual units have none
    return type_model(whole_of(std::move(valve)), tolerances_from({}));
  }();
  return model;
}

sensor::ObserverParameters<double> with_preload(double deviation) {
  Deviations deviations{};
  deviations[at(Variation::spring_preload)] = deviation;
  return unit_parameters(whole_type().observer->parameters, deviations);
}

/// A stroke P to B of a spring that much stronger, and one P to A of one that much weaker.
class WholeUnit {
 public:
  explicit WholeUnit(double deviation, const std::string& toml = "file = \"both.csv\"\n")
      : file_("unit.toml", "name = \"U 17\"\n[[recording]]\nprotocol = \"operation\"\n" + toml) {
    constexpr double pressure_bar = 40;
    write_whole_strokes(file_.folder() / "both.csv", with_preload(deviation), with_preload(-deviation), pressure_bar,
                        whole_type().valve.stroke_m);
    write_strokes(file_.folder() / "one.csv", with_preload(deviation), {pressure_bar}, whole_type().valve.stroke_m);
    std::ofstream out(file_.folder() / "type.json");
    model::write_model(out, whole_type());
  }
  [[nodiscard]] CalibratedUnit calibrate() const {
    return calibrate_unit(whole_type(), (file_.folder() / "type.json").string(),
                          recording::read_unit_campaign(file_.path(), valve_of_type(whole_type())), "test",
                          [](const std::string&, double) {});
  }
  [[nodiscard]] recording::Recording both() const {
    return recording::read_recording(file_.folder() / "both.csv",
                                     {{},
                                      {Channel::time, Channel::position, Channel::current_a, Channel::current_b},
                                      {Channel::flow_reference, Channel::pressure_difference, Channel::oil_temperature},
                                      {}});
  }

 private:
  recording::TemporaryFile file_;
};

const UnitParameter& preload_of(const UnitCalibration& direction) {
  return direction.parameters[at(Variation::spring_preload)];
}

TEST(WholeType, ARunThroughTheCentreShowsEachDirectionsOwnSpring) {
  constexpr double deviation = 0.03;
  const CalibratedUnit unit = WholeUnit(deviation).calibrate();
  ASSERT_EQ(unit.directions.size(), 2U);
  const UnitParameter &p_to_b = preload_of(unit.directions[0]), &p_to_a = preload_of(unit.directions[1]);
  EXPECT_NEAR(p_to_b.value, deviation, 2 * p_to_b.uncertainty);
  EXPECT_NEAR(p_to_a.value, -deviation, 2 * p_to_a.uncertainty);
  EXPECT_GT(p_to_b.value - p_to_a.value, deviation);
  EXPECT_TRUE(unit.model.type->unit);
  EXPECT_TRUE(unit.model.p_to_a->type->unit);
}

TEST(WholeType, ADirectionThatWasNotRecordedStaysTheTypes) {
  const CalibratedUnit unit = WholeUnit(0.03, "direction = \"b\"\nfile = \"one.csv\"\n").calibrate();
  EXPECT_TRUE(preload_of(unit.directions[0]).seen);
  EXPECT_FALSE(preload_of(unit.directions[1]).seen);
  EXPECT_EQ(unit.model.p_to_a->observer->parameters.environment.force_N,
            whole_type().p_to_a->observer->parameters.environment.force_N);
  EXPECT_LT(unit.model.observer->parameters.environment.force_N, whole_type().observer->parameters.environment.force_N);
}

TEST(WholeType, OneCoilsCurrentWithoutADirectionIsRefusedWithWhatToState) {
  try {
    (void)WholeUnit(0, "file = \"one.csv\"\n").calibrate();
    FAIL() << "a direction was guessed";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("give direction = \"b\""));
  }
}

TEST(WholeType, AnotherSpringInOneDirectionIsRefusedByThatDirection) {
  try {
    (void)WholeUnit(0.25).calibrate();
    FAIL() << "another spring passed for one of the type";
  } catch (const ForeignUnit& foreign) {
    EXPECT_THAT(foreign.what(), HasSubstr(", P to A: the unit is not of the type"));
    EXPECT_EQ(foreign.directions.size(), 2U);
  }
}

TEST(WholeType, ItsModelIsReadAgainWithBothSections) {
  std::ostringstream out;
  model::write_model(out, whole_type());
  const model::Model read = model::parse_model(out.str(), "type.json");
  ASSERT_TRUE(read.type && read.p_to_a->type);
  EXPECT_EQ(read.p_to_a->type->deviations.size(), variations);
  for (const std::string& direction : model::directions(read))
    EXPECT_NO_THROW((void)known_of_type(model::of_direction(read, direction), "type.json"));
}

TEST(OneSide, ReadsAsClosedWithoutFlowWhileTheSpoolStandsOnTheOther) {
  const recording::Recording both = WholeUnit(0).both();
  const recording::Recording p_to_a = one_side(both, "a", whole_type().valve.stroke_m).run;
  double furthest_m = 0;
  for (std::size_t k = 0; k < both.size(); ++k) {
    EXPECT_GE(p_to_a[Channel::position][k], -25e-6);
    furthest_m = std::max(furthest_m, p_to_a[Channel::position][k]);
    if (both[Channel::position][k] > 1e-4) {
      EXPECT_EQ(p_to_a[Channel::flow_reference][k], 0);
      EXPECT_EQ(p_to_a[Channel::current][k], 0);
    }
  }
  EXPECT_NEAR(furthest_m, 0.99 * whole_type().valve.stroke_m, 1e-5);
}

TEST(OneSide, WithoutRestInTheCentreTheRunIsRefused) {
  recording::Recording both = WholeUnit(0).both();
  for (double& current_A : both.column(Channel::current_b)) current_A += 1;
  EXPECT_THROW((void)one_side(both, "b", whole_type().valve.stroke_m), CalibrationError);
}

}  // namespace
}  // namespace spoolflow::calibration
