/// A whole valve that wore, in the closed form of the sensor's own functions: each direction by its own references.
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/references/recalibrate.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/calibration/references/known_references.hpp"
#include "tests/calibration/type/virtual_unit.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using recording::Reference;
using recording::ReferenceKind;
using testing::HasSubstr;

const model::Model& whole_valve() {
  static const model::Model model = whole_of(model_without_drift());
  return model;
}

/// Strokes both ways, with that wear P to B and P to A.
std::vector<recording::Recording> both_ways_of(const model::WearState& p_to_b, const model::WearState& p_to_a) {
  const sensor::ObserverParameters<double>& valve = whole_valve().observer->parameters;
  std::vector<recording::Recording> out;
  for (const double pressure_bar : {30.0, 45.0}) {
    const recording::TemporaryFile file("strokes.csv");
    write_whole_strokes(file.path(), worn(valve, p_to_b), worn(valve, p_to_a), pressure_bar,
                        whole_valve().valve.stroke_m);
    recording::ReadOptions options;
    options.required = {Channel::time, Channel::current_a, Channel::current_b, Channel::position};
    options.optional = {Channel::oil_temperature, Channel::flow_reference};
    out.push_back(recording::read_recording(file.path(), options));
  }
  return out;
}

const std::vector<recording::Recording>& fresh_both_ways() {
  static const std::vector<recording::Recording> recordings = both_ways_of({}, {});
  return recordings;
}

/// A pump that runs for the first seconds, in which the spool opens P to B.
Reference pump(const std::string& direction) {
  Reference out;
  out.kind = ReferenceKind::pump;
  out.name = "pump";
  out.place = "references.toml, line 9";
  out.direction = direction;
  out.displacement_m3_per_rad = 1;
  out.speed_rad_per_s = 1e-4;
  out.marks = {{2.0, 4.0, 1e-4}};
  return out;
}

model::WearState wear_in(const model::Model& model, const std::string& direction) {
  return wear_of(model::of_direction(model, direction));
}

std::string whole_refusal(const std::vector<Reference>& references) {
  try {
    static_cast<void>(recalibrate(whole_valve(), fresh_both_ways(), references, how()));
  } catch (const CalibrationError& error) {
    return error.what();
  }
  return "";
}

TEST(RecalibrateWholeValve, FindsTheWearOfEachDirectionByAMeterThatKnowsNone) {
  const model::WearState p_to_b{0.14, 1.25, 0}, p_to_a{0.08, 1.25, 0};
  std::vector<recording::Recording> worn = both_ways_of(p_to_b, p_to_a);
  for (recording::Recording& recording : worn)
    for (double& flow : recording.column(Channel::flow_reference)) flow = std::abs(flow);
  const RecalibratedValve found = recalibrate(whole_valve(), worn, {meter()}, how());
  std::ostringstream text;
  model::write_model(text, found.model);
  const model::Model read = model::parse_model(text.str(), "whole_2.json");
  for (const auto& [direction, wear] : {std::pair{"b", p_to_b}, std::pair{"a", p_to_a}}) {
    EXPECT_NEAR(wear_in(read, direction).edge_width, wear.edge_width, 0.04) << direction;
    EXPECT_NEAR(wear_in(read, direction).friction_ratio, wear.friction_ratio, 0.12) << direction;
  }
  EXPECT_EQ(read.provenance.adaptations.size(), 2U);
  EXPECT_THAT(found.findings, testing::Contains(HasSubstr("P to A: edge width +")));
}

TEST(RecalibrateWholeValve, AValveThatDidNotWearStaysAsItIs) {
  const RecalibratedValve same = recalibrate(whole_valve(), fresh_both_ways(), {meter()}, how());
  for (const char* direction : {"b", "a"}) EXPECT_EQ(wear_in(same.model, direction), model::WearState{}) << direction;
}

TEST(RecalibrateWholeValve, AReferenceOfOneDirectionMovesThatOneAlone) {
  Reference of_a = meter();
  of_a.direction = "a";
  const model::WearState wear{0.14, 1.3, 0};
  const RecalibratedValve found = recalibrate(whole_valve(), both_ways_of(wear, wear), {of_a}, how());
  EXPECT_NEAR(wear_in(found.model, "a").edge_width, wear.edge_width, 0.04);
  EXPECT_EQ(wear_in(found.model, "b"), model::WearState{});
  EXPECT_EQ(found.model.observer->parameters.edge.conductance.values,
            whole_valve().observer->parameters.edge.conductance.values);
}

TEST(RecalibrateWholeValve, BothDirectionsGoBackTogether) {
  model::Model worn = whole_valve();
  for (const double width : {0.08, 0.16})
    worn = recalibrate(worn, both_ways_of({width, 1.2, 0}, {width, 1.2, 0}), {meter()}, how()).model;
  const model::Model once = gone_back(worn, 2, how()).model, never = gone_back(worn, 0, how()).model;
  for (const char* direction : {"b", "a"}) {
    EXPECT_NEAR(wear_in(once, direction).edge_width, 0.08, 0.04) << direction;
    EXPECT_EQ(wear_in(never, direction), model::WearState{}) << direction;
  }
}

TEST(RecalibrateWholeValve, ACountedVolumeSaysItsDirection) {
  EXPECT_THAT(whole_refusal({pump("")}), HasSubstr("write direction = \"b\" (P to B) or \"a\" (P to A)"));
}

TEST(RecalibrateWholeValve, ATimeInWhichTheOtherDirectionOpensIsNamed) {
  EXPECT_THAT(whole_refusal({pump("a")}), HasSubstr("between 2 s and 4 s of strokes.csv the spool opens the other"));
}

TEST(RecalibrateWholeValve, AClosedValveAloneMovesNothing) {
  EXPECT_THAT(whole_refusal({closed()}), HasSubstr("give strokes, a pump or a meter"));
}

}  // namespace
}  // namespace spoolflow::calibration
