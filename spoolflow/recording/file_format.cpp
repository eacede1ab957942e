#include "spoolflow/recording/file_format.hpp"

#include <array>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {
namespace {

struct UnreadFormat {
  std::string_view mark;
  std::string_view what;
  std::string_view remedy;
};
constexpr std::array<UnreadFormat, 5> unread_formats{{
    {"PK\x05\x06", "an empty zip archive", "name the recording itself"},
    {"\xD0\xCF\x11\xE0", "an Excel workbook of before 2007 (.xls), or one that a password protects",
     "save it as .xlsx without a password, or the sheet as CSV"},
    {"TDSh", "the index that stands beside a TDMS file and holds no samples", "name the file that ends in .tdms"},
    {"\x1F\x8B", "compressed by gzip", "pipe it: gunzip -c FILE | spoolflow ... -"},
    {"%PDF", "a PDF document", "name the recording itself"},
}};

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1A\n";

/// Bytes 124 to 127 of a MATLAB file: version 0x0100 (5) or 0x0200 (7.3) and the byte order, either way round.
bool has_mat_version(std::string_view beginning) {
  using namespace std::string_view_literals;
  if (beginning.size() < 128) return false;
  const std::string_view mark = beginning.substr(124, 4);
  return mark == "\0\1IM"sv || mark == "\1\0MI"sv || mark == "\0\2IM"sv || mark == "\2\0MI"sv;
}

}  // namespace

std::string_view name(FileFormat format) {
  constexpr std::array<std::string_view, 6> names{"CSV", "MATLAB", "HDF5", "TDMS", "MDF 4", "Excel"};
  return names[static_cast<std::size_t>(format)];
}

FileFormat format_of(std::string_view beginning, const std::filesystem::path& file) {
  if (beginning.starts_with("MATLAB 5.0 MAT-file") || beginning.starts_with("MATLAB 7.3 MAT-file") ||
      has_mat_version(beginning)) {
    return FileFormat::mat;
  }
  // HDF5 allows a user block before it: the signature stands at 0, 512, 1024 and so on.
  for (const std::size_t at : {0u, 512u, 1024u, 2048u}) {
    if (beginning.size() > at && beginning.substr(at).starts_with(hdf5_signature)) return FileFormat::hdf5;
  }
  if (beginning.starts_with("TDSm")) return FileFormat::tdms;
  if (beginning.starts_with("MDF     ") || beginning.starts_with("UnFinMF ")) return FileFormat::mdf4;
  if (beginning.starts_with("PK\x03\x04")) return FileFormat::xlsx;  // or another zip archive: its reader tells
  for (const UnreadFormat& format : unread_formats) {
    if (!beginning.starts_with(format.mark)) continue;
    throw RecordingError(
        fmt::format("{}: is {}, which is not read here; {}", file.string(), format.what, format.remedy));
  }
  if (file.extension() == ".mat" && beginning.find('\0') != std::string_view::npos) return FileFormat::mat;
  return FileFormat::csv;
}

}  // namespace spoolflow::recording
