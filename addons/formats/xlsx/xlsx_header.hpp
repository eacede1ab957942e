#pragma once
/// Where in a sheet a table of samples begins, and what its columns are called.
#include <optional>
#include <string>
#include <vector>

#include "addons/formats/xlsx/xlsx_rows.hpp"

namespace spoolflow::recording {

/// A cell that outlives its row.
struct KeptCell {
  XlsxCell cell;  ///< its text is empty
  std::string text{};
};
struct KeptRow {
  std::uint64_t number = 0;
  std::vector<KeptCell> cells{};
};

struct XlsxColumn {
  std::uint32_t column;
  std::string name;
  std::string unit{};  ///< of a row of units below the names; empty where there is none
};

/// Looks at the first rows of a sheet until they show a table: two rows, one below the other, of which at least two
/// cells, and half of those that say anything, are numbers or times; above them, with nothing but such rows between, a
/// row of names over at least two of these cells and half of them, or such a row and a row of units below it. One such
/// row is enough where the sheet ends with it. What stands above the names is passed over.
class XlsxHeader {
 public:
  /// Rows that are looked at, of those that hold anything.
  static constexpr std::size_t most_rows = 100;

  /// Whether the table is found with this row, or no more will be looked at.
  bool take(const XlsxRow& row);
  /// There are no more rows.
  void finish();
  [[nodiscard]] bool found() const { return !columns_.empty(); }
  [[nodiscard]] const std::vector<XlsxColumn>& columns() const { return columns_; }
  /// Rows of samples that were taken, the last one among them.
  [[nodiscard]] const std::vector<KeptRow>& samples() const { return rows_; }

 private:
  /// Where a table may stand in rows_.
  struct Place {
    std::size_t names, samples;
  };
  [[nodiscard]] std::optional<Place> place_above_last() const;

  std::vector<KeptRow> rows_{};
  std::optional<Place> candidate_{};  ///< of the row before
  std::vector<XlsxColumn> columns_{};
};

}  // namespace spoolflow::recording
