/// What a machine knows of its oil, as a user writes it.
#include "spoolflow/recording/references.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using testing::HasSubstr;

std::vector<Reference> references_from(const std::string& text, const std::string& marks = {}) {
  const TemporaryFile file("references.toml", text);
  if (!marks.empty()) std::ofstream(file.folder() / "marks.csv") << marks;
  return read_references(file.path());
}

std::string refused_reference(const std::string& text, const std::string& marks = {}) {
  return refusal([&] { (void)references_from(text, marks); });
}

const std::string stroke =
    "[[reference]]\nkind = \"stroke\"\nname = \"boom\"\nends = \"marks\"\nmarks = \"marks.csv\"\n";

TEST(References, AStrokeIsAreaTimesLengthWithWhatIsUnknownOfBoth) {
  const std::vector<Reference> read = references_from(stroke +
                                                          "area_cm2 = 40\nlength_mm = 650\nseal_leakage_L_min = "
                                                          "0.6\noil_column_cm3 = 1400\nhighest_pressure_bar = 100\n",
                                                      "begin_s,end_s\n1.0,3.5\n# a pause\n4 ; 6\n");
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].name, "boom");
  EXPECT_NEAR(read[0].area_m2 * read[0].length_m, 2.6e-3, 1e-12);
  EXPECT_NEAR(read[0].share_uncertainty, 0.005, 1e-12);
  EXPECT_NEAR(read[0].leakage_uncertainty_m3_per_s, 1e-5, 1e-12);
  EXPECT_NEAR(read[0].compression_m3, 1e-5, 1e-12);  // 100 bar of 1.4 GPa
  ASSERT_EQ(read[0].marks.size(), 2U);
  EXPECT_EQ(read[0].marks[1].end_s, 6);
}

TEST(References, APumpsSpeedStandsInTheFileOrBesideEachMark) {
  const std::string pump = "[[reference]]\nkind = \"pump\"\nmarks = \"marks.csv\"\ndisplacement_cm3 = 20\n";
  const std::vector<Reference> read = references_from(pump, "begin_s,end_s,speed_rpm\n0,10,1500\n");
  EXPECT_EQ(read[0].name, "pump 1");
  EXPECT_NEAR(read[0].displacement_m3_per_rad * read[0].marks[0].speed_rad_per_s, 500e-6, 1e-12);  // 30 L/min
  EXPECT_THAT(refused_reference(pump, "begin_s,end_s\n0,10\n"), HasSubstr("speed_rpm"));
}

TEST(References, MarksAreReadAsASpreadsheetOfTheUserWritesThem) {
  const std::string figures = "area_cm2 = 40\nlength_mm = 650\n";
  for (const std::string marks :
       {"\xEF\xBB\xBF"
        "begin_s,end_s\r\n1.5,7.25\r\n",
        "\"begin_s\",\"end_s\"\n1.5,\"7.25\"\n", "begin_s;end_s\n1,5;7,25\n", "begin_s\tend_s\n1,5\t7,25\n"}) {
    const std::vector<Reference> read = references_from(stroke + figures, marks);
    ASSERT_EQ(read[0].marks.size(), 1U) << marks;
    EXPECT_EQ(read[0].marks[0].begin_s, 1.5) << marks;
    EXPECT_EQ(read[0].marks[0].end_s, 7.25) << marks;
    EXPECT_TRUE(std::isnan(read[0].marks[0].speed_rad_per_s)) << marks;
  }
}

TEST(References, NoNumberOfAMarkIsTakenForAnother) {
  const std::string pump =
      "[[reference]]\nkind = \"pump\"\nmarks = \"marks.csv\"\ndisplacement_cm3 = 20\nspeed_rpm = 1000\n";
  EXPECT_THAT(
      refused_reference(pump, "begin_s,speed_rpm,end_s\n1,1500,9\n"),
      HasSubstr("marks.csv, line 1: \"begin_s,speed_rpm,end_s\" names no columns of marks; write begin_s,end_s"));
  EXPECT_THAT(
      refused_reference(pump, "begin_s,end_s\n1,7,855\n"),
      HasSubstr("line 2: has 3 numbers for the columns begin_s, end_s; write one number a column, and a decimal "
                "comma with semicolons"));
  EXPECT_THAT(
      refused_reference(pump, "begin_s,end_s,speed_rpm\n1,9,1500\n10,19,-1500\n"),
      HasSubstr("line 3: speed_rpm = -1500 is not between 1 and 100000; give the pump's speed in turns a minute"));
  EXPECT_THAT(refused_reference(pump, "begin_s,end_s,speed_rpm\n1,9,0\n"), HasSubstr("speed_rpm = 0"));
}

TEST(References, MetersAndTheClosedValveNeedNoMarks) {
  const std::vector<Reference> read = references_from(
      "[[reference]]\nkind = \"meter\"\nuncertainty_percent = 0.5\n[[reference]]\nkind = \"closed\"\nrecording = "
      "\"start.csv\"\n");
  EXPECT_EQ(read[0].kind, ReferenceKind::meter);
  EXPECT_EQ(read[0].interval_s, 2);
  EXPECT_EQ(read[1].recording, "start.csv");
}

TEST(References, WhatIsWrongIsNamedWithItsLineAndWhatIsAllowed) {
  EXPECT_THAT(refused_reference("[[reference]]\nkind = \"strok\"\n"), HasSubstr("stroke"));
  EXPECT_THAT(refused_reference("title = \"none\"\n"), HasSubstr("title"));
  EXPECT_THAT(refused_reference(stroke + "length_mm = 650\n", "begin_s,end_s\n1,2\n"), HasSubstr("area_cm2"));
  EXPECT_THAT(refused_reference(stroke + "area_cm2 = -40\nlength_mm = 650\n", "begin_s,end_s\n1,2\n"),
              HasSubstr("line 6"));
  EXPECT_THAT(
      refused_reference("[[reference]]\nkind = \"meter\"\nuncertainty_percent = 0.01\n"),
      HasSubstr("uncertainty_percent = 0.01 is not between 0.05 and 20; give the half width at 95 % in percent"));
  EXPECT_THAT(refused_reference(stroke + "area_cm2 = 40\nlength_mm = 0.65\n", "begin_s,end_s\n1,2\n"),
              HasSubstr("length_mm = 0.65 is not between 5 and 20000"));
  EXPECT_THAT(refused_reference(stroke + "area_cm2 = 40\nlength_mm = 650\nlength_uncertainty_mm = 131\n",
                                "begin_s,end_s\n1,2\n"),
              HasSubstr("= 131 is not between 0 and 130; give the half width at 95 % in mm"));
  EXPECT_THAT(refused_reference(stroke + "area_cm2 = 40\nlength_mm = 650\n", "begin_s,end_s\n1,3\n2,4\n"),
              HasSubstr("line 3"));
  EXPECT_THAT(refused_reference(stroke + "area_cm2 = 40\nlength_mm = 650\n", "begin_s,end_s\n1,two\n"),
              HasSubstr("two"));
  EXPECT_THAT(refused_reference(stroke + "area_cm2 = 40\nlength_mm = 650\n"), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace spoolflow::recording
