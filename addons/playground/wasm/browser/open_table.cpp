// In place of spoolflow/recording/open_table.cpp: all files but CSV are read by a process of their own, and a browser
// has none.
#include "spoolflow/recording/open_table.hpp"

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/text/paired_table.hpp"

namespace spoolflow::recording {

OpenTable open_sample_table(const std::filesystem::path& file, CsvTable::Text text) {
  return open_sample_table(std::make_unique<InputBytes>(file), text);
}

OpenTable open_sample_table(std::unique_ptr<InputBytes> input, CsvTable::Text text) {
  std::vector<char> beginning(format_bytes);
  beginning.resize(input->read(beginning.data(), beginning.size()));
  const FileFormat format = format_of({beginning.data(), beginning.size()}, input->name());
  if (format != FileFormat::csv) {
    throw RecordingError(fmt::format(
        "{}: is {} {} file, which this page does not read; save it as CSV, or give it to the spoolflow command",
        input->name(), format == FileFormat::xlsx ? "an" : "a", name(format)));
  }
  return {format, open_text_table(std::move(input), std::move(beginning), text)};
}

}  // namespace spoolflow::recording
