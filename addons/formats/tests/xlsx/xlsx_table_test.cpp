/// Excel workbooks made by hand, read as any recording is: by the child in a sandbox.
#include "addons/formats/xlsx/xlsx_table.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/formats/tests/xlsx/xlsx_file.hpp"
#include "addons/formats/tests/xlsx/xlsx_reading.hpp"
#include "spoolflow/recording/inspection.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::NanSensitiveDoubleEq;

TEST(XlsxTable, ReadsNamesAndNumbersOfASheet) {
  const std::string bytes = xlsx_book(name_row + xlsx_row({"0", "0.5", "1.25E-1"}) + xlsx_row({"0.001", "-6", "1e3"}));
  EXPECT_THAT(xlsx_names(bytes), ElementsAre("time_s|", "current_A|", "position_mm|"));
  EXPECT_THAT(xlsx_column(bytes, "time_s"), ElementsAre(0, 0.001));
  EXPECT_THAT(xlsx_column(bytes, "current_A"), ElementsAre(0.5, -6));
  EXPECT_THAT(xlsx_column(bytes, "position_mm"), ElementsAre(0.125, 1000));
}

TEST(XlsxTable, ReadsPartsThatAreDeflatedOrStored) {
  XlsxFile file;
  file.sheet("Sheet1", name_row + xlsx_row({"0", "1", "2"})).packed({.deflated = false});
  EXPECT_THAT(xlsx_column(file.content(), "current_A"), ElementsAre(1));
}

TEST(XlsxTable, TakesUnitsFromBracketsOrFromARowBelowTheNames) {
  EXPECT_THAT(xlsx_names(xlsx_book(xlsx_row({"'time [ms]", "'current [mA]"}) + xlsx_row({"0", "1"}))),
              ElementsAre("time [ms]|", "current [mA]|"));
  const std::string below =
      xlsx_row({"'time", "'current", "'note"}) + xlsx_row({"'ms", "'[mA]"}) + xlsx_row({"0", "1"});
  EXPECT_THAT(xlsx_names(xlsx_book(below)), ElementsAre("time|ms", "current|[mA]", "note|"));
  const TemporaryFile file(
      "run.xlsx", xlsx_book(xlsx_row({"'time [ms]", "'current [mA]"}) + xlsx_row({"0", "1"}) + xlsx_row({"1", "250"})));
  const Recording run =
      read_recording(file.path(), {.channels = {}, .required = {Channel::current}, .optional = {}, .stroke_m = {}});
  EXPECT_THAT(run[Channel::time], ElementsAre(0, DoubleNear(1e-3, 1e-15)));
  EXPECT_THAT(run[Channel::current], ElementsAre(DoubleNear(1e-3, 1e-15), DoubleNear(0.25, 1e-12)));
}

TEST(XlsxTable, PassesOverATitleAboveTheNamesAndOverWhatHasNoName) {
  const std::string title = xlsx_row({"'Valve A 17"}) + xlsx_row({"'Operator", "'Smith", "'Hall 3"}) +
                            xlsx_row({"'Pressures", "50", "60"}) + "<row/>";
  const std::string bytes =
      xlsx_book(title + name_row + xlsx_row({"0", "1", "2", "99"}) + xlsx_row({"1", "3", "4", "98"}));
  EXPECT_THAT(xlsx_names(bytes), ElementsAre("time_s|", "current_A|", "position_mm|"));
  EXPECT_THAT(xlsx_column(bytes, "position_mm"), ElementsAre(2, 4));
}

TEST(XlsxTable, ATableMayBeginWithARowThatHasOnlyItsTime) {
  const std::string bytes = xlsx_book(name_row + xlsx_row({"0"}) + xlsx_row({"1", "3", "4"}));
  EXPECT_THAT(xlsx_column(bytes, "current_A"), ElementsAre(NanSensitiveDoubleEq(NAN), 3));
}

TEST(XlsxTable, ReadsSharedTextsWithTheirRunsAndWithoutHowTheyAreRead) {
  const std::string names_by_number = R"(<row r="3"><c r="B3" t="s"><v>1</v></c><c r="D3" t="s"><v>0</v></c></row>)";
  const std::string rows = names_by_number + R"(<row r="4"><c r="B4"><v>0</v></c><c r="D4"><v>5</v></c></row>)";
  XlsxFile file;
  file.sheet("Sheet1", rows)
      .texts_part(
          "<si><r><rPr><b/></rPr><t>curr</t></r><r><t>ent_A</t></r><rPh><t>nonsense</t></rPh></si><si><t>time_s</t></"
          "si>");
  EXPECT_THAT(xlsx_names(file.content()), ElementsAre("time_s|", "current_A|"));
  EXPECT_THAT(xlsx_column(file.content(), "current_A"), ElementsAre(5));
}

TEST(XlsxTable, EmptyCellsAndErrorsAreMissingAndBooleansNumbers) {
  const std::string rows = name_row + xlsx_row({"0", "", R"(<c t="b"><v>1</v></c>)"}) + "<row/>" +
                           xlsx_row({"1", R"(<c t="e"><v>#DIV/0!</v></c>)", R"(<c t="b"><v>0</v></c>)"}) +
                           xlsx_row({"2", "'n/a", "7"}) +
                           R"(<row r="9"><c r="A9"><v>3</v></c><c r="C9"><v>8</v></c></row>)";
  const std::string bytes = xlsx_book(rows);
  EXPECT_THAT(xlsx_column(bytes, "time_s"), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(xlsx_column(bytes, "position_mm"), ElementsAre(1, 0, 7, 8));
  for (const double value : xlsx_column(bytes, "current_A")) EXPECT_TRUE(std::isnan(value));
}

TEST(XlsxTable, ReadsWhatFormulasGaveAndNumbersThatAreWrittenAsText) {
  const std::string rows = name_row + xlsx_row({"0", "<c><f>A1*2</f><v>2.5</v></c>", "'0.75"}) +
                           xlsx_row({"1", R"(<c t="str"><f>T(1)</f><v>3.5</v></c>)", "' 1.5 "});
  EXPECT_THAT(xlsx_column(xlsx_book(rows), "current_A"), ElementsAre(2.5, 3.5));
  EXPECT_THAT(xlsx_column(xlsx_book(rows), "position_mm"), ElementsAre(0.75, 1.5));
}

TEST(XlsxTable, RefusesAFormulaWithoutItsResultByItsCell) {
  const std::string rows = name_row + xlsx_row({"0", "1", "2"}) + xlsx_row({"1", "<c><f>B2+1</f></c>", "2"});
  EXPECT_THAT(xlsx_refused(xlsx_book(rows)),
              HasSubstr("run.xlsx, 'Sheet1'!B3: is a formula whose result the file does not hold"));
  EXPECT_THAT(xlsx_column(xlsx_book(rows), "position_mm"), ElementsAre(2, 2));  // of a column that is asked for alone
}

TEST(XlsxTable, RefusesTextAmongNumbersByItsCellButInspectsTheFile) {
  const std::string rows =
      name_row + xlsx_row({"0", "1", "2"}) + xlsx_row({"1", "2", "'0,75?"}) + xlsx_row({"2", "3", "1"});
  EXPECT_THAT(xlsx_refused(xlsx_book(rows)), HasSubstr("'Sheet1'!C3: '0,75?' is not a number; correct it"));
  const TemporaryFile file("run.xlsx", xlsx_book(rows));
  EXPECT_EQ(open_sample_table(file.path(), CsvTable::Text::counted).table->columns().size(), 3U);
  const auto table = open_sample_table(file.path(), CsvTable::Text::counted).table;
  table->select({2});
  std::vector<double> values(8);
  double* const out[1]{values.data()};
  ASSERT_EQ(table->read(out, 8), 3U);
  EXPECT_TRUE(std::isnan(values[1]));
}

TEST(XlsxTable, ColumnsOfTextAreNamedWhereAChannelIsMissing) {
  const std::string rows = xlsx_row({"'time_s", "'position_mm", "'current_A"}) + xlsx_row({"0", "1", "'low"});
  const TemporaryFile file("run.xlsx", xlsx_book(rows));
  EXPECT_THAT(xlsx_names(xlsx_book(rows)), ElementsAre("time_s|", "position_mm|"));
  EXPECT_THAT(refusal([&] {
                (void)read_recording(file.path(),
                                     {.channels = {}, .required = {Channel::current}, .optional = {}, .stroke_m = {}});
              }),
              HasSubstr("column 'current_A' holds text, which is not read"));
}

/// Quarter of a second apart, about noon of 2026-11-23.
std::string xlsx_dates(double first_day) {
  std::string out = xlsx_row({"'clock", "'current_A"});
  for (int k = 0; k < 3; ++k) {
    out += fmt::format(R"(<row><c s="1"><v>{:.17g}</v></c><c><v>{}</v></c></row>)", first_day + k * 0.25 / 86400, k);
  }
  return out;
}

TEST(XlsxTable, DatesAreSecondsFromTheFirstOneInEitherSystem) {
  XlsxFile since_1900, since_1904;
  since_1900.sheet("Sheet1", xlsx_dates(46349.5)).formats({"yyyy\\-mm\\-dd hh:mm:ss.000"});
  since_1904.sheet("Sheet1", xlsx_dates(46349.5 - 1462)).formats({"[h]:mm:ss"}).from_1904();
  for (const XlsxFile& file : {since_1900, since_1904}) {
    EXPECT_THAT(xlsx_column(file.content(), "clock"), ElementsAre(0, 0.25, 0.5));
    EXPECT_THAT(xlsx_names(file.content()), ElementsAre("clock|s", "current_A|"));
  }
}

TEST(XlsxTable, DatesAsNumbersAndAsTextOfIsoAreOneClock) {
  for (const bool of_1904 : {false, true}) {
    const std::string rows =
        xlsx_row({"'clock", "'current_A"}) +
        fmt::format(R"(<row><c s="1"><v>{}</v></c><c><v>1</v></c></row>)", of_1904 ? 44887.5 : 46349.5) +
        R"(<row><c t="d"><v>2026-11-23T12:00:01.500</v></c><c><v>2</v></c></row>)";
    XlsxFile file;
    file.sheet("Sheet1", rows).formats({"d/m/yy h:mm"});
    if (of_1904) file.from_1904();
    EXPECT_THAT(xlsx_column(file.content(), "clock"), ElementsAre(0, 1.5)) << of_1904;
  }
}

TEST(XlsxTable, RefusesDatesAmongNumbers) {
  const std::string rows = name_row + xlsx_row({"0", "1", "2"}) + xlsx_row({R"(<c s="1"><v>46349</v></c>)", "1", "2"});
  XlsxFile file;
  file.sheet("Sheet1", rows).formats({"dd.mm.yyyy"});
  EXPECT_THAT(xlsx_refused(file.content()),
              HasSubstr("'Sheet1'!A3: is a date or time, where the cells above are numbers"));
}

TEST(XlsxTable, RemarksBesideTheSamplesHideNoTable) {
  const std::string names = xlsx_row({"'time_s", "'current_A", "'state"});
  for (const auto& [first, second] : {std::pair{"'run", "'run"}, std::pair{"'begin", ""}, std::pair{"", "'stop"}}) {
    const std::string bytes =
        xlsx_book(names + xlsx_row({"0", "1", first}) + xlsx_row({"1", "2", second}) + xlsx_row({"2", "3", "'end"}));
    EXPECT_THAT(xlsx_column(bytes, "current_A"), ElementsAre(1, 2, 3)) << first << second;
  }
}

TEST(XlsxTable, NamesTheSheetsThatAreHidden) {
  XlsxFile file;
  file.sheet("Data", name_row + xlsx_row({"0", "1", "2"}), " state=\"hidden\"").sheet("Notes", xlsx_row({"'none"}));
  EXPECT_THAT(xlsx_refused(file.content()),
              HasSubstr("(looked at 'Notes'; 'Data' is hidden and not read, show it in the program for sheets)"));
}

TEST(XlsxTable, ReadsTheFirstVisibleSheetThatHoldsATable) {
  XlsxFile file;
  const auto table = [](const std::string& value) { return name_row + xlsx_row({"0", value, "0"}); };
  file.sheet("About", xlsx_row({"'Recorded by", "'the rig"}) + xlsx_row({"'Samples", "3"}));
  file.sheet("Old", table("1"), " state=\"hidden\"").sheet("Monday", table("2")).sheet("Tuesday", table("3"));
  EXPECT_THAT(xlsx_column(file.content(), "current_A"), ElementsAre(2));
  const TemporaryFile written("run.xlsx", file.content());
  EXPECT_THAT(contents_of(written.path()).unread,
              ElementsAre(HasSubstr("of its 3 sheets 'Monday' is read, the first one with a table of 100 samples")));
}

TEST(XlsxTable, ATableOfResultsBeforeTheRecordingIsNotTakenForIt) {
  std::string recording = name_row;
  for (int k = 0; k < 120; ++k) recording += xlsx_row({std::to_string(0.001 * k), "1.5", "0.2"});
  XlsxFile file;
  file.sheet("Results", xlsx_row({"'Run", "'Flow", "'Pressure"}) + xlsx_row({"1", "20", "50"}));
  file.sheet("Monday", recording).sheet("Tuesday", recording);
  const TemporaryFile written("run.xlsx", file.content());
  EXPECT_THAT(contents_of(written.path()).names(), ElementsAre("time_s", "current_A", "position_mm"));
}

TEST(XlsxTable, NumbersAsTextMayHaveADecimalComma) {
  const std::string commas = xlsx_row({"'0,000", "'1,5", "'0,125"}) + xlsx_row({"'0,001", "2", "'-1,25e-1"});
  EXPECT_THAT(xlsx_column(xlsx_book(name_row + commas), "current_A"), ElementsAre(1.5, 2));
  EXPECT_THAT(xlsx_column(xlsx_book(name_row + commas), "position_mm"), ElementsAre(0.125, -0.125));
  EXPECT_THAT(xlsx_column(xlsx_book(name_row + commas), "time_s"), ElementsAre(0, 0.001));
  const std::string later = xlsx_row({"0", "'1,234", "0"}) + xlsx_row({"1", "'1,23", "0"});
  EXPECT_THAT(xlsx_column(xlsx_book(name_row + later), "current_A"), ElementsAre(1.234, 1.23));
}

TEST(XlsxTable, ACommaThatMayGroupThousandsIsRefused) {
  const auto refused = [](const std::string& rows) {
    return refusal([&] { (void)xlsx_column(xlsx_book(name_row + rows), "current_A"); });
  };
  EXPECT_THAT(refused(xlsx_row({"0", "'1,234", "0"}) + xlsx_row({"1", "'2,500", "0"})),
              HasSubstr("'Sheet1'!B2: '1,234' is text that may be 1.234 or 1234; write numbers"));
  EXPECT_THAT(refused(xlsx_row({"0", "'1,5", "0"}) + xlsx_row({"1", "'2.5", "0"})),
              HasSubstr("'Sheet1'!B3: '2.5' has a decimal point, where text above has a decimal comma"));
  EXPECT_THAT(refused(xlsx_row({"0", "'1.5", "0"}) + xlsx_row({"1", "'1.234,5", "0"})),
              HasSubstr("'Sheet1'!B3: '1.234,5' is not a number"));
}

TEST(XlsxTable, NamedColumnsWithoutNumbersTakeNoRoom) {
  std::vector<std::string> names{"'time_s", "'current_A", "'position_mm"};
  for (int k = 3; k < 16384; ++k) names.push_back("'c" + std::to_string(k));
  std::string rows = xlsx_row(names);
  for (int k = 0; k < 400; ++k) rows += xlsx_row({std::to_string(k), "1.5", "0.2"});
  EXPECT_THAT(xlsx_column(xlsx_book(rows), "current_A"), Each(1.5));
}

TEST(XlsxTable, ReportsWhatASheetWithoutATableLacks) {
  EXPECT_THAT(xlsx_refused(xlsx_book(xlsx_row({"1", "2", "3"}) + xlsx_row({"4", "5", "6"}))),
              AllOf(HasSubstr("no sheet holds a table of samples within its first 100 rows: a row of names"),
                    HasSubstr("looked at 'Sheet1'")));
  EXPECT_THAT(xlsx_refused(xlsx_book(name_row)), HasSubstr("no sheet holds a table"));
}

TEST(XlsxTable, RefusesWhatIsNoWorkbookBySayingWhatItIs) {
  const auto archive = [](const std::vector<std::string>& parts) {
    ZipFile zip;
    for (const std::string& part : parts) zip.add(part, "<a/>");
    return zip.content();
  };
  EXPECT_THAT(xlsx_refused(archive({"xl/workbook.bin"})),
              HasSubstr("a binary Excel workbook (.xlsb), which is not read here"));
  EXPECT_THAT(xlsx_refused(archive({"content.xml", "META-INF/manifest.xml"})), HasSubstr("an OpenDocument file"));
  EXPECT_THAT(xlsx_refused(archive({"run.csv"})),
              HasSubstr("a zip archive that holds no Excel workbook, which is not read here; unpack it"));
  EXPECT_THAT(xlsx_refused(std::string("\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1") + std::string(600, '\0')),
              HasSubstr("an Excel workbook of before 2007 (.xls), or one that a password protects"));
  EXPECT_THAT(xlsx_refused("PK\x03\x04 and nothing else"), HasSubstr("its list of parts cannot be read"));
}

TEST(XlsxTable, RefusesAPasswordAndDamage) {
  const std::string rows = name_row + xlsx_row({"0", "1", "2"});
  XlsxFile secret, damaged;
  secret.sheet("Sheet1", rows).packed({.deflated = true, .damaged = false, .flags = 1});
  EXPECT_THAT(xlsx_refused(secret.content()), HasSubstr("is protected by a password; save it without one"));
  damaged.sheet("Sheet1", rows).packed({.deflated = true, .damaged = true});
  EXPECT_THAT(xlsx_refused(damaged.content()), HasSubstr("xl/worksheets/sheet1.xml: cannot be unpacked (CRC error)"));
  EXPECT_THAT(xlsx_refused(xlsx_book("<row><c></row>")), HasSubstr("is no XML: mismatched tag"));
  EXPECT_THAT(xlsx_refused(xlsx_book(R"(<row><c r="ZZZZ1"><v>1</v></c></row>)")),
              HasSubstr("no cell is called 'ZZZZ1'"));
  EXPECT_THAT(xlsx_refused(xlsx_book(R"(<row r="7"><c t="s"><v>3</v></c></row>)")),
              HasSubstr("'Sheet1'!A7: there is no text '3' among the 0 that cells share"));
  EXPECT_THAT(xlsx_refused(xlsx_book("<row><c><v>1,5</v></c></row>")), HasSubstr("A1: '1,5' is no number"));
}

TEST(XlsxTable, RefusesBombs) {
  const std::string entities =
      "<?xml version=\"1.0\"?><!DOCTYPE x [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b "
      "\"&a;&a;&a;&a;\">]><worksheet>&b;</worksheet>";
  EXPECT_THAT(xlsx_refused(xlsx_book(entities)), HasSubstr("it has a document type, which no workbook has"));
  EXPECT_THAT(xlsx_refused(xlsx_book(name_row + xlsx_row({"0", "1", "2"}) + std::string(std::size_t{28} << 20U, ' '))),
              HasSubstr("unpacks to more than 16 MiB and 200 times its size"));
  std::string rows = "<row>";
  for (int k = 0; k < 4000; ++k) rows += "<c t=\"inlineStr\"><is><t>x</t></is></c>";
  rows += "</row>" + xlsx_row(std::vector<std::string>(4000, "1"));
  for (int k = 0; k < 600; ++k) rows += xlsx_row({"0", "1", "2"});
  EXPECT_THAT(xlsx_refused(xlsx_book(rows)), HasSubstr("MiB of numbers in a file of"));
}

TEST(XlsxTable, IsInspectedWithUnitsOfARowBelowTheNames) {
  const TemporaryFile file("run.xlsx",
                           xlsx_book(xlsx_row({"'time", "'current", "'position"}) + xlsx_row({"'s", "'mA", "'mm"}) +
                                     xlsx_row({"0", "500", "1"}) + xlsx_row({"0.001", "600", "2"})));
  const Inspection seen = inspect(file.path(), {}, [](std::optional<double>, std::uint64_t) {});
  EXPECT_EQ(seen.contents.format, "Excel");
  ASSERT_EQ(seen.samples, 2U);
  EXPECT_NEAR(seen.channels.at(1).highest, 0.6, 1e-12);
}

}  // namespace
}  // namespace spoolflow::recording
