#include "spoolflow/recording/matlab/mat_elements.hpp"

#include <array>
#include <cstdint>
#include <fstream>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {

void refuse_cut_mat_file(const std::filesystem::path& file) {
  constexpr std::uintmax_t header_bytes = 128;
  constexpr std::uintmax_t tag_bytes = 8;
  std::ifstream in(file, std::ios::binary);
  std::array<char, header_bytes> header{};
  in.read(header.data(), header.size());
  const std::uintmax_t size = std::filesystem::file_size(file);
  const bool little_endian = header[126] == 'I' && header[127] == 'M';
  const bool version_5 = header[little_endian ? 125 : 124] == 1;
  if (in && !version_5) return;
  std::uintmax_t at = header_bytes;
  while (in && at < size) {
    std::array<unsigned char, tag_bytes> tag{};
    in.seekg(static_cast<std::streamoff>(at));
    in.read(reinterpret_cast<char*>(tag.data()), tag.size());
    std::uintmax_t length = 0;
    for (std::size_t k = 0; k < 4; ++k) length |= std::uintmax_t{tag[4 + k]} << (8 * (little_endian ? k : 3 - k));
    at += tag_bytes + length;
  }
  if (at == size) return;
  throw RecordingError(
      fmt::format("{}: the MATLAB file is cut short or damaged: it has {} bytes, its variables need "
                  "{}; copy it or save it again",
                  file.string(), size, at));
}

}  // namespace spoolflow::recording
