#include "spoolflow/report/page/html_table.hpp"

#include <algorithm>
#include <string_view>

#include "spoolflow/report/text/html_text.hpp"

namespace spoolflow::report {
namespace {

const char* class_of(Set set) {
  switch (set) {
    case Set::text:
      return " class=\"text\"";
    case Set::sentence:
      return " class=\"text wrap\"";
    case Set::hash:
      return " class=\"text hash\"";
    case Set::number:
      break;
  }
  return "";
}

/// Two units in brackets below each other: columns are as wide as their numbers.
std::string heading_of(std::string heading) {
  constexpr std::string_view between = " / ";
  const std::size_t at = heading.find(between, std::min(heading.find('['), heading.size()));
  return at == std::string::npos ? heading : heading.replace(at, between.size(), " /<br>");
}

}  // namespace

void HtmlTable::row(const std::vector<std::string>& cells, bool begins_group) {
  rows_.push_back({cells, begins_group});
}

void HtmlTable::change_column(std::size_t column, const std::function<std::string(const std::string&)>& change) {
  for (Row& row : rows_) {
    if (column < row.cells.size()) row.cells[column] = change(row.cells[column]);
  }
}

std::string HtmlTable::str() const {
  std::string head;
  for (const Column& column : columns_) {
    head += std::string("<th scope=\"col\"") + class_of(column.set) + ">" + heading_of(column.heading) + "</th>";
  }
  std::string rows;
  for (const Row& row : rows_) {
    rows += row.begins_group ? "<tr class=\"first\">" : "<tr>";
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      rows +=
          std::string("<td") + class_of(columns_[c].set) + ">" + (c < row.cells.size() ? row.cells[c] : "") + "</td>";
    }
    rows += "</tr>\n";
  }
  return "<div class=\"scroll\"><table><thead><tr>" + head + "</tr></thead><tbody>\n" + rows +
         "</tbody></table></div>\n";
}

}  // namespace spoolflow::report
