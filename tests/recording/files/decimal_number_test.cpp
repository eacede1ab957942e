#include "spoolflow/recording/files/decimal_number.hpp"

#include <bit>
#include <charconv>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::recording {
namespace {

/// What a cell of this text, ended by `behind`, is read as; nothing where read_number() has to look.
std::optional<double> number_of_cell(const std::string& cell, const std::string& behind = ",7.5", char point = '.') {
  const std::string line = cell + behind;
  const std::string text = line + "\n" + std::string(scan_padding, '9');
  double value = 0;
  if (!read_decimal(text.data(), text.data() + cell.size(), point, value)) return std::nullopt;
  return value;
}

/// Decimal digits, their point, sign and exponent here and there.
std::string written_number(std::mt19937_64& random) {
  const auto below = [&](std::uint64_t bound) { return random() % bound; };
  const auto digits = [&](std::uint64_t most) {
    std::string out;
    for (std::uint64_t left = below(most); left > 0; --left) out += static_cast<char>('0' + below(10));
    return out;
  };
  std::string out = below(2) == 0 ? "-" : "";
  out += static_cast<char>('0' + below(10));
  out += digits(below(5) == 0 ? 22 : 4);
  if (below(4) != 0) out += "." + digits(below(3) == 0 ? 22 : 6);
  if (below(5) == 0)
    out += std::string(below(2) == 0 ? "e" : "E") + (below(2) == 0 ? "-" : "") + std::to_string(below(300));
  return out;
}

TEST(DecimalNumber, IsToTheLastBitWhatTheStandardLibraryReads) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 20'000; ++trial) {
    const std::string cell = written_number(random);
    double expected = 0;
    const auto whole = std::from_chars(cell.data(), cell.data() + cell.size(), expected);
    if (whole.ec == std::errc::result_out_of_range) continue;  // the one says too large, the other too small
    const std::optional<double> value = number_of_cell(cell);
    ASSERT_TRUE(value) << cell;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(*value), std::bit_cast<std::uint64_t>(expected)) << cell;
  }
}

TEST(DecimalNumber, IsReadAlikeWhateverEndsItsCell) {
  for (const std::string& behind : std::vector<std::string>{",", ";", "\t", "\r", " ,", "\n99", "-", "\x80"})
    for (const char* const cell : {"0", "-7", "12.5", "-0.00283", "1234567", "12345678", "123456.7", "1833.0123",
                                   "123456.75", "-12345678.7654321", "123456789.25", ".5", "5.", "2e3"})
      EXPECT_EQ(number_of_cell(cell, behind), std::stod(cell)) << cell;
}

TEST(DecimalNumber, HasACommaWhereTheFileHas) {
  EXPECT_EQ(number_of_cell("-12,625", ";", ','), -12.625);
  EXPECT_EQ(number_of_cell("0,1234567890123", ";", ','), 0.1234567890123);
  EXPECT_EQ(number_of_cell("98765432109876543,5", ";", ','), 98765432109876543.5);
}

TEST(DecimalNumber, LeavesWhatIsNoBareNumber) {
  for (const char* const cell : {"", "-", ".", "-.", "1.2.3", "1-2", "1785.9990.1", "1785 .99901", "nan", "inf", "+1",
                                 " 1", "1e", "1e+", "1e99999", "1e400", "e5", "\"1\""})
    EXPECT_FALSE(number_of_cell(cell)) << cell;
  EXPECT_FALSE(number_of_cell(std::string(401, '1')));  // no number of a recording is longer
}

TEST(DecimalNumber, IsMissingHoweverACLibraryWritesThatThereIsNone) {
  for (const char* const cell : {"nan", "-nan", "+nan", "NaN", "-NaN", "nan(ind)", "-nan(ind)", "1.#QNAN", "-1.#QNAN",
                                 "1.#IND", "-1.#IND", "nan(snan)", " -nan ", "\"-1.#IND\""}) {
    double value = 7;
    EXPECT_EQ(read_number(cell, '.', value), Digits::empty) << cell;
    EXPECT_EQ(value, 7) << cell;
  }
  for (const char* const cell : {"inf", "-inf", "1.#INF", "nano", "-nan(", "nan nan"}) {
    double value = 7;
    EXPECT_NE(read_number(cell, '.', value), Digits::empty) << cell;
  }
}

}  // namespace
}  // namespace spoolflow::recording
