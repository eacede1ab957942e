#include "spoolflow/recording/text/decimal_sign.hpp"

#include <algorithm>

#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/text/cell_unit.hpp"
#include "spoolflow/recording/text/csv_cells.hpp"
#include "spoolflow/recording/text/grouped_number.hpp"

namespace spoolflow::recording {

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
      if (!is_number(number)) {
        const auto plain = without_groups(number);
        for (std::size_t m = 0; m < marks.size() && plain; ++m) marked_[m] += plain->point == marks[m] ? 1 : 0;
        continue;
      }
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
