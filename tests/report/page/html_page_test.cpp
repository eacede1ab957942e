/// Pages and tables in the reader's units.
#include "spoolflow/report/page/html_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/report/american_units.hpp"
#include "tests/report/markup.hpp"

namespace spoolflow::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using units::Kind;

HtmlTable flows() {
  HtmlTable table({{"run", Set::text},
                   {"flow", Set::number, Kind::flow},
                   {"pressure<br>difference", Set::number, Kind::pressure},
                   {"error", Set::number, Kind::flow, "% FS"},
                   {"range"},
                   {"share<br>[%]"}});
  const units::Quantity ten_gallons = units::flow(37.85411784 / 60000);
  table.row({"ramp at 60 bar", fixed(ten_gallons, 2), fixed(units::pressure(60e5), 0),
             phrase("{} / {}", bare(signed_fixed(ten_gallons, 2)), "+4.7"),
             range_text(fixed(units::length(0), 2), fixed(units::length(2.54e-3), 2)), "12"});
  return table;
}

TEST(HtmlTable, HeadingsStateTheUnitAndCellsDoNot) {
  const std::string usual = flows().str();
  for (const char* part : {">flow<br>[L/min]<", ">pressure<br>difference [bar]<", ">error<br>[L/min /<br>% FS]<",
                           ">37.85<", ">60<", ">+37.85 / +4.7<", ">0.00 to 2.54 mm<", ">share<br>[%]<"}) {
    EXPECT_THAT(usual, HasSubstr(part));
  }
  EXPECT_EQ(unbalanced_markup(usual), "");
}

TEST(HtmlTable, TurnsColumnsAndLeavesNamesAlone) {
  const std::string shown = flows().str(american());
  for (const char* part :
       {">flow<br>[gal/min]<", ">pressure<br>difference [psi]<", ">error<br>[gal/min /<br>% FS]<", ">10.000<", ">870<",
        ">+10.000 / +4.7<", ">0.000 to 0.100 in<", ">ramp at 60 bar<", ">12<"}) {
    EXPECT_THAT(shown, HasSubstr(part));
  }
}

TEST(HtmlTable, StatesTheUnitOfAQuantityThatItsColumnDoesNotState) {
  HtmlTable table({{"flow", Set::number, Kind::flow}, {"any"}});
  table.row({fixed(units::pressure(1e5), 1), fixed(units::flow(0), 1)});
  EXPECT_THAT(table.str(), HasSubstr("<td>1.0 bar</td><td>0.0 L/min</td>"));
}

TEST(HtmlPage, TurnsQuantitiesInWhateverItTakesIn) {
  HtmlPage page("kind", "title", "origin", american());
  const QuantityText sixty_bar = fixed(units::pressure(60e5), 0);
  page.paragraph(phrase("paragraph {}", sixty_bar));
  page.note(phrase("note {}", sixty_bar));
  page.subsection(phrase("subsection {}", sixty_bar));
  Figure figure{.description = "d", .x_title = "Time", .x_quantity = Kind::time};
  figure.panels.push_back({.title = "Position", .quantity = Kind::length});
  figure.panels.front().marks.push_back({.name = phrase("name {}", sixty_bar), .x = {0, 1}, .y = {0, 2.54e-2}});
  page.figure({figure, phrase("caption {}", sixty_bar)});
  BarChart bars{.description = "d", .axis = "Force", .quantity = Kind::force, .bars = {}};
  bars.bars.push_back({.name = "bar", .tone = "ink", .solid = {1}, .text = three_digits(units::force(4.4482216))});
  page.chart({bars, phrase("chart {}", sixty_bar)});
  page.table(flows());
  const std::string html = page.str();
  for (const char* part : {"paragraph 870 psi", "note 870 psi", "subsection 870 psi", "name 870 psi", "caption 870 psi",
                           "chart 870 psi", "Time [s]", "Position [in]", "Force [lbf]", "1.000 lbf", "[gal/min]"}) {
    EXPECT_THAT(html, HasSubstr(part));
  }
  EXPECT_EQ(unbalanced_markup(html), "");
  EXPECT_THAT(html, HasSubstr("<html lang=\"en\" data-flow-unit=\"2\" data-pressure-unit=\"2\""));
}

TEST(HtmlPage, NeverChangesNames) {
  const std::string run = "ramp at 60 bar";
  HtmlPage page("kind", run, "origin", american());
  page.section("Run " + run);
  page.subsection(run);
  page.paragraph(phrase("{} at {}", run, fixed(units::pressure(60e5), 0)));
  page.html("<p>" + run + "</p>");
  const std::string html = page.str();
  EXPECT_THAT(html, HasSubstr(">Run ramp at 60 bar</h2>"));
  EXPECT_THAT(html, HasSubstr("<h3>ramp at 60 bar</h3>"));
  EXPECT_THAT(html, HasSubstr("<p>ramp at 60 bar at 870 psi</p>"));
  EXPECT_THAT(html, HasSubstr("<p>ramp at 60 bar</p>"));
  EXPECT_THAT(html, Not(HasSubstr("ramp at 870")));
}

TEST(HtmlPage, PutsTheSectionsOfAPartBelowItsHeading) {
  HtmlPage page("kind", "title", "origin");
  page.part("Flow P to B");
  page.section("Maps");
  page.part("Flow P to A");
  page.section("Maps");
  page.end_part();
  page.section("Files");
  const std::string html = page.str();
  EXPECT_THAT(html, HasSubstr("<h3>Maps</h3>"));
  EXPECT_THAT(html, HasSubstr(">Flow P to A</h2>"));
  EXPECT_THAT(html, HasSubstr(">Files</h2>"));
  EXPECT_THAT(html, Not(HasSubstr(">Maps</a>"))) << "the contents name the part";
}

}  // namespace
}  // namespace spoolflow::report
