#include "spoolflow/recording/open_table.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/confined_table.hpp"
#include "spoolflow/recording/files/hdf5_table.hpp"
#include "spoolflow/recording/matlab/mat_table.hpp"
#include "spoolflow/recording/mdf4/mdf4_table.hpp"
#include "spoolflow/recording/tdms/tdms_table.hpp"
#include "spoolflow/recording/text/paired_table.hpp"

namespace spoolflow::recording {
namespace {

std::unique_ptr<VectorTable> refuse_workbook(const std::filesystem::path& file) {
  throw RecordingError(
      fmt::format("{}: is a zip archive, such as an Excel workbook, which the add-on 'formats' reads, and that is not "
                  "built in; in the sources `./run formats` builds it; or save the sheet as CSV",
                  file.string()));
}

/// Of formats that a sandboxed process reads.
OpenVectors opener(FileFormat format) {
  switch (format) {
    case FileFormat::mat:
      return open_mat_table;
    case FileFormat::mdf4:
      return open_mdf4_table;
    case FileFormat::tdms:
      return open_tdms_table;
    case FileFormat::xlsx:
      return workbook_opener() != nullptr ? workbook_opener() : refuse_workbook;
    default:
      return open_hdf5_table;
  }
}

}  // namespace

OpenVectors& workbook_opener() {
  static OpenVectors of_the_program = nullptr;
  return of_the_program;
}

bool takes_a_process(const std::filesystem::path& file) {
  std::error_code failure;
  if (file == "-" || !std::filesystem::is_regular_file(file, failure)) return false;  // a pipe's bytes come only once
  try {
    std::array<char, format_bytes> beginning{};
    const std::size_t begun = InputBytes(file).read(beginning.data(), beginning.size());
    return format_of({beginning.data(), begun}, file) != FileFormat::csv;
  } catch (const std::exception&) {
    return false;
  }
}

std::unique_ptr<ForkServer> fork_server_for(const std::vector<std::filesystem::path>& files) {
  if (std::ranges::none_of(files, takes_a_process)) return nullptr;
  return std::make_unique<ForkServer>();
}

OpenTable open_sample_table(const std::filesystem::path& file, CsvTable::Text text) {
  return open_sample_table(std::make_unique<InputBytes>(file), text);
}

OpenTable open_sample_table(std::unique_ptr<InputBytes> input, CsvTable::Text text) {
  std::vector<char> beginning(format_bytes);
  std::size_t begun = 0;
  const auto enough = [&] {
    return begun == format_bytes || (input->comes_bit_by_bit() && header_is_whole({beginning.data(), begun}));
  };
  for (std::size_t got = 1; got > 0 && !enough(); begun += got) {
    got = input->read_some(beginning.data() + begun, format_bytes - begun);
  }
  beginning.resize(begun);
  const FileFormat format = format_of({beginning.data(), beginning.size()}, input->name());
  if (format == FileFormat::csv) {
    return {format, open_text_table(std::move(input), std::move(beginning), text)};
  }
  if (!input->is_named_file()) {
    throw RecordingError(
        fmt::format("{}: is {} {} file, which can only be read from a file that is named, not through a pipe or "
                    "standard input; name it",
                    input->name(), format == FileFormat::tdms || format == FileFormat::mat ? "a" : "an", name(format)));
  }
  return {format, open_confined(input->name(), *input->size(), opener(format), text != CsvTable::Text::refused)};
}

}  // namespace spoolflow::recording
