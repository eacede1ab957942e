/// In the place of xlsx_table.cpp where expat is not there.
#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "addons/formats/xlsx/xlsx_table.hpp"

namespace spoolflow::recording {

std::unique_ptr<VectorTable> open_xlsx_table(const std::filesystem::path& file) {
  throw RecordingError(
      fmt::format("{}: is a zip archive, such as an Excel workbook, which this build of spoolflow does not read; save "
                  "the sheet as CSV, or build with libexpat1-dev and -DSPOOLFLOW_XLSX=ON",
                  file.string()));
}

}  // namespace spoolflow::recording
