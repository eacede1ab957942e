#include "spoolflow/recording/written_tables/table_format.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace spoolflow::recording {
namespace {

/// Formats that people may hope for and that are not written.
constexpr auto promises = std::to_array<std::string_view>(
    {"xlsx", "xls", "ods", "tdms", "mf4",   "mdf",  "nc", "feather", "arrow", "bag", "db3", "npz",
     "npy",  "pkl", "orc", "json", "jsonl", "html", "pq", "hdf",     "zip",   "gz",  "zst", "mcap"});

std::string small_letters(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

}  // namespace

std::string_view suffix(TableFormat format) {
  constexpr std::array<std::string_view, all_table_formats.size()> suffixes{"csv", "parquet", "h5", "mat"};
  return suffixes[static_cast<std::size_t>(format)];
}

std::optional<TableFormat> table_format(std::string_view name) {
  const std::string small = small_letters(name);
  if (small == "hdf5") return TableFormat::hdf5;
  for (const TableFormat format : all_table_formats) {
    if (small == suffix(format)) return format;
  }
  return std::nullopt;
}

TableFormat table_format_of(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  const std::string_view name = extension.empty() ? std::string_view() : std::string_view(extension).substr(1);
  if (const auto format = table_format(name)) return *format;
  if (std::ranges::find(promises, small_letters(name)) == promises.end()) return TableFormat::csv;
  throw std::invalid_argument(
      fmt::format("cannot write {}: {} is no format that is written here; name a file that ends in .csv, .parquet, "
                  ".h5 or .mat",
                  file.string(), extension));
}

void refuse_other_than_csv(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  const std::string name =
      small_letters(extension.empty() ? std::string_view() : std::string_view(extension).substr(1));
  const auto format = table_format(name);
  if (format ? *format == TableFormat::csv : std::ranges::find(promises, name) == promises.end()) return;
  throw std::invalid_argument(
      fmt::format("cannot write {}: this is written as CSV alone; name a file that ends in .csv", file.string()));
}

}  // namespace spoolflow::recording
