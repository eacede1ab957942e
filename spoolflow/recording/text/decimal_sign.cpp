#include "spoolflow/recording/text/decimal_sign.hpp"

#include <algorithm>
#include <cstdint>

#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/text/cell_unit.hpp"
#include "spoolflow/recording/text/csv_cells.hpp"

namespace spoolflow::recording {
namespace {

/// How a cell writes its number, without quotes, spaces and its sign.
enum class Writing : std::uint8_t { other, whole, grouped };

/// `whole`: 1 to 3 digits, which grouping would leave as they are. `grouped`: groups of three digits behind `mark`.
Writing writing_of(std::string_view text, char mark) {
  constexpr std::string_view around = " \t\r\"-+";
  const std::size_t first = text.find_first_not_of(around);
  if (first == std::string_view::npos) return Writing::other;
  text = text.substr(first, text.find_last_not_of(around) - first + 1);
  const auto is_digits = [](std::string_view part) {
    return !part.empty() && std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; });
  };
  const std::string_view leading = text.substr(0, text.find(mark));
  if (!is_digits(leading) || leading.size() > 3 || leading.front() == '0') return Writing::other;
  if (leading.size() == text.size()) return Writing::whole;
  for (text.remove_prefix(leading.size()); !text.empty(); text.remove_prefix(4)) {
    if (text.size() < 4 || text.front() != mark || !is_digits(text.substr(1, 3))) return Writing::other;
  }
  return Writing::grouped;
}

}  // namespace

std::optional<GroupedNumber> without_groups(std::string_view cell) {
  const std::size_t last = cell.find_last_of(".,");
  if (last == std::string_view::npos) return std::nullopt;
  const char point = cell[last], mark = point == ',' ? '.' : ',';
  if (writing_of(cell.substr(0, last), mark) != Writing::grouped) return std::nullopt;
  std::string digits(cell);
  std::erase(digits, mark);
  double value = 0;
  if (read_number(digits, point, value) != Digits::number) return std::nullopt;
  return GroupedNumber{value, point};
}

void DecimalSign::look_at(std::string_view lines, char delimiter) {
  constexpr std::array<char, 2> marks{'.', ','};
  while (!lines.empty() && marked_[0] + marked_[1] < enough) {
    std::string_view line = take_line(lines);
    if (line.starts_with('#')) continue;
    bool last = false;
    for (std::size_t column = 0; !last; ++column) {
      const CsvCell cell = take_cell(line, delimiter);
      last = cell.last;
      const auto found = columns_.find(column);
      if (found == columns_.end()) continue;
      const auto measured = split_cell(cell.text);
      const std::string_view number = measured ? measured->number : cell.text;
      if (const auto plain = without_groups(number)) ++marked_[plain->point == ',' ? 1 : 0];
      if (!is_number(number)) continue;
      for (std::size_t m = 0; m < marks.size(); ++m) {
        Cells& cells = found->second[m];
        const Writing writing = writing_of(number, marks[m]);
        const bool has_mark = number.find(marks[m]) != std::string_view::npos;
        marked_[m] += has_mark ? 1 : 0;
        cells.whole += writing == Writing::whole ? 1 : 0;
        cells.decimal += has_mark && writing != Writing::grouped ? 1 : 0;
        if (writing == Writing::grouped && ++cells.grouped == 1) cells.first = cell.text;
      }
    }
  }
}

std::optional<char> DecimalSign::found() const {
  if (marked_[0] + marked_[1] == 0) return std::nullopt;
  return marked_[1] > marked_[0] ? ',' : '.';
}

std::optional<GroupedCell> DecimalSign::grouped() const {
  constexpr std::size_t several = 2;
  for (const auto& [column, marks] : columns_) {
    const Cells& cells = marks[found() == ',' ? 1 : 0];
    if (cells.grouped > 0 && cells.decimal == 0 && cells.whole >= several) return GroupedCell{column, cells.first};
  }
  return std::nullopt;
}

}  // namespace spoolflow::recording
