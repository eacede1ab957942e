#include "spoolflow/report/figures/svg_figure.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/report/figures/plot_frame.hpp"
#include "tests/report/markup.hpp"

namespace spoolflow::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Figure sine(std::size_t samples) {
  Mark mark{.name = "a <wave>"};
  for (std::size_t k = 0; k < samples; ++k) {
    mark.x.push_back(static_cast<double>(k) * 1e-3);
    mark.y.push_back(std::sin(static_cast<double>(k) * 1e-3));
  }
  Panel panel{.title = "Height [m]"};
  panel.marks.push_back(std::move(mark));
  Figure figure{.description = "A sine \"wave\"", .x_title = "Time [s]"};
  figure.panels.push_back(std::move(panel));
  return figure;
}

TEST(Ticks, AreRoundAndCarryAsManyDecimalsAsTheirStepNeeds) {
  EXPECT_THAT(round_ticks(0, 80, 4).text, ElementsAre("0", "20", "40", "60", "80"));
  EXPECT_THAT(round_ticks(-0.3, 0.31, 4).text, ElementsAre("\u22120.2", "0.0", "0.2"));
  EXPECT_THAT(round_ticks(49.8, 50.2, 2).text, ElementsAre("49.8", "50.0", "50.2"));
  EXPECT_THAT(round_ticks(-28, 29, 2).text, ElementsAre("\u221220", "0", "20"));  // 50 would show 0 alone
  EXPECT_TRUE(round_ticks(1, 1, 4).at.empty());
}

TEST(SvgFigure, IsWellFormedAndEscapesWhatItWasGiven) {
  const std::string svg = svg_of(sine(100), {}, "f1");
  EXPECT_EQ(unbalanced_markup(svg), "");
  EXPECT_THAT(svg, HasSubstr("aria-label=\"A sine &quot;wave&quot;\""));
  EXPECT_THAT(svg, HasSubstr("Time [s]"));
  EXPECT_THAT(svg, HasSubstr("Height [m]"));
  EXPECT_THAT(legend_of(sine(100)), HasSubstr("a &lt;wave&gt;"));
}

TEST(SvgFigure, OfAMillionSamplesIsAsShortAsItsPixelsAndKeepsASpike) {
  Figure figure = sine(1000000);
  figure.panels[0].marks[0].y[123456] = 50;
  const std::string svg = svg_of(figure, {}, "f1");
  EXPECT_LT(svg.size(), 60000U);
  // The spike alone reaches the panel's upper end: 5 % of the range below its top.
  Figure spike = sine(2);
  spike.panels[0].marks[0] = {.x = {0, 123.456, 999.999}, .y = {-1, 50, std::sin(999.999)}};
  const std::string alone = svg_of(spike, {}, "f1");
  const std::size_t path = alone.find("<path class=\"line");
  const std::string top = alone.substr(alone.find('L', path) + 1, 11);  // "x y" of the spike
  EXPECT_THAT(svg, HasSubstr(top.substr(top.find(' '), top.find_first_of("L\"") - top.find(' '))));
}

TEST(SvgFigure, BreaksLinesAndAreasWhereValuesAreMissing) {
  const double nothing = std::nan("");
  Figure figure{.description = "gaps", .x_title = "t"};
  Panel panel{.title = "y"};
  panel.marks.push_back({.x = {0, 1, 2, 3, 4}, .y = {1, 1, nothing, 1, 1}});
  panel.marks.push_back(
      {.shape = Shape::area, .x = {0, 1, 2, 3, 4}, .y = {0, 0, nothing, 0, 0}, .y_upper = {1, 1, nothing, 1, 1}});
  figure.panels.push_back(panel);
  const std::string svg = svg_of(figure, {}, "f");
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  const auto begins = [&](const char* kind) {
    const std::size_t path = svg.find(std::string("<path class=\"") + kind);
    const std::string outline = svg.substr(path, svg.find("/>", path) - path);
    return std::count(outline.begin(), outline.end(), 'M');
  };
  EXPECT_EQ(begins("line"), 2);
  EXPECT_EQ(begins("area"), 2);
}

TEST(SvgFigure, WithoutDataStillHasItsAxes) {
  Figure figure{.description = "empty", .x_title = "t"};
  figure.panels.push_back({.title = "y"});
  figure.panels[0].marks.push_back({.x = {1}, .y = {5}});
  figure.panels.push_back({.title = "nothing"});
  const std::string svg = svg_of(figure, {}, "f");
  EXPECT_EQ(unbalanced_markup(svg), "");
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf\"")));
}

TEST(SvgFigure, LeavesOutALabelThatWouldTouchAnother) {
  Figure figure{.description = "family", .x_title = "t"};
  Panel panel{.title = "y"};
  panel.marks.push_back({.end_label = "upper", .x = {0, 1}, .y = {0, 10}});
  panel.marks.push_back({.end_label = "touching", .x = {0, 1}, .y = {0, 9.9}});
  panel.marks.push_back({.end_label = "lower", .x = {0, 1}, .y = {0, 1}});
  figure.panels.push_back(panel);
  const std::string svg = svg_of(figure, {}, "f");
  EXPECT_THAT(svg, HasSubstr(">upper<"));
  EXPECT_THAT(svg, HasSubstr(">lower<"));
  EXPECT_THAT(svg, Not(HasSubstr(">touching<")));
}

}  // namespace
}  // namespace spoolflow::report
