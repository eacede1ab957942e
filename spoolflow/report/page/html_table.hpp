#pragma once
#include <functional>
#include <string>
#include <vector>

namespace spoolflow::report {

/// How a column is set.
enum class Set { number, text, sentence, hash };

/// A table; cells are markup (html_text where they are text).
class HtmlTable {
 public:
  struct Column {
    std::string heading;
    Set set = Set::number;
  };
  explicit HtmlTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// `begins_group`: a heavier line above.
  void row(const std::vector<std::string>& cells, bool begins_group = false);
  [[nodiscard]] std::string str() const;
  [[nodiscard]] bool empty() const { return rows_.empty(); }

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  void heading(std::size_t column, const std::string& text) { columns_[column].heading = text; }
  /// Every cell of a column becomes what `change` makes of it.
  void change_column(std::size_t column, const std::function<std::string(const std::string&)>& change);

 private:
  struct Row {
    std::vector<std::string> cells;
    bool begins_group;
  };
  std::vector<Column> columns_;
  std::vector<Row> rows_;
};

}  // namespace spoolflow::report
