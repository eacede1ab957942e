#include "spoolflow/recording/text/table_search.hpp"

#include <algorithm>
#include <string>

#include "spoolflow/recording/files/clock_time.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/recording/text/cell_unit.hpp"
#include "spoolflow/recording/text/csv_cells.hpp"

namespace spoolflow::recording {
namespace {

using Cells = std::vector<std::string_view>;

bool is_comment(std::string_view line) {
  return line.starts_with('#');
}

bool is_value(std::string_view cell) {
  return measures(cell) || read_clock_time(cell).has_value();
}

/// Cells of which most that say anything are numbers.
bool is_row_of_samples(const Cells& cells) {
  const auto filled = std::ranges::count_if(cells, [](std::string_view cell) { return !cell.empty(); });
  const auto values = std::ranges::count_if(cells, is_value);
  return cells.size() > 1 && values > 0 && 2 * values >= filled;
}

/// Text where the row below has numbers: names among which some are numbers, such as "x-axis,1,2".
bool names_row_below(const Cells& cells, const Cells& below) {
  if (cells.size() != below.size()) return false;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    double value = 0;
    const bool is_text = !is_value(cells[k]) && read_number(cells[k], '.', value) == Digits::not_a_number;
    if (is_text && is_value(below[k])) return true;
  }
  return false;
}

/// Names: no numbers or words for missing ones, and at most half of them empty.
bool is_row_of_names(const Cells& cells) {
  double value = 0;
  const auto is_name = [&](std::string_view cell) { return read_number(cell, '.', value) == Digits::not_a_number; };
  const auto names = std::ranges::count_if(cells, is_name);
  const bool others = std::ranges::any_of(
      cells, [&](std::string_view cell) { return !cell.empty() && (!is_name(cell) || is_value(cell)); });
  return !others && 2 * names >= static_cast<std::ptrdiff_t>(cells.size()) && names > 0;
}

/// Such as "1000 Hz" or a date: what stands beside names, seldom one.
bool begins_with_digit(std::string_view cell) {
  return !cell.empty() && cell.front() >= '0' && cell.front() <= '9';
}

bool holds_a_name(const Cells& cells) {
  return std::ranges::any_of(cells, [](std::string_view cell) { return !cell.empty() && !is_value(cell); });
}

/// The lines of a text as one delimiter cuts them.
class CutLines {
 public:
  CutLines(const std::vector<std::string_view>& lines, char delimiter) : lines_(lines), delimiter_(delimiter) {
    for (const std::string_view line : lines) {
      comments_.push_back(is_comment(line));
      rows_.push_back(cells_of(uncommented(line), delimiter));
    }
  }

  struct Stretch {
    std::size_t first = 0, rows = 0, width = 0;
    bool ends_text = false;
  };
  /// The best one; of no rows where there is none.
  [[nodiscard]] Stretch samples() const {
    Stretch best, now;
    bool of_values = true, interrupted = false;  // of the stretch: each cell that says anything is a value; another
                                                 // line stands behind it
    const auto judge = [&] {
      const bool better = now.ends_text != best.ends_text ? now.ends_text : now.rows > best.rows;
      if (now.rows > 0 && better) best = now;
      now = {};
      of_values = true;
    };
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (is_blank(lines_[k]) || comments_[k]) continue;
      if (!is_row_of_samples(rows_[k]) || (delimiter_ == ' ' && std::ranges::count(rows_[k], "") > 0)) {
        interrupted = true;
        continue;
      }
      // A header that comes again, or a line of rubbish, ends no table of values: the reader has its say on it.
      if (interrupted && !(of_values && rows_[k].size() == now.width)) judge();
      interrupted = false;
      if (now.rows++ == 0) now.first = k;
      now.width = std::max(now.width, rows_[k].size());
      of_values = of_values &&
                  std::ranges::all_of(rows_[k], [](std::string_view cell) { return cell.empty() || is_value(cell); });
    }
    now.ends_text = now.rows > 0 && !interrupted;
    judge();
    return best;
  }

  [[nodiscard]] TablePlace place(const Stretch& found) const {
    TablePlace out{delimiter_, found.first, found.width};
    const auto fits = [&](std::size_t k) { return rows_[k].size() == found.width; };
    const auto exceeds = [&](std::size_t k) { return rows_[k].size() > found.width; };
    const auto lacks_some = [&](std::size_t k) { return rows_[k].size() > 1 && 2 * rows_[k].size() > found.width; };
    const bool named =
        names_above(out, false, fits) || names_above(out, false, exceeds) || names_above(out, true, fits);
    if (named && !out.units) out.units = labelled_units_above(*out.header);
    if (named) return out;
    const std::size_t below = next_row(found.first);
    if (below < rows_.size() && names_row_below(rows_[found.first], rows_[below])) {
      out.header = found.first;
      out.samples = below;
    } else {
      (void)names_above(out, false, lacks_some);  // the reader refuses rows that are longer
    }
    return out;
  }

 private:
  template <class Fits>
  bool names_above(TablePlace& out, bool comments, Fits&& fits) const {
    std::optional<std::size_t> units;
    TablePlace numbered = out;  // with names that all begin with a digit, where no others stand above
    for (std::size_t k = out.samples; k-- > 0;) {
      if (is_blank(lines_[k]) || comments_[k] != comments) continue;
      if (!units && rows_[k].size() <= out.width && is_units_row(rows_[k])) {
        units = k;
        continue;
      }
      if (!fits(k) || (units ? !holds_a_name(rows_[k]) : !is_row_of_names(rows_[k]))) continue;
      TablePlace& found = std::ranges::all_of(rows_[k], begins_with_digit) ? numbered : out;
      if (found.header) continue;
      found.header = k;
      found.units = units;
      if (out.header) return true;
    }
    if (numbered.header) out = numbered;
    if (out.header) return true;
    if (units && fits(*units)) out.header = units;  // names that are letters alone
    return out.header.has_value();
  }

  /// A row of units that says so in its first cell, as oscilloscopes write it above the names.
  [[nodiscard]] std::optional<std::size_t> labelled_units_above(std::size_t header) const {
    for (std::size_t k = header; k-- > 0;) {
      const Cells& cells = rows_[k];
      if (cells.size() == rows_[header].size() && labels_units(cells.front()) &&
          is_units_row({cells.begin() + 1, cells.end()}))
        return k;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::size_t next_row(std::size_t k) const {
    for (++k; k < rows_.size() && (is_blank(lines_[k]) || comments_[k]);) ++k;
    return k;
  }

  const std::vector<std::string_view>& lines_;
  char delimiter_;
  std::vector<bool> comments_;
  std::vector<Cells> rows_;
};

}  // namespace

std::optional<TablePlace> find_table(const std::vector<std::string_view>& lines, std::optional<char> declared) {
  const std::string delimiters = declared ? std::string(1, *declared) : std::string("\t;, ");
  std::optional<TablePlace> out;
  CutLines::Stretch best;
  for (const char delimiter : delimiters) {
    if (delimiter == ' ' && out) continue;
    const CutLines cut(lines, delimiter);
    const CutLines::Stretch found = cut.samples();
    if (found.rows <= best.rows) continue;
    best = found;
    out = cut.place(found);
  }
  return out;
}

bool labels_units(std::string_view cell) {
  const std::vector<std::string> words = words_of(cell);
  return std::ranges::count(words, "unit") + std::ranges::count(words, "units") > 0;
}

std::string_view uncommented(std::string_view line) {
  const std::string_view whole = line;
  while (line.starts_with('#') || line.starts_with('%')) line.remove_prefix(1);
  if (line.starts_with("//")) line.remove_prefix(2);
  return line.size() == whole.size() ? whole : without_blanks(line);
}

}  // namespace spoolflow::recording
