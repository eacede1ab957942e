#include "spoolflow/report/html_table.hpp"

#include "spoolflow/report/html_text.hpp"

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

}  // namespace

void HtmlTable::row(const std::vector<std::string>& cells, bool begins_group) {
  rows_ += begins_group ? "<tr class=\"first\">" : "<tr>";
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    rows_ += std::string("<td") + class_of(columns_[c].set) + ">" + (c < cells.size() ? cells[c] : "") + "</td>";
  }
  rows_ += "</tr>\n";
}

std::string HtmlTable::str() const {
  std::string head;
  for (const Column& column : columns_) {
    head += std::string("<th scope=\"col\"") + class_of(column.set) + ">" + column.heading + "</th>";
  }
  return "<div class=\"scroll\"><table><thead><tr>" + head + "</tr></thead><tbody>\n" + rows_ +
         "</tbody></table></div>\n";
}

}  // namespace spoolflow::report
