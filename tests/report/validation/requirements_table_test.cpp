#include "spoolflow/report/validation/requirements_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/report/markup.hpp"

namespace spoolflow::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

validation::Validation asked(bool second_met) {
  validation::Limit band{.place = "limits.toml, line 1", .figure = validation::Figure::band_coverage};
  band.unit = validation::LimitUnit::percent;
  band.at_least = 93;
  band.at_most = 99;
  validation::Limit rest{.place = "limits.toml, line 6", .when = validation::When::rest};
  rest.at_most = 5;
  validation::Validation out;
  out.requirements_file = "limits.toml";
  out.limits = {
      {band, "all runs", estimation::Estimator::observer, 95.123, true},
      {rest, "ramp <1>", estimation::Estimator::observer, second_met ? std::optional(4.0) : std::nullopt, second_met}};
  return out;
}

TEST(RequirementsTable, NamesFigureBoundAndVerdict) {
  const validation::Validation validation = asked(true);
  EXPECT_EQ(limit_text(validation.limits[0]).str(), "share of the samples inside the observer's 95 % band: 93 to 99 %");
  EXPECT_EQ(value_text(validation.limits[0]).str(), "95.12 %");
  EXPECT_EQ(limit_text(validation.limits[1]).str(), "95th percentile of the observer's error, at rest: at most 5 % FS");
  EXPECT_EQ(requirements_sentence(validation), "All 2 limits of limits.toml are met.");
  EXPECT_EQ(requirements_sentence(asked(false)), "1 of 2 limits of limits.toml is not met.");
}

TEST(RequirementsTable, ShowsWhatCouldNotBeJudgedAsSuch) {
  HtmlPage page("kind", "title", "origin");
  show_requirements(page, asked(false), asked(false).limits);
  show_limits(page, asked(false).limits);
  EXPECT_EQ(unbalanced_markup(page.str()), "");
  EXPECT_THAT(page.str(), HasSubstr("not judged"));
  EXPECT_THAT(page.str(), HasSubstr("ramp &lt;1&gt;"));
  HtmlPage bare("kind", "title", "origin");
  show_requirements(bare, {}, {});
  show_limits(bare, {});
  EXPECT_THAT(bare.str(), Not(HasSubstr("class=\"requirements\"")));
}

}  // namespace
}  // namespace spoolflow::report
