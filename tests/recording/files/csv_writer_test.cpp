#include "spoolflow/recording/files/csv_writer.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace spoolflow::recording {
namespace {

std::string cell_of(double value, int decimals) {
  std::ostringstream out;
  CsvWriter(out).number(value, decimals);
  return out.str();
}

TEST(CsvWriter, RoundsToTheNearestAtItsDecimals) {
  EXPECT_EQ(cell_of(0, 6), "0.000000");
  EXPECT_EQ(cell_of(12.3456785, 6), "12.345679");
  EXPECT_EQ(cell_of(-0.0005, 3), "-0.001");
  EXPECT_EQ(cell_of(-0.0004, 3), "0.000");
  EXPECT_EQ(cell_of(99.9996, 3), "100.000");
  EXPECT_EQ(cell_of(99999999.4, 0), "99999999");
  EXPECT_EQ(cell_of(99999999.5, 0), "100000000");
  EXPECT_EQ(cell_of(1833.0123, 6), "1833.012300");
  EXPECT_EQ(cell_of(-999.9999999, 6), "-1000.000000");
  EXPECT_EQ(cell_of(999999.96, 1), "1000000.0");
  EXPECT_EQ(cell_of(100007.00305, 5), "100007.00305");
  EXPECT_EQ(cell_of(2147483648.5, 4), "2147483648.5000");
  EXPECT_EQ(cell_of(123456789.875, 6), "123456789.875000");
  EXPECT_EQ(cell_of(1e22, 2), "10000000000000000000000.00");
  EXPECT_EQ(cell_of(1.0 / 3, 9), "0.333333333");
  EXPECT_EQ(cell_of(-std::numeric_limits<double>::max(), 0),
            fmt::format("{:.0f}", -std::numeric_limits<double>::max()));
}

TEST(CsvWriter, WritesTheDigitsOfAnyNumber) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 5'000; ++trial) {
    const std::uint64_t number = random() >> (16 + random() % 48);
    const auto decimals = static_cast<int>(random() % 8);
    std::string expected = fmt::format("{:0{}}", number, decimals + 1);
    if (decimals > 0) expected.insert(expected.size() - static_cast<std::size_t>(decimals), ".");
    const double value = static_cast<double>(number) / std::pow(10.0, decimals);
    if (std::abs(value * std::pow(10.0, decimals) - static_cast<double>(number)) > 0.25) continue;
    ASSERT_EQ(cell_of(value, decimals), expected) << value;
  }
}

TEST(CsvWriter, LeavesACellEmptyWhereThereIsNoNumberAndQuotesWhatNeedsIt) {
  const std::array<double, 2> first{1, std::nan("")}, second{-2.5, 3};
  const std::array<CsvWriter::FixedColumn, 2> columns{{{first.data(), 1}, {second.data(), 0}}};
  std::ostringstream out;
  {
    CsvWriter csv(out);
    csv.header({"a", "b [\"x\"]", "c"});
    for (const std::size_t row : {0u, 1u}) {
      csv.numbers(columns, row);
      csv.text(row == 0 ? "d,e" : "");
      csv.end_row();
    }
    csv.text("alone");
    csv.number(std::nan(""), 3);
    csv.number(4, 1);
    csv.end_row();
  }
  EXPECT_EQ(out.str(), "a,\"b [\"\"x\"\"]\",c\n1.0,-3,\"d,e\"\n,3,\nalone,,4.0\n");
}

TEST(CsvWriter, HandsOverEveryRowHoweverMany) {
  std::ostringstream out;
  std::string expected;
  {
    CsvWriter csv(out);
    for (int row = 0; row < 40'000; ++row) {
      csv.number(row, 3);
      csv.text("some words");
      csv.end_row();
      expected += fmt::format("{}.000,some words\n", row);
    }
  }
  EXPECT_EQ(out.str(), expected);
}

}  // namespace
}  // namespace spoolflow::recording
