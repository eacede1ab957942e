#include "addons/formats/xlsx/xlsx_column_of_cells.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/files/decimal_number.hpp"

namespace spoolflow::recording {

double XlsxColumnOfCells::value(const XlsxCell& cell, std::uint64_t row) {
  if (cell.kind == XlsxCell::Kind::number) return number(cell, row, cell.number);
  if (cell.kind == XlsxCell::Kind::time) return since_first(cell, row, clock_of(cell.number));
  if (cell.kind == XlsxCell::Kind::error) return missing;
  if (cell.kind == XlsxCell::Kind::without_result) {
    is_used_ = true;
    return refuse(
        cell, row,
        "is a formula whose result the file does not hold; open the file in the program for sheets and save it "
        "there, or write values");
  }
  double written = 0;
  const Digits digits = read_number(cell.text, '.', written);
  if (digits == Digits::number) return text_number(cell, row, written);
  if (digits == Digits::empty) return missing;
  if (read_number(cell.text, ',', written) == Digits::number) return text_number(cell, row, written);
  if (const auto clock = read_clock_time(cell.text)) return since_first(cell, row, *clock);
  has_text_ = true;
  return refuse(cell, row,
                fmt::format("'{}' is not a number; correct it, or leave the cell empty where a sample is missing",
                            shortened(cell.text)));
}

double XlsxColumnOfCells::text_number(const XlsxCell& cell, std::uint64_t row, double value) {
  const bool comma = cell.text.find(',') != std::string_view::npos;
  const bool point = cell.text.find('.') != std::string_view::npos;
  if ((comma && has_point_) || (point && has_comma_)) {
    return refuse(cell, row,
                  fmt::format("'{}' has a decimal {}, where text above has a decimal {}; write numbers",
                              shortened(cell.text), comma ? "comma" : "point", comma ? "point" : "comma"));
  }
  has_comma_ = has_comma_ || comma, has_point_ = has_point_ || point;
  if (comma && !may_group_thousands(cell.text)) comma_is_decimal_ = true;
  if (comma && !comma_is_decimal_ && doubtful_.empty()) {
    doubtful_ = fmt::format("{}{}: '{}' is text that may be {} or {}; write numbers", sheet_,
                            cell_name(cell.column, row), shortened(cell.text), value, 1000 * value);
  }
  return number(cell, row, value);
}

bool XlsxColumnOfCells::may_group_thousands(std::string_view text) {
  const std::size_t first = text.find_first_of("0123456789"), comma = text.find(',');
  const std::size_t behind = text.find_first_not_of("0123456789", comma + 1);
  const bool three = std::min(behind, text.size()) - comma == 4;
  return first < comma && comma - first <= 3 && text[first] != '0' && three && text.find_first_of("eE") == text.npos;
}

double XlsxColumnOfCells::number(const XlsxCell& cell, std::uint64_t row, double value) {
  if (origin_) return refuse(cell, row, "is a number, where the cells above are dates or times; write one kind alone");
  is_used_ = has_numbers_ = true;
  if (in_percent_.value_or(cell.in_percent) != cell.in_percent) {
    return refuse(cell, row,
                  fmt::format("is {} shown in percent, where the cells above are{}; give the column one format",
                              cell.in_percent ? "a number" : "not", cell.in_percent ? " not" : ""));
  }
  in_percent_ = cell.in_percent;
  return value;
}

double XlsxColumnOfCells::since_first(const XlsxCell& cell, std::uint64_t row, const ClockTime& clock) {
  if (has_numbers_) {
    return refuse(cell, row, "is a date or time, where the cells above are numbers; write one kind alone");
  }
  if (!origin_) origin_ = clock;
  is_used_ = true;
  const double since_s = clock.since(*origin_);
  constexpr double per_s = 1e5;  // of a date of today 15 to 17 digits resolve 9 to 0.6 us
  return cell.kind == XlsxCell::Kind::time ? std::round(since_s * per_s) / per_s : since_s;
}

ClockTime XlsxColumnOfCells::clock_of(double days) const {
  constexpr double day_s = 86400;
  constexpr std::int64_t of_1900 = -25569, of_1904 = -24107;  // since 1970-01-01
  const double whole = std::floor(days);
  if (!(std::abs(whole) < 1e9)) return {0, day_s * days};
  return {static_cast<std::int64_t>(whole) + (from_1904_ ? of_1904 : of_1900), day_s * (days - whole)};
}

double XlsxColumnOfCells::refuse(const XlsxCell& cell, std::uint64_t row, std::string_view why) {
  if (refusal_.empty()) refusal_ = fmt::format("{}{}: {}", sheet_, cell_name(cell.column, row), why);
  return missing;
}

}  // namespace spoolflow::recording
