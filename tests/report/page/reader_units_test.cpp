/// The reader's units, put in where a page takes in its text, tables and figures.
#include "spoolflow/report/page/reader_units.hpp"

#include <gtest/gtest.h>

#include "spoolflow/report/page/html_page.hpp"

namespace spoolflow::report {
namespace {

const ReaderUnits& american() {
  static const ReaderUnits units({"gal/min", "psi", "in", "F", "lbf"});
  return units;
}

TEST(ReaderUnits, TurnEveryNumberBeforeAUnit) {
  EXPECT_EQ(american().markup("<p>at 60 bar and 37.85 L/min</p>"), "<p>at 870 psi and 9.999 gal/min</p>");
  EXPECT_EQ(american().markup("5 to 70 bar, 30, 50 and 70 bar"), "73 to 1015 psi, 435, 725 and 1015 psi");
  EXPECT_EQ(american().markup("\u22121.20 mm at 50 \u00b0C"), "\u22120.047 in at 122 \u00b0F");
  EXPECT_EQ(ReaderUnits({"MPa"}).markup("60 bar"), "6.0 MPa");
  EXPECT_EQ(ReaderUnits({"m3/h"}).markup("10 L/min"), "0.6 m\u00b3/h");
}

TEST(ReaderUnits, LeaveOtherUnitsScriptsAndTagsAlone) {
  const std::string other =
      "<script>var a = \"60 bar\";</script><p title=\"60 bar\">46 mm\u00b2/s, 3 N/bar, 2 bars, ramp_60bar, 20 ms, "
      "0.5 L/min/bar, Figure 3. bar</p><style>i{width:5 mm}</style>";
  EXPECT_EQ(american().markup(other), other);
  const std::string made = "<p>at 60 bar</p>";
  EXPECT_EQ(ReaderUnits().markup(made), made);
}

TEST(ReaderUnits, TurnColumnsThatTellTheirUnitInBrackets) {
  HtmlTable table({{"run", Set::text}, {"flow<br>[L/min]"}, {"error<br>[L/min / % FS]"}, {"share<br>[%]"}});
  table.row({"ramp_60bar", "<i style=\"width:90px\"></i>37.85", "+3.785 / +4.7", "12"});
  table.row({"other", "10.00 to 20.00", "\u2013", "3"});
  const std::string shown = american().of(table).str();
  EXPECT_NE(shown.find("flow<br>[gal/min]"), std::string::npos);
  EXPECT_NE(shown.find("error<br>[gal/min /<br>% FS]"), std::string::npos);
  EXPECT_NE(shown.find("<i style=\"width:90px\"></i>9.999"), std::string::npos);
  EXPECT_NE(shown.find("+0.9999 / +4.7"), std::string::npos);
  EXPECT_NE(shown.find("2.642 to 5.283"), std::string::npos);
  EXPECT_NE(shown.find("ramp_60bar"), std::string::npos);
}

TEST(ReaderUnits, TurnTheAxesOfFigures) {
  Figure figure{.description = "", .x_title = "Oil temperature [\u00b0C]", .x_lowest = 0};
  figure.panels.push_back({.title = "Pressure difference [bar]", .highest = 100});
  figure.panels.front().marks.push_back({.x = {0, 100}, .y = {10, 20}});
  figure.panels.front().rows.push_back({"run", "ink", {{0, 100, 1}}});
  const Figure shown = american().of(figure);
  EXPECT_NEAR(shown.panels.front().rows.front().spans.front().to, 212, 1e-9);
  EXPECT_EQ(shown.x_title, "Oil temperature [\u00b0F]");
  EXPECT_EQ(*shown.x_lowest, 32);
  EXPECT_EQ(shown.panels.front().title, "Pressure difference [psi]");
  EXPECT_NEAR(*shown.panels.front().highest, 1450.4, 0.1);
  EXPECT_NEAR(shown.panels.front().marks.front().x[1], 212, 1e-9);
  EXPECT_NEAR(shown.panels.front().marks.front().y[0], 145.04, 0.01);
  BarChart chart{.description = "", .axis = "Contribution [L/min]", .bars = {}};
  chart.bars.push_back({.name = "friction", .tone = "ink", .solid = {3.785411784}, .text = "3.79"});
  const BarChart bars = american().of(chart);
  EXPECT_NEAR(bars.bars.front().solid.value, 1, 1e-12);
  EXPECT_EQ(bars.bars.front().text, "1.001") << "of the rounded text";
}

TEST(ReaderUnits, RefuseWhatTheyDoNotKnow) {
  EXPECT_THROW(ReaderUnits({"furlong"}), UnknownUnit);
  EXPECT_THROW(ReaderUnits({"bar", "psi"}), UnknownUnit);
  EXPECT_THROW(ReaderUnits({""}), UnknownUnit);
  EXPECT_EQ(ReaderUnits({"bar"}).attributes(), "");
  EXPECT_EQ(ReaderUnits({"psi", "in"}).attributes(), " data-pressure-unit=\"2\" data-position-unit=\"2\"");
}

TEST(ReaderUnits, ReachAllThatAPageTakesIn) {
  HtmlPage page("kind", "title", "origin", american());
  page.paragraph("10 bar");
  page.note("20 bar");
  page.html("<b>30 bar</b>");
  page.subsection("40 bar");
  Figure figure{.description = "d", .x_title = "Time [s]"};
  figure.panels.push_back({.title = "Position [mm]"});
  figure.panels.front().marks.push_back({.name = "at 50 bar", .x = {0, 1}, .y = {0, 25.4}});
  page.figure({figure, "60 bar"});
  const std::string html = page.str();
  const std::string body = html.substr(html.find("</header>"), html.find("<script>") - html.find("</header>"));
  EXPECT_EQ(body.find(" bar"), std::string::npos);
  EXPECT_EQ(body.find("[mm]"), std::string::npos);
  EXPECT_NE(body.find("at 725 psi"), std::string::npos);
  EXPECT_NE(html.find("<html lang=\"en\" data-flow-unit=\"2\" data-pressure-unit=\"2\""), std::string::npos);
}

}  // namespace
}  // namespace spoolflow::report
