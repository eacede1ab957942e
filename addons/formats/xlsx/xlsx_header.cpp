#include "addons/formats/xlsx/xlsx_header.hpp"

#include <algorithm>

#include "spoolflow/recording/files/clock_time.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/files/header_name.hpp"

namespace spoolflow::recording {
namespace {

std::string trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blank);
  return begin == std::string_view::npos ? std::string()
                                         : std::string(text.substr(begin, text.find_last_not_of(blank) - begin + 1));
}

KeptRow kept(const XlsxRow& row) {
  KeptRow out{row.number};
  for (const XlsxCell& cell : row.cells) {
    KeptCell copy{cell, trimmed(cell.text)};
    copy.cell.text = {};
    out.cells.push_back(std::move(copy));
  }
  return out;
}

/// A number, a time, or what stands for one.
bool is_sample(const KeptCell& each) {
  if (each.cell.kind != XlsxCell::Kind::text) return each.cell.kind != XlsxCell::Kind::error;
  double value = 0;
  return read_number(each.text, '.', value) == Digits::number || read_number(each.text, ',', value) == Digits::number ||
         read_clock_time(each.text).has_value();
}

bool is_name(const KeptCell& each) {
  return each.cell.kind == XlsxCell::Kind::text && !each.text.empty() && !is_sample(each);
}

bool is_row_of_samples(const KeptRow& row) {
  const auto samples = std::ranges::count_if(row.cells, is_sample);
  return samples >= 2 && 2 * samples >= std::ssize(row.cells);
}

std::vector<std::string_view> texts_of(const KeptRow& row) {
  std::vector<std::string_view> out;
  for (const KeptCell& each : row.cells) out.push_back(is_sample(each) ? std::string_view("0") : each.text);
  return out;
}

bool names_samples(const KeptRow& names, const KeptRow& samples) {
  std::ptrdiff_t all = 0, named = 0;
  for (const KeptCell& sample : samples.cells) {
    if (!is_sample(sample)) continue;
    ++all;
    named += std::ranges::any_of(
        names.cells, [&](const KeptCell& name) { return name.cell.column == sample.cell.column && is_name(name); });
  }
  return named >= 2 && 2 * named >= all;
}

std::vector<XlsxColumn> columns_of(const KeptRow& names, const KeptRow* units) {
  std::vector<XlsxColumn> out;
  for (const KeptCell& name : names.cells) {
    if (!is_name(name)) continue;
    XlsxColumn& column = out.emplace_back(XlsxColumn{name.cell.column, name.text});
    if (units == nullptr) continue;
    for (const KeptCell& unit : units->cells) {
      if (unit.cell.column == column.column) column.unit = unit.text;
    }
  }
  return out;
}

}  // namespace

std::optional<XlsxHeader::Place> XlsxHeader::place_above_last() const {
  const KeptRow& last = rows_.back();
  if (!is_row_of_samples(last)) return std::nullopt;
  std::size_t samples = rows_.size() - 1;
  const auto is_above_none = [&](const KeptRow& row) {  // samples, too, where a remark stands beside numbers
    return std::ranges::none_of(row.cells, is_name) || is_row_of_samples(row);
  };
  while (samples > 0 && is_above_none(rows_[samples - 1])) --samples;
  if (samples == 0) return std::nullopt;
  const bool units =
      samples > 1 && is_units_row(texts_of(rows_[samples - 1])) && names_samples(rows_[samples - 2], last);
  const std::size_t names = samples - (units ? 2 : 1);
  if (!names_samples(rows_[names], last)) return std::nullopt;
  return Place{names, samples};
}

bool XlsxHeader::take(const XlsxRow& row) {
  rows_.push_back(kept(row));
  const std::optional<Place> place = place_above_last();
  const bool again = candidate_ && place && place->names == candidate_->names;
  candidate_ = place;
  if (again || rows_.size() == most_rows) finish();
  return found() || rows_.size() == most_rows;
}

void XlsxHeader::finish() {
  if (found() || !candidate_) return;
  const bool units = candidate_->samples > candidate_->names + 1;
  columns_ = columns_of(rows_[candidate_->names], units ? &rows_[candidate_->names + 1] : nullptr);
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(candidate_->samples));
}

}  // namespace spoolflow::recording
