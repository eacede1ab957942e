/// Drawings in the reader's units.
#include "spoolflow/report/figures/reader_axes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/report/figures/bar_chart.hpp"
#include "spoolflow/report/figures/svg_figure.hpp"
#include "tests/report/american_units.hpp"

namespace spoolflow::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Figure pressures_over_temperature() {
  Figure figure{.description = "Run at 60 bar",
                .x_title = "Oil temperature",
                .x_quantity = units::Kind::temperature,
                .x_lowest = 273.15};
  figure.panels.push_back({.title = "Pressure difference",
                           .quantity = units::Kind::pressure,
                           .title_end = ", closing > 0",
                           .highest = 100e5,
                           .cells = {{273.15, 373.15, 0, 1e5, 0}}});
  figure.panels.front().marks.push_back({.name = "run at 60 bar",
                                         .end_label = fixed(units::length(2.54e-2), 1),
                                         .x = {273.15, 373.15},
                                         .y = {10e5, 20e5}});
  figure.panels.push_back({.title = "Oil at 60 bar", .rows = {{"run at 60 bar", "ink", {{273.15, 373.15, 1}}}}});
  return figure;
}

TEST(ReaderAxes, TurnWhateverTheirQuantityIsOf) {
  const Figure shown = in_units(pressures_over_temperature(), ReaderUnits({"psi", "F", "in"}));
  EXPECT_EQ(shown.x_title.str(), "Oil temperature [\u00b0F]");
  EXPECT_NEAR(*shown.x_lowest, 32, 1e-9);
  const Panel& panel = shown.panels.front();
  EXPECT_EQ(panel.title.str(), "Pressure difference [psi], closing > 0");
  EXPECT_NEAR(*panel.highest, 1450.4, 0.1);
  EXPECT_NEAR(panel.cells.front().x_to, 212, 1e-9);
  EXPECT_NEAR(panel.cells.front().y_to, 14.504, 1e-3);
  EXPECT_NEAR(panel.marks.front().x[1], 212, 1e-9);
  EXPECT_NEAR(panel.marks.front().y[0], 145.04, 0.01);
  EXPECT_EQ(panel.marks.front().end_label.str(), "1.00 in");
  EXPECT_NEAR(shown.panels.back().rows.front().spans.front().to, 212, 1e-9);
}

TEST(ReaderAxes, LeaveNamesAndAxesWithoutAQuantityAlone) {
  const ReaderUnits american({"psi", "F", "in"});
  const std::string drawing = svg_of(pressures_over_temperature(), {}, "f", american);
  EXPECT_THAT(drawing, HasSubstr("Run at 60 bar"));
  EXPECT_THAT(drawing, HasSubstr(">Oil at 60 bar<"));
  EXPECT_THAT(drawing, HasSubstr(">run at 60 bar<"));
  EXPECT_THAT(drawing, Not(HasSubstr("at 870")));
  EXPECT_THAT(legend_of(pressures_over_temperature(), american), HasSubstr("run at 60 bar"));
}

TEST(ReaderAxes, AreTheUsualOnesUntilOthersAreAskedFor) {
  const Figure shown = in_units(pressures_over_temperature(), {});
  EXPECT_EQ(shown.panels.front().title.str(), "Pressure difference [bar], closing > 0");
  EXPECT_EQ(*shown.panels.front().highest, 100);
  EXPECT_EQ(shown.panels.front().marks.front().y[1], 20);
  const Figure again = in_units(shown, ReaderUnits({"psi"}));
  EXPECT_EQ(again.panels.front().title.str(), "Pressure difference [bar], closing > 0") << "turned once, not twice";
  EXPECT_EQ(*again.panels.front().highest, 100);
}

TEST(ReaderAxes, TurnTheLengthsOfBars) {
  BarChart chart{.description = "", .axis = "Contribution", .quantity = units::Kind::flow, .bars = {}};
  const double gallon_m3_per_s = 3.785411784 * per_L_min;
  chart.bars.push_back({.name = "friction at 60 bar",
                        .tone = "ink",
                        .solid = {gallon_m3_per_s, 0.0, 2 * gallon_m3_per_s},
                        .pale = Bar::Length{3 * gallon_m3_per_s},
                        .text = bare(three_digits(units::flow(gallon_m3_per_s)))});
  const BarChart shown = in_units(chart, ReaderUnits({"gal/min", "psi"}));
  EXPECT_EQ(shown.axis, "Contribution [gal/min]");
  EXPECT_NEAR(shown.bars.front().solid.value, 1, 1e-12);
  EXPECT_NEAR(*shown.bars.front().solid.upper, 2, 1e-12);
  EXPECT_NEAR(shown.bars.front().pale->value, 3, 1e-12);
  EXPECT_EQ(shown.bars.front().text.str(), "1.000");
  EXPECT_EQ(shown.bars.front().name, "friction at 60 bar");
}

}  // namespace
}  // namespace spoolflow::report
