#pragma once
/// How a CSV file is written: its delimiter, its decimal point, its columns with units.
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/column_binding.hpp"

namespace spoolflow::recording {

struct CsvDialect {
  char delimiter = ',';
  char decimal_point = '.';
};

/// The fields of a line; quotes are taken off, doubled quotes inside become one.
[[nodiscard]] std::vector<std::string> split_fields(std::string_view line, char delimiter);
/// From the header: semicolon before tab before comma, whichever stands outside quotes.
[[nodiscard]] char delimiter_of(std::string_view header);
/// Whether every filled field is a unit (maybe in brackets) and none a number.
[[nodiscard]] bool is_units_row(const std::vector<std::string>& fields);
/// A unit without the brackets around it: "[bar]" is "bar".
[[nodiscard]] std::string without_brackets(std::string_view text);

}  // namespace spoolflow::recording
