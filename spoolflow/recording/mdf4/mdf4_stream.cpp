#include "spoolflow/recording/mdf4/mdf4_stream.hpp"

#include <algorithm>
#include <array>
#include <zlib.h>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::uint64_t packed_head_bytes = 24;
constexpr std::uint64_t largest_unpacked = std::uint64_t{64} << 20U;  // the standard recommends 4 MiB

/// Data of records, of values by columns, or of what is invalid of these; `kind` without the block's ##.
bool holds_data(std::string_view kind) {
  return kind == "DT" || kind == "DV" || kind == "DI";
}

}  // namespace

Mdf4Stream::Mdf4Stream(const FileBytes& file, std::uint64_t at, DeclaredSize& declared, Mdf4Part part) : file_(file) {
  if (at == 0) return;
  const Mdf4Head head = read_head(file_, at);
  by_columns_ = head.id == "##DV" || head.id == "##LD";
  if (head.id == "##LD") {
    add_columns(at, declared, part);
  } else if (part == Mdf4Part::invalid_apart) {
    return;
  } else if (head.id == "##HL") {
    const Mdf4Block block = read_block(file_, at, "##HL");
    add_list(block.link(0), declared);
  } else if (head.id == "##DL") {
    add_list(at, declared);
  } else {
    add(at, declared);
  }
}

/// A list of a chain, which is refused where it is met again.
Mdf4Block Mdf4Stream::taken(std::uint64_t at, std::string_view id) {
  Mdf4Block list = read_block(file_, at, id);
  if (!lists_.insert(at).second) refuse_mdf4(list.what, "the lists of its data lead round in a circle");
  return list;
}

/// Lists LD: links to the next list, to each block of values and, where their flags say so, to as many of what is
/// invalid.
void Mdf4Stream::add_columns(std::uint64_t at, DeclaredSize& declared, Mdf4Part part) {
  constexpr std::uint32_t with_invalid = std::uint32_t{1} << 31U;
  while (at != 0) {
    const Mdf4Block list = taken(at, "##LD");
    ByteReader bytes = list.reader();
    const bool apart = (bytes.u32() & with_invalid) != 0;
    const std::uint64_t count = bytes.u32(), behind = list.links.empty() ? 0 : list.links.size() - 1;
    if (count > behind / (apart ? 2 : 1)) {
      refuse_mdf4(list.what, fmt::format("{} blocks are said to be listed by {} links", count, behind));
    }
    const bool invalid = part == Mdf4Part::invalid_apart;
    for (std::uint64_t k = 0; k < count && (apart || !invalid); ++k) {
      const std::uint64_t block = list.link(static_cast<std::size_t>(1 + k + (invalid ? count : 0)));
      if (block != 0) add(block, declared);
    }
    at = list.link(0);
  }
}

void Mdf4Stream::add_list(std::uint64_t at, DeclaredSize& declared) {
  while (at != 0) {
    const Mdf4Block list = taken(at, "##DL");
    for (std::size_t k = 1; k < list.links.size(); ++k) {
      if (list.links[k] != 0) add(list.links[k], declared);
    }
    at = list.link(0);
  }
}

void Mdf4Stream::add(std::uint64_t at, DeclaredSize& declared) {
  const Mdf4Head head = read_head(file_, at);
  if (head.id == "##DZ") return add_packed(head, declared);
  if (!holds_data(std::string_view(head.id).substr(2))) {
    refuse_mdf4(fmt::format("{}: the block {} at byte {}", file_.name(), head.id.substr(2), at),
                "samples are said to stand there, which it does not hold");
  }
  const std::uint64_t begin = mdf4_head_bytes + 8 * head.links, bytes = head.bytes - begin;
  declared.add("the data of a group", bytes, 1, 1);
  if (bytes > 0) pieces_.push_back({size_, bytes, at + begin, 0, 0});
  size_ += bytes;
}

void Mdf4Stream::add_packed(const Mdf4Head& head, DeclaredSize& declared) {
  const std::string what = fmt::format("{}: the block DZ at byte {}", file_.name(), head.at);
  std::array<std::uint8_t, packed_head_bytes> raw{};
  if (head.bytes < mdf4_head_bytes + raw.size()) refuse_mdf4(what, "it is too short");
  file_.read(head.at + mdf4_head_bytes, raw);
  ByteReader bytes(raw, ByteOrder::lowest_first, what);
  const std::string_view of = bytes.text(2);
  const std::uint8_t kind = bytes.u8();
  bytes.skip(1);
  const std::uint32_t row_bytes = bytes.u32();
  const std::uint64_t unpacked = bytes.u64(), packed = bytes.u64();
  if (!holds_data(of)) {
    refuse_mdf4(what, fmt::format("it holds a block {}, where DT, DV or DI is wanted", of));
  }
  if (kind > 1) {
    throw RecordingError(fmt::format(
        "{}: it is packed in way {} (of MDF 4.3), where 0 and 1 are read (deflate, also transposed); save it "
        "with one of these, or unpacked",
        what, kind));
  }
  if (packed == 0 || packed > head.bytes - mdf4_head_bytes - raw.size() || unpacked > largest_unpacked) {
    refuse_mdf4(what, fmt::format("{} bytes are said to be packed in {}", unpacked, packed));
  }
  if (kind == 1 && row_bytes == 0) refuse_mdf4(what, "it is transposed by rows of no length");
  declared.add("the data of a group", unpacked, 1, 1);
  if (unpacked == 0) return;
  pieces_.push_back({size_, unpacked, head.at + mdf4_head_bytes + raw.size(), packed, kind == 1 ? row_bytes : 0});
  size_ += unpacked;
}

void Mdf4Stream::unpack(const Piece& piece) {
  std::vector<std::uint8_t> packed(static_cast<std::size_t>(piece.packed));
  file_.read(piece.at, packed);
  unpacked_first_ = ~std::uint64_t{0};
  unpacked_.resize(static_cast<std::size_t>(piece.bytes));
  uLongf count = unpacked_.size();
  if (::uncompress(unpacked_.data(), &count, packed.data(), packed.size()) != Z_OK || count != unpacked_.size()) {
    refuse_mdf4(fmt::format("{}: the block DZ before byte {}", file_.name(), piece.at), "it cannot be unpacked");
  }
  unpacked_first_ = piece.first;
  if (piece.row_bytes == 0) return;
  const std::size_t columns = piece.row_bytes, rows = unpacked_.size() / columns;
  std::vector<std::uint8_t> upright = unpacked_;  // with what does not fill a row at its end
  for (std::size_t column = 0; rows > 0 && column < columns; ++column) {
    for (std::size_t row = 0; row < rows; ++row) upright[row * columns + column] = unpacked_[column * rows + row];
  }
  unpacked_ = std::move(upright);
}

void Mdf4Stream::read(std::uint64_t at, std::span<std::uint8_t> out) {
  auto piece = std::ranges::upper_bound(pieces_, at, {}, &Piece::first);
  while (!out.empty()) {
    if (piece == pieces_.begin() || at >= size_) refuse_mdf4(file_.name(), "its records end too soon");
    const Piece& from = *std::prev(piece);
    const std::uint64_t within = at - from.first;
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), from.bytes - within));
    if (from.packed == 0) {
      file_.read(from.at + within, out.first(count));
    } else {
      if (unpacked_first_ != from.first) unpack(from);
      std::copy_n(unpacked_.begin() + static_cast<std::ptrdiff_t>(within), count, out.begin());
    }
    out = out.subspan(count);
    at += count;
    ++piece;
  }
}

}  // namespace spoolflow::recording
