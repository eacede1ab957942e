#include "addons/formats/xlsx/xlsx_rows.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "addons/formats/xlsx/xml_events.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t longest_cell = 32767 * 4;  // characters that Excel allows, in UTF-8

/// "BC12": column 54. Nothing where no letters stand there, or too many.
std::optional<std::uint32_t> column_of(std::string_view reference) {
  std::uint32_t column = 0;
  std::size_t letters = 0;
  for (; letters < reference.size(); ++letters) {
    const char c = reference[letters];
    const bool small = c >= 'a' && c <= 'z';
    if (!small && (c < 'A' || c > 'Z')) break;
    column = 26 * column + static_cast<std::uint32_t>(c - (small ? 'a' : 'A')) + 1;
    if (column > most_xlsx_columns) return std::nullopt;
  }
  if (letters == 0) return std::nullopt;
  return column - 1;
}

/// Elements row, c, v, f, is and t of a sheet (ECMA-376 part 1, 18.3.1).
class RowsListener final : public XmlListener {
 public:
  RowsListener(std::string what, const XlsxTexts& texts, const XlsxStyles& styles,
               const std::function<bool(const XlsxRow&)>& show)
      : what_(std::move(what)), texts_(texts), styles_(styles), show_(show) {}

  void begin(std::string_view element, const XmlAttributes& attributes) override {
    if (enough_) return;
    if (element == "c") {
      begin_cell(attributes);
    } else if (element == "v") {
      begin_value();
    } else if (element == "t") {
      if (inside_inline_ && !inside_phonetic_) taking_ = true;
    } else if (element == "row") {
      row_.number = attributes.whole("r", row_.number + 1);
      row_.cells.clear();
      own_texts_.clear();
      own_places_.clear();
      next_column_ = 0;
    } else if (element == "f") {
      has_formula_ = true;
    } else if (element == "is") {
      begin_value();
      inside_inline_ = true, taking_ = false;
    } else if (element == "rPh") {
      inside_phonetic_ = true;
    }
  }

  void end(std::string_view element) override {
    if (enough_) return;
    if (element == "c") {
      end_cell();
    } else if (element == "v" || element == "t") {
      taking_ = false;
    } else if (element == "row") {
      place_texts();
      if (!row_.cells.empty()) enough_ = !show_(row_);
      row_.cells.clear();
    } else if (element == "is") {
      inside_inline_ = false;
    } else if (element == "rPh") {
      inside_phonetic_ = false;
    }
  }

  void text(std::string_view text) override {
    if (!taking_ || enough_) return;
    value_ += text;
    if (value_.size() > longest_cell) refuse_xlsx(place(), "more text than a cell can hold");
  }
  [[nodiscard]] bool has_enough() const override { return enough_; }

 private:
  /// A cell whose text stands in own_texts_ until the row is whole, as that may move when it grows.
  struct OwnText {
    std::size_t cell, begin, bytes;
  };

  [[nodiscard]] std::string place() const { return fmt::format("{}{}", what_, cell_name(column_, row_.number)); }

  void begin_cell(const XmlAttributes& attributes) {
    const std::string_view reference = attributes.get("r");
    const auto column = reference.empty() ? std::optional(next_column_) : column_of(reference);
    if (!column || *column >= most_xlsx_columns || row_.cells.size() >= most_xlsx_columns) {
      refuse_xlsx(fmt::format("{}row {}", what_, row_.number), fmt::format("no cell is called '{}'", reference));
    }
    column_ = *column;
    next_column_ = column_ + 1;
    const std::string_view type = attributes.get("t");
    type_ = type.empty() ? 'n' : type == "str" || type == "inlineStr" ? 't' : type[0];  // n, s, b, e, d
    style_ = attributes.whole("s", 0);
    has_formula_ = has_value_ = taking_ = false;
    value_.clear();
  }
  void begin_value() { has_value_ = taking_ = true; }

  void end_cell() {
    taking_ = false;
    XlsxCell cell{column_};
    if (!has_value_ || (value_.empty() && type_ != 't')) {
      if (!has_formula_) return;
      cell.kind = XlsxCell::Kind::without_result;
    } else if (type_ == 'n' || type_ == 'b') {
      if (read_number(value_, '.', cell.number) != Digits::number) {
        refuse_xlsx(place(), fmt::format("'{}' is no number", value_.substr(0, 40)));
      }
      const XlsxShown shown = type_ == 'n' ? styles_.shown(style_) : XlsxShown::number;
      cell.kind = shown == XlsxShown::time ? XlsxCell::Kind::time : XlsxCell::Kind::number;
      cell.in_percent = shown == XlsxShown::percent;
    } else if (type_ == 'e') {
      cell.kind = XlsxCell::Kind::error;
    } else if (type_ == 's') {
      cell.kind = XlsxCell::Kind::text;
      cell.text = shared_text();
      if (cell.text.empty()) return;
    } else {
      if (value_.empty()) return;
      cell.kind = XlsxCell::Kind::text;
      own_places_.push_back({row_.cells.size(), own_texts_.size(), value_.size()});
      own_texts_ += value_;
    }
    row_.cells.push_back(cell);
  }

  std::string_view shared_text() const {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(value_.data(), value_.data() + value_.size(), number);
    if (error != std::errc{} || end != value_.data() + value_.size() || number >= texts_.size()) {
      refuse_xlsx(place(), fmt::format("there is no text '{}' among the {} that cells share", value_.substr(0, 40),
                                       texts_.size()));
    }
    return texts_.at(number);
  }

  void place_texts() {
    for (const OwnText& each : own_places_) {
      row_.cells[each.cell].text = std::string_view(own_texts_).substr(each.begin, each.bytes);
    }
    own_places_.clear();
  }

  std::string what_;  ///< "run.xlsx, 'Sheet1'!"
  const XlsxTexts& texts_;
  const XlsxStyles& styles_;
  const std::function<bool(const XlsxRow&)>& show_;
  XlsxRow row_;
  std::string own_texts_;
  std::vector<OwnText> own_places_;
  std::uint32_t column_ = 0, next_column_ = 0;
  std::uint64_t style_ = 0;
  char type_ = 'n';
  bool has_formula_ = false, has_value_ = false, inside_inline_ = false, inside_phonetic_ = false;
  bool taking_ = false;  ///< what is read now is of the cell's value
  std::string value_;
  bool enough_ = false;
};

}  // namespace

std::string cell_name(std::uint32_t column, std::uint64_t row) {
  std::string letters;
  for (std::uint32_t rest = column + 1; rest > 0; rest = (rest - 1) / 26) {
    letters.insert(letters.begin(), static_cast<char>('A' + (rest - 1) % 26));
  }
  return fmt::format("{}{}", letters, row);
}

void read_xlsx_rows(XlsxArchive& archive, const XlsxSheet& sheet, const XlsxTexts& texts, const XlsxStyles& styles,
                    const std::function<bool(const XlsxRow&)>& show) {
  RowsListener listener(fmt::format("{}, '{}'!", archive.name(), sheet.name), texts, styles, show);
  read_xml(archive.part(sheet.part), listener);
}

}  // namespace spoolflow::recording
