/// A valve that wore, in the closed form of the sensor's own functions: how the search behaves, not how well it does.
#include "spoolflow/calibration/references/recalibrate.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
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
using testing::Not;

const model::Model& worn_valve() {
  static const model::Model model = model_without_drift();
  return model;
}

std::vector<recording::Recording> strokes_of(const model::WearState& wear) {
  const sensor::ObserverParameters<double> unit = worn(worn_valve().observer->parameters, wear);
  std::vector<recording::Recording> out;
  for (const double pressure_bar : {30.0, 45.0}) {
    const recording::TemporaryFile file("strokes_at_" + std::to_string(static_cast<int>(pressure_bar)) + "_bar.csv");
    write_strokes(file.path(), unit, {pressure_bar, pressure_bar}, worn_valve().valve.stroke_m);
    recording::ReadOptions options;
    options.required = {Channel::time, Channel::current, Channel::position};
    options.optional = {Channel::oil_temperature, Channel::flow_reference};
    out.push_back(recording::read_recording(file.path(), options));
  }
  return out;
}

const std::vector<recording::Recording>& fresh_strokes() {
  static const std::vector<recording::Recording> recordings = strokes_of({});
  return recordings;
}

std::string refusal(const std::vector<recording::Recording>& recordings, const std::vector<Reference>& references) {
  try {
    static_cast<void>(recalibrate(worn_valve(), recordings, references, how()));
  } catch (const CalibrationError& error) {
    return error.what();
  }
  return "";
}

void scale_meter(std::vector<recording::Recording>& recordings, double factor) {
  for (recording::Recording& recording : recordings)
    for (double& flow : recording.column(Channel::flow_reference)) flow *= factor;
}

/// A pump that says `share` of the oil which the meter sees in that recording.
Reference gear_pump(const recording::Recording& recording, double share) {
  double passed_m3 = 0;
  for (std::size_t k = 1; k < recording.size(); ++k)
    passed_m3 +=
        recording[Channel::flow_reference][k] * (recording[Channel::time][k] - recording[Channel::time][k - 1]);
  const double begin_s = recording[Channel::time].front(), end_s = recording[Channel::time].back();
  Reference out;
  out.kind = ReferenceKind::pump;
  out.name = "gear pump";
  out.place = "references.toml, line 9";
  out.recording = recording.file.filename().string();
  out.share_uncertainty = 0.01;
  out.displacement_m3_per_rad = 1;
  out.marks = {{begin_s, end_s, share * passed_m3 / (end_s - begin_s)}};
  return out;
}

std::string text_of(const model::Model& model) {
  std::ostringstream out;
  model::write_model(out, model);
  return out.str();
}

TEST(Recalibrate, AValveThatDidNotWearStaysAsItIsToTheLastBit) {
  const RecalibratedValve same = recalibrate(worn_valve(), fresh_strokes(), {meter(), closed()}, how());
  EXPECT_EQ(wear_of(same.model), model::WearState{});
  model::Model without_log = same.model;
  without_log.provenance.adaptations.clear();
  EXPECT_EQ(text_of(without_log), text_of(worn_valve()));
  EXPECT_EQ(same.model.provenance.adaptations.size(), 1U);
}

TEST(Recalibrate, FindsTheWearOfEdgesFrictionAndPositionZeroAndLogsIt) {
  const model::WearState wear{0.12, 1.35, 15e-6};
  const RecalibratedValve found = recalibrate(worn_valve(), strokes_of(wear), {meter(), closed()}, how());
  EXPECT_NEAR(wear_of(found.model).edge_width, wear.edge_width, 0.04);
  EXPECT_NEAR(wear_of(found.model).friction_ratio, wear.friction_ratio, 0.12);
  EXPECT_NEAR(wear_of(found.model).position_zero_m, wear.position_zero_m, 2e-6);
  EXPECT_GT(found.model.observer->parameters.environment.flow_share, 0);
  EXPECT_GT(found.model.observer->parameters.environment.friction_share, 0.03) << "what strokes leave open of friction";
  const model::Model read = model::parse_model(text_of(found.model), "valve_2.json");
  ASSERT_EQ(wear_states(read).size(), 2U);
  EXPECT_EQ(wear_of(read), wear_of(found.model));
  const model::Adaptation& log = read.provenance.adaptations.back();
  EXPECT_EQ(log.corrections.size(), 3U);
  EXPECT_EQ(log.reasons, found.findings);
}

TEST(Recalibrate, EdgesThatWereTakenForALittleTooWideGoBackButNotBelowTheCalibratedOnes) {
  const model::WearState wide{0.03, 1, 0, 0.01, 0.05};
  model::Model before = moved(worn_valve(), wide);
  before.provenance.adaptations.push_back({"1", "t", std::string(64, 'a'), {}, {}, {}, {wide}});
  const RecalibratedValve found = recalibrate(before, fresh_strokes(), {meter()}, how());
  EXPECT_LT(wear_of(found.model).edge_width, 0.02);
  EXPECT_GE(wear_of(found.model).edge_width, 0);
}

TEST(Recalibrate, FindsFrictionBesideEdgesThatWidened) {
  const RecalibratedValve found = recalibrate(worn_valve(), strokes_of({0.1, 1.2, 0}), {meter()}, how());
  EXPECT_NEAR(wear_of(found.model).friction_ratio, 1.2, 0.08);
  EXPECT_NEAR(wear_of(found.model).edge_width, 0.1, 0.04);
}

TEST(Recalibrate, GoesBackToAnyEarlierState) {
  model::Model once = moved(worn_valve(), {0.05, 1.2, 10e-6, 0.01, 0.05});
  once.provenance.adaptations.push_back({"1", "t", std::string(64, 'a'), {}, {}, {}, {{0.05, 1.2, 10e-6, 0.01, 0.05}}});
  model::Model twice = moved(once, {0.09, 1.5, 14e-6, 0.01, 0.06});
  twice.provenance.adaptations.push_back(
      {"1", "t", std::string(64, 'b'), {}, {}, {}, {{0.09, 1.5, 14e-6, 0.01, 0.06}}});
  for (const auto& [state, there] : {std::pair{0, worn_valve()}, std::pair{1, once}}) {
    const model::Model back = gone_back(twice, static_cast<std::size_t>(state), how()).model;
    const auto &is = back.observer->parameters, &was = there.observer->parameters;
    EXPECT_NEAR(is.edge.at(320, 40e5, 1e-3).conductance / was.edge.at(320, 40e5, 1e-3).conductance, 1, 1e-9);
    EXPECT_NEAR(is.friction.operation_ratio, was.friction.operation_ratio, 1e-12);
    EXPECT_NEAR(is.spring.at(1e-3).value, was.spring.at(1e-3).value, 1e-9);
    EXPECT_NEAR(is.environment.flow_share, was.environment.flow_share, 1e-9);
    EXPECT_NEAR(is.environment.friction_share, was.environment.friction_share, 1e-9);
    EXPECT_NEAR(is.band.friction_share, was.band.friction_share, 1e-9);
    EXPECT_EQ(wear_states(back).size(), 4U);
  }
  EXPECT_THROW(static_cast<void>(gone_back(twice, 3, how())), CalibrationError);
}

TEST(Recalibrate, NamesWhatMonitorCorrectedWhichNoStateUndoes) {
  model::Model corrected = worn_valve();
  EXPECT_THAT(gone_back(corrected, 0, how()).doubts, testing::IsEmpty());
  corrected.provenance.adaptations.push_back(
      {"1", "t", std::string(64, 'c'), {"week.csv"}, {{"b", "friction ratio", "1", 1.452, 0.09}}});
  EXPECT_THAT(gone_back(corrected, 0, how()).doubts,
              testing::ElementsAre("`monitor --adapt` corrected friction ratio (1.45) by week.csv, and every state has "
                                   "that; the model before it has the SHA-256 " +
                                   std::string(64, 'c')));
}

TEST(Recalibrate, RefusesLessOilThanForcesSayForEdgesOnlyWiden) {
  std::vector<recording::Recording> recordings = fresh_strokes();
  scale_meter(recordings, 0.9);
  EXPECT_THAT(
      refusal(recordings, {meter()}),
      HasSubstr("narrower, and wear widens them; likely the meter's range ends, or the stated gain is too small"));
}

TEST(Recalibrate, RefusesMoreOilThanEdgesWearUnlessAnotherReferenceSaysTheSame) {
  std::vector<recording::Recording> recordings = fresh_strokes();
  scale_meter(recordings, 1.15);
  EXPECT_THAT(refusal(recordings, {meter()}), HasSubstr("a stated gain that is"));
  EXPECT_THAT(refusal(recordings, {meter(), gear_pump(recordings[0], 1)}), Not(HasSubstr("too large")));
}

TEST(Recalibrate, OfOneReferenceItSaysThatAMisstatedOneLooksAlikeAndTheBandHoldsIt) {
  std::vector<recording::Recording> recordings = fresh_strokes();
  scale_meter(recordings, 1.08);
  const RecalibratedValve found = recalibrate(worn_valve(), recordings, {meter()}, how());
  EXPECT_THAT(found.findings, testing::Contains(HasSubstr("% too large looks alike")));
  EXPECT_THAT(found.doubts, testing::ElementsAre(HasSubstr("meter: a stated gain")));
  EXPECT_GT(2 * wear_of(found.model).flow_share, std::log(1.08));
  const RecalibratedValve again = recalibrate(found.model, recordings, {meter()}, how());
  EXPECT_GE(wear_of(again.model).flow_share, wear_of(found.model).flow_share);
}

TEST(Recalibrate, RefusesTwoReferencesThatContradictEachOtherByName) {
  const Reference pump = gear_pump(fresh_strokes()[0], 1.15);
  EXPECT_THAT(refusal(fresh_strokes(), {meter(), pump}), HasSubstr("gear pump says +"));
}

TEST(Recalibrate, AMeterCountsOnce) {
  Reference again = meter();
  again.name = "meter 2";
  EXPECT_THAT(
      refusal(fresh_strokes(), {meter(), again}),
      HasSubstr("meter 2 sees the same of the recording as meter (references.toml, line 1), which counts once"));
}

TEST(Recalibrate, SaysOfAReferenceInAnotherUnitHowMuchOfItTheSensorSaw) {
  std::vector<recording::Recording> recordings = fresh_strokes();
  scale_meter(recordings, 60);
  EXPECT_THAT(refusal(recordings, {meter()}), HasSubstr("; in the median it sees 1.66"));
}

TEST(Recalibrate, SaysWhyAMeterShowsNothing) {
  const auto why = [](const std::vector<recording::Recording>& recordings, double interval_s) -> std::string {
    Reference of = meter();
    of.interval_s = interval_s;
    try {
      static_cast<void>(recalibrate(worn_valve(), recordings, {of}, how()));
    } catch (const recording::RecordingError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(why(fresh_strokes(), 600), testing::ContainsRegex("it lasts 2[0-9.]+ s, and interval_s is 600; give a "
                                                                "longer recording, or a shorter interval_s$"));
  std::vector<recording::Recording> turned = fresh_strokes(), dead = turned;
  scale_meter(turned, -1);
  EXPECT_THAT(why(turned, 2),
              testing::ContainsRegex("flow_reference is -[0-9.]+ to -[0-9.]+ L/min, and no interval of 2 s "
                                     ".*look at the meter's sign, unit and column"));
  scale_meter(dead, NAN);
  EXPECT_THAT(why(dead, 2), HasSubstr("flow_reference has no values, and"));
}

TEST(Recalibrate, NamesAClosedReferenceWhoseValveNeverCloses) {
  std::vector<recording::Recording> recordings = fresh_strokes();
  for (recording::Recording& recording : recordings)
    for (double& current_A : recording.column(Channel::current)) current_A += 0.2;
  EXPECT_THAT(refusal(recordings, {meter(), closed()}), HasSubstr("never stands closed"));
}

TEST(Recalibrate, NamesAReferenceWhoseRecordingIsNotGiven) {
  Reference elsewhere = meter();
  elsewhere.recording = "tuesday.csv";
  EXPECT_THAT(
      refusal(fresh_strokes(), {closed(), elsewhere}),
      HasSubstr("meter is of the recording tuesday.csv, and given are strokes_at_30_bar.csv, strokes_at_45_bar"));
}

TEST(Recalibrate, RefusesAReferenceInAnotherUnit) {
  const Reference pump = gear_pump(fresh_strokes()[0], 0.01);
  EXPECT_THAT(refusal(fresh_strokes(), {pump}),
              HasSubstr("gear pump is refused: in every interval the sensor sees less than 30 % of its oil pass, or "
                        "more than 333 %; check the units of what it states"));
}

TEST(Recalibrate, OilThatTwoReferencesOfAKindTellCountsOnce) {
  const Reference pump = gear_pump(fresh_strokes()[0], 1);
  Reference again = pump;
  again.name = "the same pump";
  EXPECT_THAT(refusal(fresh_strokes(), {pump, again}), HasSubstr("of which gear pump (references.toml, line 9) has"));
}

}  // namespace
}  // namespace spoolflow::calibration
