#include "addons/formats/xlsx/xlsx_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "addons/formats/xlsx/xlsx_column_of_cells.hpp"
#include "addons/formats/xlsx/xlsx_header.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/declared_size.hpp"
#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

/// Less may be a table of results that stands before the recording.
constexpr std::uint64_t rows_of_a_recording = 100;
constexpr std::string_view why_that_sheet = "the first one with a table of 100 samples, or else the longest";
constexpr double missing = XlsxColumnOfCells::missing;

/// One sheet's table, if it holds one, in memory.
class SheetTable {
 public:
  SheetTable(std::string file, const XlsxSheet& sheet, bool from_1904, std::uint64_t file_bytes)
      : what_(fmt::format("{}, '{}'!", file, sheet.name)),
        name_(sheet.name),
        from_1904_(from_1904),
        declared_(std::move(file), file_bytes) {}

  /// Whether more rows are wanted.
  bool take(const XlsxRow& row) {
    if (header_.found()) {
      take_samples(row.number, row.cells, [](const XlsxCell& cell) { return cell; });
      return true;
    }
    if (!header_.take(row)) return true;
    begin();
    return header_.found();
  }
  /// There are no more rows.
  void finish() {
    if (header_.found()) return;
    header_.finish();
    begin();
  }

  [[nodiscard]] bool found() const { return header_.found(); }
  [[nodiscard]] const std::vector<XlsxColumn>& columns() const { return header_.columns(); }
  [[nodiscard]] const XlsxColumnOfCells& cells(std::size_t column) const { return cells_[column]; }
  /// Empty where no row has a number there.
  [[nodiscard]] const std::vector<double>& values(std::size_t column) const { return values_[column]; }
  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  /// The table's first rows, which the header has kept.
  void begin() {
    if (!header_.found()) return;
    const std::vector<XlsxColumn>& columns = header_.columns();
    cells_.assign(columns.size(), XlsxColumnOfCells(what_, from_1904_));
    values_.resize(columns.size());
    latest_.resize(columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      slot_of_.resize(std::max<std::size_t>(slot_of_.size(), columns[k].column + 1), -1);
      slot_of_[columns[k].column] = static_cast<std::ptrdiff_t>(k);
    }
    for (const KeptRow& kept : header_.samples()) {
      take_samples(kept.number, kept.cells, [](const KeptCell& each) {
        XlsxCell cell = each.cell;
        cell.text = each.text;
        return cell;
      });
    }
  }

  template <class Cells, class CellOf>
  void take_samples(std::uint64_t row, const Cells& cells, CellOf cell_of) {
    std::ranges::fill(latest_, missing);
    for (const auto& each : cells) {
      const XlsxCell cell = cell_of(each);
      const std::ptrdiff_t slot = cell.column < slot_of_.size() ? slot_of_[cell.column] : -1;
      if (slot >= 0) latest_[static_cast<std::size_t>(slot)] = cells_[static_cast<std::size_t>(slot)].value(cell, row);
    }
    if (std::ranges::all_of(latest_, [](double value) { return std::isnan(value); })) return;
    for (std::size_t k = 0; k < latest_.size(); ++k) {
      if (values_[k].empty()) {
        if (std::isnan(latest_[k])) continue;  // named columns without a number take no room
        declared_.add(name_, rows_, 1, sizeof(double));
        values_[k].assign(rows_, missing);
        ++begun_;
      }
      values_[k].push_back(latest_[k]);
    }
    declared_.add(name_, 1, begun_, sizeof(double));
    ++rows_;
  }

  std::string what_, name_;
  bool from_1904_;
  DeclaredSize declared_;
  XlsxHeader header_;
  std::vector<XlsxColumnOfCells> cells_;
  std::vector<std::ptrdiff_t> slot_of_;  ///< of each of the sheet's columns among those that are named
  std::vector<double> latest_;
  std::vector<std::vector<double>> values_;
  std::uint64_t begun_ = 0;  ///< columns that have a number
  std::uint64_t rows_ = 0;
};

class XlsxTable final : public VectorTable {
 public:
  explicit XlsxTable(const std::filesystem::path& path) : VectorTable(path.string()), archive_(path) {}

  void look() override {
    const XlsxWorkbook workbook = read_xlsx_workbook(archive_);
    const XlsxTexts texts(archive_, workbook.texts);
    const XlsxStyles styles(archive_, workbook.styles);
    for (const XlsxSheet& sheet : workbook.sheets) {
      auto table = std::make_unique<SheetTable>(file(), sheet, workbook.from_1904, archive_.bytes());
      read_xlsx_rows(archive_, sheet, texts, styles, [&](const XlsxRow& row) { return table->take(row); });
      table->finish();
      if (!table->found() || (sheet_ && table->rows() <= sheet_->rows())) continue;
      sheet_ = std::move(table);
      if (sheet_->rows() >= rows_of_a_recording) break;
    }
    if (!sheet_) refuse_tableless(workbook);
    list();
    list_unread(workbook);
  }

  [[nodiscard]] std::vector<UnreadPart> unread() const override { return unread_; }
  void take_text_as_missing() override { refuses_text_ = false; }

  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override {
    const std::vector<double>& values = sheet_->values(listed_[column]);
    if (values.empty()) return void(std::fill_n(out, count, missing));
    const double factor = factors_[column];
    std::transform(values.begin() + static_cast<std::ptrdiff_t>(first),
                   values.begin() + static_cast<std::ptrdiff_t>(first + count), out,
                   [factor](double value) { return factor * value; });
  }

 protected:
  void chosen(const std::vector<std::size_t>& columns) override {
    for (const std::size_t column : columns) {
      const std::string& refusal = sheet_->cells(listed_[column]).refusal();
      if (refuses_text_ && !refusal.empty()) throw RecordingError(refusal);
    }
  }

 private:
  [[noreturn]] void refuse_tableless(const XlsxWorkbook& workbook) const {
    std::string sheets;
    for (const XlsxSheet& sheet : workbook.sheets)
      sheets += fmt::format("{}'{}'", sheets.empty() ? "" : ", ", sheet.name);
    for (const std::string& hidden : workbook.hidden)
      sheets += fmt::format("; '{}' is hidden and not read, show it in the program for sheets", hidden);
    throw RecordingError(
        fmt::format("{}: no sheet holds a table of samples within its first {} rows: a row of names, such as time_s, "
                    "current_A, position_mm, and numbers below (looked at {})",
                    file(), XlsxHeader::most_rows, sheets));
  }

  void list() {
    for (std::size_t k = 0; k < sheet_->columns().size(); ++k) {
      const XlsxColumn& column = sheet_->columns()[k];
      if (!sheet_->cells(k).is_used()) continue;
      const bool as_shown = sheet_->cells(k).is_in_percent() && is_or_may_be_percent(column);
      const std::string unit = sheet_->cells(k).is_clock() ? "s" : as_shown && column.unit.empty() ? "%" : column.unit;
      add({{column.name, column.name, unit}, sheet_->rows()});
      listed_.push_back(k);
      factors_.push_back(as_shown ? 100 : 1);
    }
  }
  /// Of a column whose cells are shown in percent: whether that, or nothing, is what it is said to be in.
  static bool is_or_may_be_percent(const XlsxColumn& column) {
    const FileColumn said{column.name, column.name, column.unit};
    const auto header = channel_header(said);
    const std::string stated = header ? header->unit : stated_unit(said);
    const auto unit = units::unit_named(stated);
    return stated.empty() || (unit && unit->name == "percent");
  }

  void list_unread(const XlsxWorkbook& workbook) {
    for (std::size_t k = 0; k < sheet_->columns().size(); ++k) {
      if (sheet_->cells(k).is_used()) continue;
      const std::string& column = sheet_->columns()[k].name;
      keep(unread_,
           {column, fmt::format("column '{}' holds text, which is not read; write it as numbers in its unit", column)});
    }
    if (workbook.sheets.size() < 2) return;
    keep(unread_, {{},
                   fmt::format("of its {} sheets '{}' is read, {}; move the one that is meant to the front",
                               workbook.sheets.size(), sheet_->name(), why_that_sheet)});
  }

  XlsxArchive archive_;
  std::unique_ptr<SheetTable> sheet_;
  std::vector<std::size_t> listed_;  ///< of each column of this table, which of the sheet's
  std::vector<double> factors_;      ///< of each column of this table, from the sheet's numbers
  std::vector<UnreadPart> unread_;
  bool refuses_text_ = true;
};

}  // namespace

std::unique_ptr<VectorTable> open_xlsx_table(const std::filesystem::path& file) {
  return std::make_unique<XlsxTable>(file);
}

}  // namespace spoolflow::recording
