#include "spoolflow/recording/reader.hpp"

#include <array>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include "spoolflow/recording/csv_reader.hpp"
#include "spoolflow/recording/hdf5_reader.hpp"
#include "spoolflow/recording/mat_reader.hpp"
#include "spoolflow/recording/recording_error.hpp"

namespace spoolflow::recording {
namespace {

enum class Format { csv, mat, hdf5 };

/// By what the file begins with: MATLAB writes a text header (before an HDF5 block in v7.3), HDF5 its signature at 0 or
/// 512.
Format format_of(const std::filesystem::path& file) {
  if (file == "-") return Format::csv;
  std::ifstream in(file, std::ios::binary);
  std::array<char, 520> begin{};
  in.read(begin.data(), begin.size());
  const std::string_view text(begin.data(), static_cast<std::size_t>(in.gcount()));
  constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";
  if (text.starts_with("MATLAB ")) return Format::mat;
  if (text.starts_with(hdf5_signature)) return file.extension() == ".mat" ? Format::mat : Format::hdf5;
  if (text.size() >= 520 && text.substr(512, 8) == hdf5_signature) return Format::mat;
  if (file.extension() == ".mat") return Format::mat;
  if (file.extension() == ".h5" || file.extension() == ".hdf5") return Format::hdf5;
  return Format::csv;
}

}  // namespace

namespace {

void require_file(const std::filesystem::path& file) {
  std::error_code error;
  if (file != "-" && !std::filesystem::exists(file, error)) {
    throw RecordingError(fmt::format("{}: there is no such file; check the path", file.string()));
  }
  if (file != "-" && std::filesystem::is_regular_file(file, error) && std::filesystem::file_size(file, error) == 0) {
    throw RecordingError(fmt::format("{}: the file is empty", file.string()));
  }
}

}  // namespace

FileContents contents_of(const std::filesystem::path& file) {
  require_file(file);
  FileContents out;
  std::vector<FileColumn> columns;
  switch (format_of(file)) {
    case Format::mat:
      out.format = "MATLAB";
      columns = columns_of_mat(file);
      break;
    case Format::hdf5:
      out.format = "HDF5";
      columns = columns_of_hdf5(file);
      break;
    case Format::csv:
      out.format = "CSV";
      columns = columns_of_csv(file);
      break;
  }
  for (FileColumn& column : columns) {
    out.columns.push_back(std::move(column.name));
    out.units.push_back(std::move(column.unit));
  }
  return out;
}

std::unique_ptr<Reader> open_reader(const std::filesystem::path& file, const ReadOptions& options) {
  require_file(file);
  switch (format_of(file)) {
    case Format::mat:
      return open_mat(file, options);
    case Format::hdf5:
      return open_hdf5(file, options);
    case Format::csv:
      break;
  }
  return open_csv(file, options);
}

Recording read_recording(const std::filesystem::path& file, const ReadOptions& options) {
  const std::unique_ptr<Reader> reader = open_reader(file, options);
  Recording out;
  out.file = file;
  SampleBlock block;
  while (reader->next(block)) {
    for (std::size_t c = 0; c < channel_count; ++c) {
      out.columns[c].insert(out.columns[c].end(), block.columns[c].begin(), block.columns[c].end());
    }
  }
  return out;
}

}  // namespace spoolflow::recording
