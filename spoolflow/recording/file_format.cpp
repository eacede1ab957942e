#include "spoolflow/recording/file_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {
namespace {

using namespace std::string_view_literals;

struct UnreadFormat {
  std::string_view mark;
  std::string_view what;
  std::string_view remedy;
};
constexpr std::string_view as_csv = "export the recording from it as CSV with a line of names above the numbers";
constexpr std::string_view of_numpy =
    "save it as CSV with a line of names, as HDF5 by h5py, or as MAT by scipy.io.savemat";
constexpr std::string_view unpack = "unpack it, and name the recording in it";
constexpr std::string_view another = "name the recording itself";
constexpr std::array<UnreadFormat, 34> unread_formats{{
    {"PK\x05\x06", "an empty zip archive", another},
    {"\xD0\xCF\x11\xE0", "an Excel workbook of before 2007 (.xls), or one that a password protects",
     "save it as .xlsx without a password, or the sheet as CSV"},
    {"TDSh", "the index that stands beside a TDMS file and holds no samples", "name the file that ends in .tdms"},
    {"\x1F\x8B", "compressed by gzip", "pipe it: gunzip -c FILE | spoolflow ... -"},
    {"BZh91AY&SY", "compressed by bzip2", "pipe it: bunzip2 -c FILE | spoolflow ... -"},
    {"\xFD\x37zXZ", "compressed by xz", "pipe it: unxz -c FILE | spoolflow ... -"},
    {"\x28\xB5\x2F\xFD", "compressed by zstd", "pipe it: unzstd -c FILE | spoolflow ... -"},
    {"7z\xBC\xAF", "a 7-Zip archive", unpack},
    {"Rar!", "a RAR archive", unpack},
    {"%PDF", "a PDF document", another},
    {"%!PS", "a PostScript document", another},
    {"{\\rtf", "a document in Rich Text Format", another},
    {"\x89PNG", "a picture (PNG)", another},
    {"\xFF\xD8\xFF", "a picture (JPEG)", another},
    {"GIF8", "a picture (GIF)", another},
    {"II*", "a picture (TIFF)", another},
    {"MM\0*"sv, "a picture (TIFF)", another},
    {"RIFF", "sound or video (RIFF)", another},
    {"\x7F"
     "ELF",
     "a program (ELF)", another},
    {"MZ\x90", "a program for Windows", another},
    {"\xCA\xFE\xBA\xBE", "a program (Mach-O or Java)", another},
    {"\0asm"sv, "a program (WebAssembly)", another},
    {"SQLite format 3", "an SQLite database", as_csv},
    {"\x80\x02", "a pickle of Python", of_numpy},
    {"\x80\x03", "a pickle of Python", of_numpy},
    {"\x80\x04", "a pickle of Python", of_numpy},
    {"\x80\x05", "a pickle of Python", of_numpy},
    {"\x93NUMPY", "an array of NumPy (.npy)", of_numpy},
    {"PAR1", "a Parquet file", "save it as CSV or HDF5"},
    {"ARROW1", "an Arrow or Feather file", "save it as CSV or HDF5"},
    {"FEA1", "a Feather file", "save it as CSV or HDF5"},
    {"LOGG", "a log of bus messages (.blf)", "decode it with the bus's database, and save the signals as MDF 4 or CSV"},
    {"#ROSBAG", "a bag of ROS", as_csv},
    {"\x89MCAP", "a log of MCAP", as_csv},
}};

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1A\n";

/// Bytes 124 to 127 of a MATLAB file: version 0x0100 (5) or 0x0200 (7.3) and the byte order, either way round.
bool has_mat_version(std::string_view beginning) {
  if (beginning.size() < 128) return false;
  const std::string_view mark = beginning.substr(124, 4);
  return mark == "\0\1IM"sv || mark == "\1\0MI"sv || mark == "\0\2IM"sv || mark == "\2\0MI"sv;
}

/// Such as RIFF: four capitals, with which names of columns may begin.
bool could_begin_text(std::string_view mark) {
  constexpr std::size_t short_mark = 6;
  return mark.size() <= short_mark &&
         std::ranges::all_of(mark, [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '*'; });
}

/// Text holds no zero byte, and a table of numbers more than a few bytes.
bool could_be_text(std::string_view beginning) {
  constexpr std::size_t few = 8;
  return beginning.size() >= few && beginning.find('\0') == std::string_view::npos;
}

/// Whether the first part of a zip archive is an array of NumPy.
bool begins_npz(std::string_view beginning) {
  constexpr std::size_t head_bytes = 30, name_length_at = 26;
  if (!beginning.starts_with("PK\x03\x04") || beginning.size() < head_bytes) return false;
  const auto length = static_cast<unsigned char>(beginning[name_length_at]);
  return beginning.substr(head_bytes, length).ends_with(".npy");
}

[[noreturn]] void refuse_format(std::string_view what, std::string_view remedy, const std::filesystem::path& file) {
  throw RecordingError(fmt::format("{}: is {}, which is not read here; {}", file.string(), what, remedy));
}

}  // namespace

std::string_view name(FileFormat format) {
  constexpr std::array<std::string_view, 6> names{"CSV", "MATLAB", "HDF5", "TDMS", "MDF 4", "Excel"};
  return names[static_cast<std::size_t>(format)];
}

std::optional<FileFormat> format_by_ending(const std::filesystem::path& file) {
  constexpr std::array endings{
      std::pair{".mat", FileFormat::mat},  std::pair{".h5", FileFormat::hdf5},   std::pair{".hdf5", FileFormat::hdf5},
      std::pair{".hdf", FileFormat::hdf5}, std::pair{".tdms", FileFormat::tdms}, std::pair{".mf4", FileFormat::mdf4},
      std::pair{".mdf", FileFormat::mdf4}, std::pair{".xlsx", FileFormat::xlsx}, std::pair{".xlsm", FileFormat::xlsx}};
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const auto& [known, format] : endings) {
    if (ending == known) return format;
  }
  return std::nullopt;
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
  if (begins_npz(beginning)) refuse_format("arrays of NumPy (.npz)", of_numpy, file);
  if (beginning.starts_with("PK\x03\x04")) return FileFormat::xlsx;  // or another zip archive: its reader decides
  for (const UnreadFormat& format : unread_formats) {
    const bool certain = !could_begin_text(format.mark) || beginning.find('\0') != std::string_view::npos;
    if (certain && beginning.starts_with(format.mark)) refuse_format(format.what, format.remedy, file);
  }
  const std::optional<FileFormat> by_ending = format_by_ending(file);
  if (!by_ending || beginning.empty() || could_be_text(beginning)) return FileFormat::csv;
  if (*by_ending == FileFormat::mat) return FileFormat::mat;  // of version 4, which has no mark
  throw RecordingError(
      fmt::format("{}: ends in {}, but does not begin as {} files do: it is damaged or cut off at its beginning, or is "
                  "no recording; copy it again from where it was recorded, or save the recording there again",
                  file.string(), file.extension().string(), name(*by_ending)));
}

}  // namespace spoolflow::recording
