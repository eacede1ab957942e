/// Quantities in text: they are written in the reader's unit, and nothing else is.
#include "spoolflow/report/text/text.hpp"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "spoolflow/report/text/number_text.hpp"
#include "tests/report/american_units.hpp"

namespace spoolflow::report {
namespace {

TEST(QuantityText, HasAboutAsManyDigitsInEveryUnit) {
  EXPECT_EQ(fixed(units::pressure(60e5), 0).in({}), "60 bar");
  EXPECT_EQ(fixed(units::pressure(60e5), 0).in(american()), "870 psi");
  EXPECT_EQ(fixed(units::pressure(60e5), 0).in(ReaderUnits({"MPa"})), "6.0 MPa");
  EXPECT_EQ(fixed(units::length(-1.2e-3), 2).in(american()), "\u22120.047 in");
  EXPECT_EQ(fixed(units::length(1.2e-3), 2).in(ReaderUnits({"um"})), "1200 \u00b5m");
  EXPECT_EQ(fixed(units::temperature(323.15), 0).in(american()), "122 \u00b0F");
  EXPECT_EQ(three_digits(units::flow(80 * per_L_min)).in({}), "80.0 L/min");
  EXPECT_EQ(three_digits(units::flow(80 * per_L_min)).in(american()), "21.13 gal/min");
  EXPECT_EQ(three_digits(units::force(1e-7)).in(american()), "2.25e-08 lbf");
  EXPECT_EQ(general(units::flow(15 * per_L_min)).in({}), "15 L/min");
  EXPECT_EQ(general(units::flow(15 * per_L_min)).in(american()), "4.0 gal/min");
  EXPECT_EQ(fixed(units::current(2.6), 2).in(american()), "2.60 A");
  EXPECT_EQ(fixed(units::pressure(NAN), 0).in(american()), "\u2013 psi");
}

TEST(QuantityText, IsRoundedOnce) {
  // Written as 5 bar first, both would be 73 psi.
  EXPECT_EQ(fixed(units::pressure(5.04e5), 0).in(ReaderUnits({"psi"})), "73 psi");
  EXPECT_EQ(fixed(units::pressure(5.49e5), 0).in(ReaderUnits({"psi"})), "80 psi");
}

TEST(QuantityText, KeepsItsSign) {
  EXPECT_EQ(bare(signed_fixed(units::flow(10 * per_L_min), 2)).in(american()), "+2.642");
  EXPECT_EQ(bare(signed_fixed(units::flow(-10 * per_L_min), 2)).in(american()), "\u22122.642");
  EXPECT_EQ(bare(signed_fixed(units::flow(0), 2)).in(american()), "0.000");
}

TEST(Text, TurnsItsQuantitiesAndLeavesNamesAlone) {
  const std::string run = "ramp at 60 bar";
  const Text text = phrase("{}: largest at {}, {} open{}", run, fixed(units::pressure(60e5), 0),
                           fixed(units::length(1.2e-3), 2), true ? ", 5 to 70 bar {}" : "");
  EXPECT_EQ(text.str(), "ramp at 60 bar: largest at 60 bar, 1.20 mm open, 5 to 70 bar {}");
  EXPECT_EQ(text.in(american()), "ramp at 60 bar: largest at 870 psi, 0.047 in open, 5 to 70 bar {}");
  EXPECT_EQ(Text(run).in(american()), run);
}

TEST(Text, KeepsWhatItWasMadeFrom) {
  std::optional<std::string> name = "a name long enough to be stored elsewhere";
  const Text text = phrase("{} and {}", std::string_view(*name), phrase("{:.1f} {}", 2.0, name->c_str()));
  name.reset();
  EXPECT_EQ(text.str(), "a name long enough to be stored elsewhere and 2.0 a name long enough to be stored elsewhere");
}

TEST(Text, GrowsAndReportsWhenThereIsNone) {
  Text text;
  EXPECT_TRUE(text.empty());
  text += "at";
  EXPECT_EQ(text.str(), "at");
  text += Text(" ");
  text += fixed(units::pressure(1e5), 1);
  text += phrase(" ({})", unit_text(units::Kind::flow));
  EXPECT_FALSE(text.empty());
  EXPECT_EQ(text.in(american()), "at 15 psi (gal/min)");
}

TEST(Text, WritesARangeWithOneUnit) {
  const Text range = range_text(fixed(units::pressure(5e5), 1), fixed(units::pressure(70e5), 1));
  EXPECT_EQ(range.str(), "5.0 to 70.0 bar");
  EXPECT_EQ(range.in(american()), "73 to 1015 psi");
  EXPECT_EQ(range_text(fixed(units::length(2e-3), 2), fixed(units::length(2.001e-3), 2)).str(), "2.00 mm");
}

}  // namespace
}  // namespace spoolflow::report
