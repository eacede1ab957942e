#include "spoolflow/report/page/html_table.hpp"

#include <array>

namespace spoolflow::report {
namespace {

const char* class_of(Set set) {
  static constexpr std::array classes{"", " class=\"text\"", " class=\"text wrap\"", " class=\"text hash\""};
  return classes.at(static_cast<std::size_t>(set));
}

/// The unit on the heading's second line, two units below each other: columns are as wide as their numbers.
std::string heading_of(const HtmlTable::Column& column, const ReaderUnits& units) {
  if (!column.quantity) return column.heading;
  std::string out = column.heading;
  out += out.find("<br>") == std::string::npos ? "<br>[" : " [";
  out += units.unit(*column.quantity).shown;
  if (!column.beside.empty()) out += " /<br>" + column.beside;
  return out + "]";
}

}  // namespace

std::string HtmlTable::Cell::in(const ReaderUnits& units, const Column& column) const {
  if (!quantity_) return text_.in(units);
  return (column.quantity == quantity_->quantity.kind ? bare(*quantity_) : *quantity_).in(units);
}

void HtmlTable::row(std::vector<Cell> cells, bool begins_group) {
  rows_.push_back({std::move(cells), begins_group});
}

std::string HtmlTable::str(const ReaderUnits& units) const {
  std::string head;
  for (const Column& column : columns_) {
    head += std::string("<th scope=\"col\"") + class_of(column.set) + ">" + heading_of(column, units) + "</th>";
  }
  std::string rows;
  for (const Row& row : rows_) {
    rows += row.begins_group ? "<tr class=\"first\">" : "<tr>";
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      rows += std::string("<td") + class_of(columns_[c].set) + ">" +
              (c < row.cells.size() ? row.cells[c].in(units, columns_[c]) : "") + "</td>";
    }
    rows += "</tr>\n";
  }
  return "<div class=\"scroll\"><table><thead><tr>" + head + "</tr></thead><tbody>\n" + rows +
         "</tbody></table></div>\n";
}

}  // namespace spoolflow::report
