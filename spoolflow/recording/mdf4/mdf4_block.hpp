#pragma once
/// The blocks that an MDF 4 file is made of: a name, links to others, and data (ASAM MDF 4.1, chapter 4).
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/bytes/byte_reader.hpp"
#include "spoolflow/recording/bytes/file_bytes.hpp"

namespace spoolflow::recording {

inline constexpr std::uint64_t mdf4_head_bytes = 24;  ///< before the links of a block

/// What stands before the links of a block.
struct Mdf4Head {
  std::string id;           ///< "##DG"
  std::uint64_t at = 0;     ///< byte of the file
  std::uint64_t bytes = 0;  ///< with the head
  std::uint64_t links = 0;  ///< how many
};

struct Mdf4Block {
  Mdf4Head head;
  std::vector<std::uint64_t> links;
  std::vector<std::uint8_t> data;
  std::string what;  ///< "run.mf4: the block ##DG at byte 168", for messages

  /// Zero where there is none.
  [[nodiscard]] std::uint64_t link(std::size_t k) const { return k < links.size() ? links[k] : 0; }
  [[nodiscard]] ByteReader reader() const { return {data, ByteOrder::lowest_first, what}; }
};

/// Throws RecordingError where no such block stands there, or where the file ends within it.
[[nodiscard]] Mdf4Head read_head(const FileBytes& file, std::uint64_t at);
/// The whole block, up to 16 MiB. `id`: what it must be; empty: any. Throws RecordingError.
[[nodiscard]] Mdf4Block read_block(const FileBytes& file, std::uint64_t at, std::string_view id);

/// The text of a ##TX block, or of the element <TX> of a ##MD block, as UTF-8; empty where the link is zero.
[[nodiscard]] std::string read_text(const FileBytes& file, std::uint64_t at);

/// "...: why; it is damaged, copy or record it again".
[[noreturn]] void refuse_mdf4(const std::string& what, const std::string& why);

}  // namespace spoolflow::recording
