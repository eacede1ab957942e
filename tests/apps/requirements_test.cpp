/// What a user asks of the sensor: `validate --requirements`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::HasSubstr;

class Requirements : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    std::string run = "time_s,current_A,position_mm,flow_reference_L_min\n";
    for (int k = 0; k < 500; ++k) run += std::to_string(0.001 * k) + ",1.2,1.5,30\n";
    write("run.csv", run);
    std::filesystem::copy_file(SPOOLFLOW_EXAMPLE_MODEL, folder / "model.json");
  }
};

TEST_F(Requirements, AreJudgedInSummaryReportAndJson) {
  write("limits.toml",
        "[[limit]]\nfigure = 'largest'\nat_most = 200\n[[limit]]\nrun = 'run'\nfigure = 'rms'\nat_most = 1e-9\n");
  const Answer answer =
      run("validate model.json run.csv --requirements limits.toml --report report.html --json metrics.json -q");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output, HasSubstr("1 of 2 limits of limits.toml is not met."));
  EXPECT_THAT(answer.output, HasSubstr("NOT MET"));
  EXPECT_THAT(content("report.html"), HasSubstr("1 of 2 limits of limits.toml is not met."));
  const auto json = nlohmann::json::parse(content("metrics.json")).at("requirements");
  EXPECT_FALSE(json.at("met"));
  EXPECT_TRUE(json.at("limits").at(0).at("met"));
  EXPECT_EQ(json.at("limits").at(1).at("run"), "run");
  EXPECT_NEAR(json.at("limits").at(1).at("value"),
              nlohmann::json::parse(content("metrics.json"))
                  .at("runs")
                  .at(0)
                  .at("estimators")
                  .back()
                  .at("error")
                  .at("all")
                  .at("rms")
                  .at("percent_FS"),
              1e-9);
}

TEST_F(Requirements, ThatCannotBeUsedStopTheCommandBeforeAnythingIsWritten) {
  write("report.html", "earlier");
  for (const auto& [limits, reason] :
       {std::pair{"[[limit]]\nfigure = 'p95'\n", "line 1"},
        std::pair{"[[limit]]\nfigure = 'p95'\nat_most = 1\nrun = 'rnu'\n", "did you mean 'run'"},
        std::pair{"[[limit]]\nfigure = 'band_coverage'\nat_least = 0.95\n",
                  "line 3: 'at_least' in limit 1 is 0.95 %, which says nothing of band_coverage; write 95 for 95 %"},
        std::pair{"[[limit]\n", "line 1"}}) {
    write("limits.toml", limits);
    const Answer answer = run("validate model.json run.csv --requirements limits.toml --report report.html");
    EXPECT_EQ(answer.status, 2) << limits;
    EXPECT_THAT(answer.message, HasSubstr("limits.toml"));
    EXPECT_THAT(answer.message, HasSubstr(reason));
    EXPECT_EQ(content("report.html"), "earlier");
  }
  EXPECT_EQ(run("validate model.json run.csv --requirements missing.toml").status, 2);
}

TEST_F(Requirements, WhatTheCalibrationReadIsNoTestAndIsSaidToBeNone) {
  write("limits.toml", "[[limit]]\nfigure = 'p95'\nat_most = 50\n");
  const Answer answer =
      run("validate model.json " SPOOLFLOW_EXAMPLES "/valve_a/ramp_60bar.h5 --requirements limits.toml --fail-unmet");
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.output, HasSubstr("found no independent test: the calibration read it; give a run that it did"));
}

TEST_F(Requirements, OtherValidationsStandBesideThisOneInTheReport) {
  EXPECT_EQ(run("validate model.json run.csv --json other.json -q").status, 0);
  const Answer answer =
      run("validate model.json run.csv --report report.html --compare other.json --compare other.json -q");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(content("report.html"), HasSubstr("Side by side"));
  EXPECT_THAT(content("report.html"), HasSubstr("other.json"));
  const Answer refused = run("validate model.json run.csv --report report.html --compare model.json");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.message, HasSubstr("model.json: its format is not"));
}

}  // namespace
}  // namespace spoolflow::apps
