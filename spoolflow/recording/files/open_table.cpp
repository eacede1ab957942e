#include "spoolflow/recording/files/open_table.hpp"

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/confined_table.hpp"
#include "spoolflow/recording/files/hdf5_table.hpp"
#include "spoolflow/recording/files/input_bytes.hpp"
#include "spoolflow/recording/files/mat_table.hpp"

namespace spoolflow::recording {

OpenTable open_sample_table(const std::filesystem::path& file, CsvTable::Text text) {
  auto input = std::make_unique<InputBytes>(file);
  std::vector<char> beginning(format_bytes);
  beginning.resize(input->read(beginning.data(), beginning.size()));
  const FileFormat format = format_of({beginning.data(), beginning.size()}, input->name());
  if (format == FileFormat::csv) {
    return {format, std::make_unique<CsvTable>(std::move(input), std::move(beginning), text)};
  }
  if (!input->size()) {
    throw RecordingError(
        fmt::format("{}: is a {} file, which can only be read from a file, not from a pipe; save it "
                    "and name it",
                    input->name(), name(format)));
  }
  return {format, open_confined(file, *input->size(), format == FileFormat::mat ? open_mat_table : open_hdf5_table)};
}

}  // namespace spoolflow::recording
