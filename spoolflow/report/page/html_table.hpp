#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "spoolflow/report/text/text.hpp"

namespace spoolflow::report {

/// How a column is set.
enum class Set { number, text, sentence, hash };

/// A table; headings and cells are markup (html_text where they are text).
class HtmlTable {
 public:
  struct Column {
    std::string heading;
    Set set = Set::number;
    std::optional<units::Kind> quantity = {};  ///< its unit stands below the heading, so not in the cells
    std::string beside = {};                   ///< a second unit, behind the first: "% FS"
  };
  /// A text, or a quantity, which is written without its unit where the column states it.
  class Cell {
   public:
    // Whatever can be read can stand in a cell.
    Cell(Text text) : text_(std::move(text)) {}                  // NOLINT(google-explicit-constructor)
    Cell(std::string text) : text_(std::move(text)) {}           // NOLINT(google-explicit-constructor)
    Cell(const char* text) : text_(text) {}                      // NOLINT(google-explicit-constructor)
    Cell(const QuantityText& quantity) : quantity_(quantity) {}  // NOLINT(google-explicit-constructor)

    [[nodiscard]] std::string in(const ReaderUnits& units, const Column& column) const;

   private:
    Text text_;
    std::optional<QuantityText> quantity_;
  };

  explicit HtmlTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// `begins_group`: a heavier line above.
  void row(std::vector<Cell> cells, bool begins_group = false);
  [[nodiscard]] std::string str(const ReaderUnits& units = {}) const;
  [[nodiscard]] bool empty() const { return rows_.empty(); }

 private:
  struct Row {
    std::vector<Cell> cells;
    bool begins_group;
  };
  std::vector<Column> columns_;
  std::vector<Row> rows_;
};

}  // namespace spoolflow::report
