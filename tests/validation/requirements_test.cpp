#include "spoolflow/validation/requirements.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/validation/judged_limits.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::validation {
namespace {

using ::testing::HasSubstr;

constexpr double valve_scale = 100 / 60000.0;

class RequirementsFile : public ::testing::Test {
 protected:
  [[nodiscard]] Requirements read(const std::string& text) const {
    file_.write(text);
    return read_requirements(file_.path());
  }
  void expect_refused(const std::string& text, const std::vector<std::string>& reasons) const {
    try {
      (void)read(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const recording::RecordingError& error) {
      for (const std::string& reason : reasons) EXPECT_THAT(error.what(), HasSubstr(reason));
    }
  }

  recording::TemporaryFile file_{"limits.toml"};
};

/// A run whose errors are 1, 2, … 100 hundredths of full scale while moving.
Validation one_run(const std::string& name = "ramp", bool reference = true) {
  ComparedSamples compared(valve_scale);
  for (int k = 1; k <= 100; ++k) {
    const double error = 0.01 * k * valve_scale;
    compared.add({0.5 * valve_scale + error, 0, valve_scale, 0.5 * valve_scale, true, false, false});
  }
  Validation out;
  RunResult& run = out.runs.emplace_back();
  run.name = name;
  run.samples = 100;
  EstimatorResult& result = run.results.emplace_back();
  result.estimator = estimation::Estimator::observer;
  result.fault_share = 0.02;
  PooledResult& pooled = out.pooled.emplace_back();
  pooled.estimator = estimation::Estimator::observer;
  if (reference) pooled.metrics = result.metrics = compared.metrics();
  return out;
}

TEST_F(RequirementsFile, HoldsLimitsWithTheirDefaults) {
  const Requirements asked = read(
      "[[limit]]\nfigure = 'p95'\nat_most = 5\n\n[[limit]]\nfigure = 'band_coverage'\n"
      "at_least = 93\nat_most = 99\nrun = 'each'\nestimator = 'condensed'\n");
  ASSERT_EQ(asked.limits.size(), 2U);
  EXPECT_EQ(asked.limits[0].run, "all");
  EXPECT_EQ(asked.limits[0].unit, LimitUnit::percent_FS);
  EXPECT_THAT(asked.limits[0].place, HasSubstr("line 1"));
  EXPECT_EQ(asked.limits[1].unit, LimitUnit::percent);
  EXPECT_EQ(asked.limits[1].at_least, 93);
  EXPECT_EQ(asked.limits[1].estimator, estimation::Estimator::condensed);
}

TEST_F(RequirementsFile, ThatCannotBeUsedIsRefusedWithItsLine) {
  expect_refused("", {"holds no limit", "[[limit]]"});
  expect_refused("[[limits]]\nfigure = 'p95'\n", {"line 1", "unknown key 'limits'", "did you mean 'limit'"});
  expect_refused("[[limit]]\nfigure = 'p59'\nat_most = 1\n", {"line 2", "\"p59\"", "p95"});
  expect_refused("[[limit]]\nat_most = 1\n", {"line 1", "needs a key 'figure'"});
  expect_refused("[[limit]]\nfigure = 'p95'\n", {"line 1", "bounds nothing"});
  expect_refused("[[limit]]\nfigure = 'p95'\nat_most = 'five'\n", {"line 3", "finite number"});
  expect_refused("[[limit]]\nfigure = 'p95'\nat_most = nan\n", {"line 3", "finite number"});
  expect_refused("[[limit]]\nfigure = 'p95'\nat_most = -1\n", {"line 3", "is -1", "above zero"});
  expect_refused("[[limit]]\nfigure = 'band_coverage'\nat_least = 950\n", {"line 3", "between 0 and 100"});
  expect_refused("[[limit]]\nfigure = 'p95'\nat_least = 9\nat_most = 5\n", {"at_least = 9", "at_most = 5"});
  expect_refused("[[limit]]\nfigure = 'p95'\nat_most = 5\nunit = '%'\n", {"line 4", "% FS"});
  expect_refused("[[limit]]\nfigure = 'fault_share'\nat_most = 5\nunit = 'L/min'\n", {"line 4", "\"%\""});
  expect_refused("[[limit]]\nfigure = 'fault_share'\nat_most = 5\nwhen = 'rest'\n", {"line 4", "leave 'when' out"});
  expect_refused("[[limit]]\nfigure = 'p95'\nat_most = 5\nwhen = 'resting'\n", {"line 4", "rest"});
  expect_refused("limit = 5\n", {"holds no limit"});
}

TEST_F(RequirementsFile, NamesOfRunsAndEstimatorsMustBeAmongThoseThatRun) {
  const Requirements run = read("[[limit]]\nfigure = 'p95'\nat_most = 5\nrun = 'rump'\n");
  EXPECT_THROW(check_names(run, {"ramp", "duty_cycle"}, {estimation::Estimator::observer}), recording::RecordingError);
  EXPECT_NO_THROW(check_names(run, {"rump"}, {estimation::Estimator::observer}));
  const Requirements estimator = read("[[limit]]\nfigure = 'p95'\nat_most = 5\nestimator = 'condensed'\n");
  EXPECT_THROW(check_names(estimator, {"ramp"}, {estimation::Estimator::observer}), recording::RecordingError);
}

TEST_F(RequirementsFile, LimitsAreJudgedAtTheFigureItself) {
  const Requirements asked = read(
      "[[limit]]\nfigure = 'p95'\nat_most = 96\n"
      "[[limit]]\nfigure = 'p95'\nat_most = 95\n"
      "[[limit]]\nfigure = 'largest'\nat_most = 101\nunit = 'L/min'\n"
      "[[limit]]\nfigure = 'bias'\nat_least = 50\nat_most = 51\n"
      "[[limit]]\nfigure = 'band_coverage'\nat_least = 100\n"
      "[[limit]]\nfigure = 'fault_share'\nat_most = 1.9\n"
      "[[limit]]\nfigure = 'rms'\nwhen = 'moving'\nat_most = 1\n");
  const std::vector<JudgedLimit> judged = judge(asked, one_run(), valve_scale);
  ASSERT_EQ(judged.size(), 7U);
  const std::vector<double> figures{96, 96, 100, 50.5, 100, 2, 58.168};
  const std::vector<bool> met{true, false, true, true, true, false, false};
  for (std::size_t k = 0; k < judged.size(); ++k) {
    ASSERT_TRUE(judged[k].value) << k;
    EXPECT_NEAR(*judged[k].value, figures[k], 1e-3) << k;
    EXPECT_EQ(judged[k].met, met[k]) << k;
  }
}

TEST_F(RequirementsFile, AnEachIsJudgedForEachRunAndAnUnknownFigureIsNotMet) {
  Validation validation = one_run("ramp");
  validation.runs.push_back(one_run("blind", false).runs.front());
  const Requirements asked = read(
      "[[limit]]\nrun = 'each'\nfigure = 'p95'\nat_most = 99\n"
      "[[limit]]\nwhen = 'rest'\nfigure = 'p95'\nat_most = 99\n");
  const std::vector<JudgedLimit> judged = judge(asked, validation, valve_scale);
  ASSERT_EQ(judged.size(), 3U);
  EXPECT_EQ(judged[0].run, "ramp");
  EXPECT_TRUE(judged[0].met);
  EXPECT_EQ(judged[1].run, "blind");
  EXPECT_FALSE(judged[1].value);
  EXPECT_FALSE(judged[1].met);
  EXPECT_FALSE(judged[2].met) << "no sample of the run is at rest";
}

}  // namespace
}  // namespace spoolflow::validation
