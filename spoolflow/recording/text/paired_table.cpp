#include "spoolflow/recording/text/paired_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/declared_size.hpp"
#include "spoolflow/recording/files/matrix_names.hpp"

namespace spoolflow::recording {
namespace {

/// Short rows of a wide table take more memory than the file: within the bounds of other formats.
std::vector<std::vector<double>> all_numbers(CsvTable& text, const std::string& file) {
  constexpr std::size_t buffer_numbers = std::size_t{1} << 18;
  const std::size_t block_rows = 1 + buffer_numbers / text.columns().size();
  std::vector<std::size_t> all(text.columns().size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
  text.select(all);
  std::vector<std::vector<double>> out(all.size()), block(all.size(), std::vector<double>(block_rows));
  std::vector<double*> places;
  for (std::vector<double>& values : block) places.push_back(values.data());
  for (std::size_t rows = text.read(places, block_rows); rows > 0; rows = text.read(places, block_rows)) {
    for (std::size_t k = 0; k < out.size(); ++k)
      out[k].insert(out[k].end(), block[k].begin(), block[k].begin() + static_cast<std::ptrdiff_t>(rows));
    DeclaredSize(file, text.bytes_read())
        .add(text.columns().back().name, out.back().size(), out.size(), sizeof(double));
  }
  return out;
}

std::size_t samples_in(const std::vector<double>& times) {
  const auto last = std::find_if(times.rbegin(), times.rend(), [](double time) { return !std::isnan(time); });
  return static_cast<std::size_t>(times.rend() - last);
}

/// "time" of "time #2".
std::string less_count(const std::string& name) {
  return name.substr(0, name.rfind(" #"));
}

}  // namespace

PairedTable::PairedTable(std::unique_ptr<CsvTable> text, const std::string& file) : VectorTable(file) {
  text->let_infinite_pass();
  text->count_text();
  const std::vector<FileColumn>& all = text->columns();
  std::vector<std::vector<double>> read = all_numbers(*text, file);
  std::vector<std::size_t> same(all.size()), distinct;  // the first of equal times, and all that are first
  std::vector<std::size_t> ends(all.size());            // samples of a time
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].own_time) continue;
    read[k].resize(samples_in(read[k]));
    const auto before = std::ranges::find_if(distinct, [&](std::size_t time) { return read[time] == read[k]; });
    same[k] = before == distinct.end() ? k : *before;
    if (before == distinct.end()) distinct.push_back(k);
  }
  std::vector<FileColumn> columns;
  std::vector<std::size_t> place(all.size());  // of a time in this table
  for (std::size_t k = 0, kept = 0; k < all.size(); ++k) {
    place[k] = kept;
    if (all[k].own_time || same[k] == k) ++kept;
    if (!all[k].own_time) ends[k] = read[k].size();
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    FileColumn column = all[k];
    if (!column.own_time) {
      if (same[k] != k) continue;
      column.name = less_count(column.name);
      const auto called_so = [&](std::size_t time) { return less_count(all[time].name) == column.name; };
      if (std::ranges::count_if(distinct, called_so) > 1 && k + 1 < all.size()) column.name += " of " + all[k + 1].name;
    } else {
      read[k].resize(ends[*column.own_time]);
      column.own_time = place[same[*column.own_time]];
    }
    columns.push_back(std::move(column));
    values_.push_back(std::move(read[k]));
    text_.push_back(text->text_cells()[k]);
  }
  number_equal_names(columns);
  for (std::size_t k = 0; k < columns.size(); ++k) add({columns[k], values_[k].size()});
}

void PairedTable::chosen(const std::vector<std::size_t>& columns) {
  chosen_text_.clear();
  for (const std::size_t column : columns) {
    chosen_text_.push_back(text_[column]);
    if (text_passes_ || text_[column].count == 0) continue;
    throw RecordingError(fmt::format(
        "{}, column '{}': {} is not a number; correct it, or leave the cell empty where a sample is missing", file(),
        this->columns()[column].name, text_[column].first));
  }
}

std::unique_ptr<SampleTable> open_text_table(std::unique_ptr<InputBytes> input, std::vector<char> beginning,
                                             CsvTable::Text text) {
  const std::string file = input->name();
  auto csv = std::make_unique<CsvTable>(std::move(input), std::move(beginning), text);
  if (!csv->has_several_times()) return csv;
  if (text == CsvTable::Text::left_out) {
    throw RecordingError(
        fmt::format("{}: states a time for each channel, which is not read from a source that runs on; send one column "
                    "of times",
                    file));
  }
  auto out = std::make_unique<PairedTable>(std::move(csv), file);
  if (text != CsvTable::Text::refused) out->take_text_as_missing();
  return out;
}

void PairedTable::copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) {
  const std::vector<double>& values = values_[column];
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first), count, out);
}

}  // namespace spoolflow::recording
