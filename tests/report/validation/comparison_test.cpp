#include "spoolflow/report/validation/comparison.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/recording/temporary_file.hpp"
#include "tests/report/markup.hpp"

namespace spoolflow::report {
namespace {

using ::testing::HasSubstr;

constexpr const char* figures = R"({"format":"spoolflow metrics","version":1,"valve":"valve <B>","full_scale_L_min":40,
 "runs":[{},{}],"all_runs":[{"estimator":"condensed"},{"estimator":"observer","error":{"all":{"p95":{"percent_FS":3.5},
 "rms":{"percent_FS":1.5},"largest":{"percent_FS":9},"bias":{"percent_FS":-0.5},"band_coverage":0.951,
 "band_mean_width":{"percent_FS":7}}},"error_over":{"pressure_difference_bar":[{"from":10,"to":15,"p95_percent_FS":6}]}}]})";

class Comparison : public ::testing::Test {
 protected:
  [[nodiscard]] ComparedValidation read(const std::string& text) const {
    file_.write(text);
    return read_compared(file_.path());
  }
  void expect_refused(const std::string& text, const std::string& reason) const {
    try {
      (void)read(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const MetricsError& error) {
      EXPECT_THAT(error.what(), HasSubstr(file_.path().string()));
      EXPECT_THAT(error.what(), HasSubstr(reason));
    }
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  }

  recording::TemporaryFile file_{"metrics.json"};
};

TEST_F(Comparison, ReadsTheEstimatorsThatHaveFigures) {
  const ComparedValidation other = read(figures);
  EXPECT_EQ(other.valve, "valve <B>");
  EXPECT_EQ(other.runs, 2U);
  ASSERT_EQ(other.estimators.size(), 1U);
  EXPECT_EQ(other.estimators.front().name, "observer");
  EXPECT_EQ(other.estimators.front().p95, 3.5);
  EXPECT_NEAR(other.estimators.front().band_coverage_percent, 95.1, 1e-9);
  EXPECT_THAT(other.estimators.front().pressure_difference_Pa, ::testing::ElementsAre(::testing::DoubleEq(12.5e5)));
}

TEST_F(Comparison, RefusesWhatValidateDidNotWrite) {
  expect_refused("{", "is no JSON");
  expect_refused("{}", "/format is missing");
  expect_refused(replaced(figures, "spoolflow metrics", "other"), "format is not");
  expect_refused(replaced(figures, "\"version\":1", "\"version\":2"), "version 2");
  expect_refused(replaced(figures, "\"p95\":{\"percent_FS\":3.5}", "\"p95\":{}"),
                 "/all_runs/1/error/all/p95/percent_FS");
  expect_refused(replaced(figures, "\"error\":{", "\"none\":{"), "none of its runs had a reference flow");
  EXPECT_THROW((void)read_compared("/nowhere/metrics.json"), MetricsError);
}

TEST_F(Comparison, StandsBesideTheValidationAtHand) {
  model::Model model{};
  model.valve = {"valve A", 80 / 60000.0, 2.4e-3, "b"};
  validation::Validation validation;
  validation.runs.emplace_back();
  validation::PooledResult& pooled = validation.pooled.emplace_back();
  pooled.estimator = estimation::Estimator::observer;
  pooled.profiles.assign(4, validation::ErrorProfile(5e5, 80 / 60000.0));
  pooled.metrics = validation::Metrics{};
  pooled.metrics->all.error.p95 = 0.05 * 80 / 60000.0;
  HtmlPage page("kind", "title", "origin");
  show_comparison(page, model, validation, {read(figures)});
  EXPECT_EQ(unbalanced_markup(page.str()), "");
  EXPECT_THAT(page.str(), HasSubstr("valve &lt;B&gt;"));
  EXPECT_THAT(page.str(), HasSubstr("</i>5.00"));
  EXPECT_THAT(page.str(), HasSubstr("</i>3.50"));
  HtmlPage alone("kind", "title", "origin");
  show_comparison(alone, model, validation, {});
  EXPECT_THAT(alone.str(), ::testing::Not(HasSubstr("Side by side")));
}

}  // namespace
}  // namespace spoolflow::report
