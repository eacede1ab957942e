#include "spoolflow/report/validation/validation_report.hpp"

#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/report/validation/verdict.hpp"
#include "tests/report/markup.hpp"

namespace spoolflow::report {
namespace {

using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Property;
using ::testing::StartsWith;

constexpr double full_scale = 80 / 60000.0;

model::Model small_model() {
  model::Model model{};
  model.valve = {"valve <A> & friends", full_scale, 2.4e-3, "b"};
  model.fluid = {"HLP46", 874.0, 4.6e-5, std::nullopt};
  model.provenance = {
      "spoolflow 0.1.0", "2026-01-02T03:04:05Z", {{"spring", "spring.csv", std::string(64, 'a'), 4200}}};
  model.condensed.current_A = {0, 2.6};
  model.condensed.position_m = {0, 2.4e-3};
  model.condensed.pressure_difference_Pa = {5e5, 70e5};
  model.condensed.oil_temperature_K = 323.15;
  model.condensed.residuals = {{"spring force", "N", 0.05, 0.2},
                               {"magnetic force", "N", 0.07, 0.3},
                               {"axial force", "N", 0.08, 0.3},
                               {"flow rate", "m3/s", 1e-6, 4e-6}};
  model.evidence.magnetic_force = {{0.2, {0, 1e-3, 2e-3}, {1, 2, 2}, {3, 4, 4}},
                                   {0.4, {0, 1e-3, 2e-3}, {5, 6, 6}, {7, 8, 8}}};
  model.evidence.axial_force = {
      {5e5, {0, 1e-3, 2e-3}, {12, 14, 16}, {8, 9, 10}, {0, 1e-4, 2e-4}, {5e5, 5e5, 5e5}},
      {70e5, {0, 1e-3, 2e-3}, {15, 30, 50}, {9, 22, 40}, {0, 8e-4, 12e-4}, {70e5, 70e5, 70e5}}};
  model.evidence.sensitivity = {{0, 1e-3, 2e-3}, {5e5, 70e5}, {1e-3, 1e-3, 4e-5, 1e-5, 3e-5, 1e-5}};
  model.evidence.uniqueness = {1e-4, 2e-4, {}};
  return model;
}

/// A run of `samples` that reads 1 L/min too much while moving and `at_rest_L_min` too much at rest.
validation::Validation one_run(int samples, double at_rest_L_min, bool reference = true) {
  validation::Validation out;
  out.reference_lag_s = 0.03;
  validation::RunResult& run = out.runs.emplace_back();
  run.name = "run_1";
  run.file = "run_1.csv";
  run.sha256 = std::string(64, 'b');
  run.samples = static_cast<std::uint64_t>(samples);
  run.duration_s = samples > 1 ? 1e-3 * (samples - 1) : 0;
  run.has_reference = reference;
  validation::EstimatorResult& result = run.results.emplace_back();
  result.estimator = estimation::Estimator::condensed;
  validation::ComparedSamples compared(full_scale);
  std::vector<validation::ErrorProfile> profiles(4, validation::ErrorProfile(1, full_scale));
  for (int k = 0; k < samples; ++k) {
    const bool rest = k % 2 == 0;
    const double error = (rest ? at_rest_L_min : 1) / 60000;
    compared.add({5e-4 + error, 4e-4, 6e-4, 5e-4, !rest, rest, false});
    run.reference_line_m3_per_s.time_s.push_back(1e-3 * k);
    run.reference_line_m3_per_s.value.push_back(5e-4F);
    for (auto& profile : profiles) profile.add(k % 5, error);
  }
  result.flow_m3_per_s = run.reference_line_m3_per_s;
  run.position_line_m = run.reference_line_m3_per_s;
  result.status = {{"closed", "No flow.", false, 0.25, {{0, 0.1, 1}}}};
  validation::PooledResult& pooled = out.pooled.emplace_back();
  pooled.estimator = result.estimator;
  pooled.profiles = profiles;
  if (!reference) return out;
  result.profiles = profiles;
  result.metrics = compared.metrics();
  pooled.metrics = result.metrics;
  result.error_m3_per_s = run.reference_line_m3_per_s;
  result.worst = validation::WorstMoment{};
  result.worst->flow_m3_per_s.resize(1);
  return out;
}

std::string page_of(const validation::Validation& validation) {
  std::ostringstream out;
  write_validation_report(out, small_model(), validation);
  return out.str();
}

TEST(ValidationReport, IsOneWellFormedPageThatNeedsNoNetwork) {
  const std::string page = page_of(one_run(1000, 5));
  EXPECT_EQ(unbalanced_markup(page), "");
  for (const char* outside : {"http:", "https:", "src=", "@import", "url(//", "<link"}) {
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  }
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, HasSubstr("valve &lt;A&gt; &amp; friends"));
  EXPECT_THAT(without_scripts(page), Not(HasSubstr("nan")));
}

TEST(ValidationReport, NamesWhereItsFiguresComeFrom) {
  const std::string page = page_of(one_run(1000, 5));
  EXPECT_THAT(page, HasSubstr(std::string(64, 'a')));
  EXPECT_THAT(page, HasSubstr(std::string(64, 'b')));
  EXPECT_THAT(page, HasSubstr("2026-01-02"));
}

TEST(ValidationReport, OfOneSampleOfNoReferenceAndOfNothingIsStillAPage) {
  EXPECT_EQ(unbalanced_markup(page_of(one_run(1, 5))), "");
  EXPECT_EQ(unbalanced_markup(page_of(one_run(0, 5, false))), "");
  const std::string page = page_of(one_run(1000, 5, false));
  EXPECT_EQ(unbalanced_markup(page), "");
  EXPECT_THAT(page, HasSubstr("no reference flow"));
  EXPECT_THAT(without_scripts(page), Not(HasSubstr("nan")));
}

TEST(ValidationReport, InOtherUnitsTurnsItsFiguresAndNoName) {
  validation::Validation validation = one_run(1000, 5);
  validation.runs.front().name = "ramp at 60 bar";
  validation.runs.front().file = "ramp at 60 bar.csv";
  validation.runs.front().pressure_difference_Pa = validation::Extent{59.5e5, 60.5e5};
  validation.runs.front().results.front().worst->pressure_difference_Pa = 60e5;
  std::ostringstream out;
  write_validation_report(out, small_model(), validation, {}, ReaderUnits({"psi", "gal/min"}));
  std::string page = without_scripts(out.str());
  EXPECT_THAT(page, HasSubstr("863 to 877 psi"));
  EXPECT_THAT(page, HasSubstr(", 870 psi. Status then"));
  EXPECT_THAT(page, HasSubstr("(1.32 gal/min)"));
  EXPECT_THAT(page, HasSubstr(">Run ramp at 60 bar</h2>"));
  EXPECT_THAT(page, HasSubstr(">ramp at 60 bar.csv<"));
  for (std::size_t at = page.find("ramp at 60 bar"); at != std::string::npos; at = page.find("ramp at 60 bar"))
    page.erase(at, 14);
  EXPECT_THAT(page, Not(ContainsRegex("(\\[|[0-9] )(bar|L/min)")));
}

/// Where each of the texts stands, which must all stand there in this order.
void expect_in_order(const std::string& page, const std::vector<std::string>& texts) {
  std::size_t from = 0;
  for (const std::string& text : texts) {
    const std::size_t at = page.find(text, from);
    ASSERT_NE(at, std::string::npos) << text << " is missing, or stands further up";
    from = at + text.size();
  }
}

TEST(ValidationReport, BeginsWithFullScaleVerdictAndOnePlotAndTablesAndContentsFollow) {
  expect_in_order(page_of(one_run(1000, 5)),
                  {"<h1>Flow rate of", "full scale 80.0 L/min", "class=\"verdict\"", "class=\"badge fail\">fail</b>",
                   "Condensed: the sensor of the paper", "<figure>", "<svg", "Run run_1, which has the largest error",
                   "class=\"tiles\"", "<table", "<nav", "<h2"});
}

TEST(ValidationReport, SaysInItsHeadlineThatTheModelIsOfSimulatedRecordings) {
  model::Model model = small_model();
  const auto headline = [&] {
    std::ostringstream out;
    write_validation_report(out, model, one_run(1000, 5), {});
    const std::string page = out.str();
    const std::size_t from = page.find("class=\"facts\"");
    return page.substr(from, page.find("</p>", from) - from);
  };
  EXPECT_THAT(headline(), Not(HasSubstr("imulated")));
  model.provenance.simulated = true;
  EXPECT_THAT(headline(), HasSubstr("full scale 80.0 L/min; simulated"));
}

TEST(ValidationReport, JudgesByStatedDefaultLimitsWhereNoneAreGiven) {
  EXPECT_THAT(page_of(one_run(1000, 5)), HasSubstr("By default limits: 95th percentile of the condensed's error: at "
                                                   "most 5 % FS; share of the samples inside"));
  EXPECT_THAT(page_of(one_run(1000, 1)), HasSubstr("badge pass\">pass</b> By default limits"));
  EXPECT_THAT(page_of(one_run(1000, 1, false)), Not(HasSubstr("By default limits")));
  validation::Validation known = one_run(1000, 1);
  known.runs.front().calibrated_with = true;
  known.held_out = false;
  EXPECT_THAT(page_of(known), HasSubstr("badge open\">not judged</b> By default limits"));
}

TEST(ValidationReport, GivesOneRunThatCountsOneRow) {
  validation::Validation validation = one_run(1000, 5);
  validation.pooled.front().by_sample = validation.pooled.front().metrics;
  validation.runs.push_back(validation.runs.front());
  EXPECT_THAT(page_of(validation), HasSubstr("<b>all runs</b>"));
  validation.runs.back().calibrated_with = true;
  EXPECT_THAT(page_of(validation), Not(HasSubstr("<b>all runs</b>")));
  EXPECT_THAT(page_of(validation), Not(HasSubstr(">all samples<")));
}

TEST(ValidationReport, RoundsTextAndTilesAlike) {
  const std::string page = page_of(one_run(1000, 5));  // 6.25 % of full scale
  EXPECT_THAT(page, HasSubstr("within 6.2 % of full scale"));
  EXPECT_THAT(page, HasSubstr("<b>6.2 % FS</b><span>95 % of the condensed sensor"));
  EXPECT_THAT(page, HasSubstr("<b>6.2 % FS</b><span>largest error"));
}

TEST(Verdict, GivesTheFigureAndNamesRestWhereRestLimitsIt) {
  const Verdict said = verdict(small_model(), one_run(1000, 5));
  EXPECT_THAT(said.sentence.str(), HasSubstr("within 6.2 % of full scale (5.0 L/min)"));
  ASSERT_FALSE(said.limits.empty());
  EXPECT_THAT(said.limits.front().str(), HasSubstr("At rest"));
  EXPECT_THAT(said.limits, Contains(Property(&Text::str, HasSubstr("95 % band holds 100.0 %"))));
}

TEST(Verdict, DoesNotBlameRestWhereItIsNoWorse) {
  const Verdict said = verdict(small_model(), one_run(1000, 1));
  for (const Text& limit : said.limits) EXPECT_THAT(limit.str(), Not(HasSubstr("At rest")));
}

TEST(Verdict, WithoutReferenceSaysThatTheErrorIsNotKnown) {
  EXPECT_THAT(verdict(small_model(), one_run(10, 1, false)).sentence.str(), HasSubstr("its error is not known"));
}

TEST(Verdict, OrdersItsRemarksByHarmWhateverTheOrderOfTheRuns) {
  validation::Validation validation = one_run(1000, 5);
  validation.runs.front().results.back().status = {{"coil_fault", "Look.", true, 0.001, {}}};
  const auto add = [&](const char* name) -> validation::RunResult& {
    validation.runs.push_back(validation.runs.front());
    validation.runs.back().name = name;
    return validation.runs.back();
  };
  add("lasts").results.back().status = {{"position_fault", "Look.", true, 0.2, {}}};
  add("longer").results.back().status = {{"position_fault", "Look.", true, 0.6, {}}};
  add("beyond").results.back().status = {{"outside_force_map", "Answered at its edge.", false, 0.3, {}}};
  add("doubted").doubts = {"run.csv: position looks reversed"};
  add("scaled").reference_scale = validation::ReferenceScale{1.07, 0.005, 0, 1e-6};
  const Verdict said = verdict(small_model(), validation);
  ASSERT_GE(said.limits.size(), 7U);
  const std::vector<std::string> starts{"Doubt: run.csv", "longer: position_fault", "lasts: position_fault",
                                        "scaled: the reference reads 1.070", "At rest"};
  for (std::size_t k = 0; k < starts.size(); ++k) EXPECT_THAT(said.limits[k].str(), StartsWith(starts[k]));
  std::ranges::reverse(validation.runs);
  const Verdict turned = verdict(small_model(), validation);
  EXPECT_EQ(turned.sentence.str(), said.sentence.str());
  ASSERT_EQ(turned.limits.size(), said.limits.size());
  for (std::size_t k = 0; k < said.limits.size(); ++k) EXPECT_EQ(turned.limits[k].str(), said.limits[k].str());
}

TEST(Verdict, SaysWhatItWouldBeWereEverySampleToWeighAlike) {
  validation::Validation validation = one_run(1000, 5);
  validation.runs.push_back(validation.runs.front());
  validation.pooled.front().by_sample = validation.pooled.front().metrics;
  validation.pooled.front().by_sample->all.error.p95 = 0.08 * full_scale;
  EXPECT_THAT(verdict(small_model(), validation).sentence.str(),
              HasSubstr("this is the mean over runs, 8.0 % over all samples"));
}

TEST(ValidationReport, NeverCallsASpoolClosedOrAtRestWhereItMoves) {
  validation::Validation validation = one_run(1000, 5);
  validation::WorstMoment& worst = *validation.runs.front().results.front().worst;
  worst.status = {"spool_at_rest"};
  EXPECT_THAT(page_of(validation), HasSubstr("the spool at rest, "));
  worst.moving = true;
  worst.velocity_m_per_s = -0.05;
  EXPECT_THAT(page_of(validation),
              HasSubstr("the spool moving at 50.0 mm/s, 0.00 mm open. Status then: spool_at_rest, though it moved"));
}

TEST(CalibrationReport, IsOneWellFormedPage) {
  std::ostringstream out;
  write_calibration_report(out, small_model());
  EXPECT_EQ(unbalanced_markup(out.str()), "");
  EXPECT_THAT(out.str(), HasSubstr("the paper's Fig. 5"));
  EXPECT_THAT(out.str(), HasSubstr("the paper's Fig. 8"));
  EXPECT_THAT(out.str(), Not(HasSubstr("The model against the bench")));
  model::Model measured = small_model();
  measured.evidence.bench.solenoid = {{1, 1.2e-3, {0, 1, 2}, {0, 11, 20}, {0, 10.5, 20}, {0, 10, 20}}};
  measured.evidence.bench.axial_force = {{60e5, 323.15, {1e-3, 2e-3}, {0.1, -0.1}, {0.1, 0.1}},
                                         {60e5, 343.15, {1e-3, 2e-3}, {0.1, -0.1}, {0.1, 0.1}}};
  std::ostringstream with;
  write_calibration_report(with, measured);
  EXPECT_EQ(unbalanced_markup(with.str()), "");
  EXPECT_THAT(with.str(),
              HasSubstr("The map alone leaves 0.577 N (RMS), the model with hysteresis and eddy currents 0.289 N"));
  EXPECT_THAT(with.str(), HasSubstr("70 \u00b0C: axial force less model [N]"));
  model::Model bare = small_model();
  bare.evidence = {};
  bare.condensed.residuals.clear();
  std::ostringstream empty;
  write_calibration_report(empty, bare);
  EXPECT_EQ(unbalanced_markup(empty.str()), "");
}

TEST(CalibrationReport, SaysWhichQuantitiesWereMeasuredInferredAndAssumed) {
  model::Model model = small_model();
  std::ostringstream silent;
  write_calibration_report(silent, model);
  EXPECT_THAT(silent.str(), Not(HasSubstr("measured, inferred, assumed")));
  model.provenance.quantities = {{"b", "scale of all forces", "inferred", "coenergy", "1", 0.17},
                                 {"b", "spring force", "inferred", "strokes", "N", 0.4},
                                 {"b", "backlash", "inferred", "operation", "1", 43.0},
                                 {"b", "moving mass", "assumed", "as usual", "1"}};
  std::ostringstream out;
  write_calibration_report(out, model);
  EXPECT_EQ(unbalanced_markup(out.str()), "");
  EXPECT_THAT(out.str(), HasSubstr("their common scale within 17 %"));
  expect_in_order(out.str(),
                  {"What was measured, inferred, assumed", "scale of all forces", "17 %", "spring force", "inferred",
                   "0.400 N", "backlash", "not identifiable", "moving mass", "assumed", "not known"});
}

TEST(MetricsJson, HoldsTheFiguresUnderTheirDocumentedKeys) {
  std::ostringstream out;
  write_metrics(out, small_model(), one_run(1000, 5));
  const auto json = nlohmann::json::parse(out.str());
  EXPECT_EQ(json.at("version"), 1);
  const auto& estimator = json.at("runs").at(0).at("estimators").at(0);
  EXPECT_EQ(estimator.at("estimator"), "condensed");
  EXPECT_NEAR(estimator.at("error").at("rest").at("p95").at("L_min"), 5, 1e-4);
  EXPECT_NEAR(estimator.at("error").at("rest").at("p95").at("percent_FS"), 6.25, 1e-4);
  EXPECT_EQ(estimator.at("error").at("reversal").at("samples"), 0);
  EXPECT_NEAR(json.at("all_runs").at(0).at("error").at("all").at("band_coverage"), 1.0, 1e-12);
  EXPECT_EQ(json.at("all_runs").at(0).at("error_over").at("flow_L_min").size(), 5U);
  EXPECT_DOUBLE_EQ(json.at("runs").at(0).at("estimators").at(0).at("status_share").at("closed"), 0.25);
}

}  // namespace
}  // namespace spoolflow::report
