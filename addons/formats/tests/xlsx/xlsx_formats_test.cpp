/// How cells show numbers says what they are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/formats/tests/xlsx/xlsx_file.hpp"
#include "addons/formats/tests/xlsx/xlsx_reading.hpp"
#include "addons/formats/xlsx/xlsx_styles.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(XlsxStyles, DistinguishesFormatsOfTimeFromOthers) {
  for (const char* format : {"yyyy-mm-dd", "hh:mm:ss.000", "[h]:mm", "[ss].00", "[$-407]d. mmmm yyyy", "General\\ d"}) {
    EXPECT_EQ(shown_by(format), XlsxShown::time) << format;
  }
  for (const char* format : {"General", "0.00E+00", "#,##0.00", "0.0\" days\"", "[Red]0", "0\\d", "_d0", "[>100]0;d",
                             "@", "\"open", "[", "0\" %\"", "0\\%", "0;0%"}) {
    EXPECT_EQ(shown_by(format), XlsxShown::number) << format;
  }
  for (const char* format : {"0 %", "0.00%", "[Red]0%;0"}) EXPECT_EQ(shown_by(format), XlsxShown::percent) << format;
}

TEST(XlsxTable, ReadsPercentagesAsTheyAreShown) {
  const auto shares = [](const std::vector<std::string>& names, const std::vector<std::string>& units = {}) {
    std::vector<std::string> row{"0"};
    for (std::size_t k = 1; k < names.size(); ++k) row.push_back("<c s=\"1\"><v>0.25</v></c>");
    XlsxFile file;
    file.sheet("Sheet1", xlsx_row(names) + (units.empty() ? "" : xlsx_row(units)) + xlsx_row(row)).formats({"0.0%"});
    return file.content();
  };
  const std::string bytes = shares({"'time_s", "'position", "'position_percent", "'position [%]", "'LVDT", "'gain_1"});
  EXPECT_THAT(xlsx_names(bytes),
              ElementsAre("time_s|", "position|%", "position_percent|%", "position [%]|%", "LVDT|%", "gain_1|%"));
  for (const char* name : {"position", "position_percent", "position [%]", "LVDT"})
    EXPECT_THAT(xlsx_column(bytes, name), ElementsAre(25)) << name;
  const std::string otherwise = shares({"'time", "'position_mm", "'position", "'load"}, {"'s", "'", "'mm", "'%"});
  EXPECT_THAT(xlsx_column(otherwise, "position_mm"), ElementsAre(0.25));
  EXPECT_THAT(xlsx_column(otherwise, "position"), ElementsAre(0.25));
  EXPECT_THAT(xlsx_column(otherwise, "load"), ElementsAre(25));
}

TEST(XlsxTable, RefusesPercentagesAmongNumbers) {
  const std::string rows = name_row + xlsx_row({"0", "1", "2"}) + xlsx_row({"1", "1", R"(<c s="1"><v>0.2</v></c>)"});
  XlsxFile file;
  file.sheet("Sheet1", rows).formats({"0%"});
  EXPECT_THAT(xlsx_refused(file.content()),
              HasSubstr("'Sheet1'!C3: is a number shown in percent, where the cells above are not"));
}

}  // namespace
}  // namespace spoolflow::recording
