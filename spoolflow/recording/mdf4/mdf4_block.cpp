#include "spoolflow/recording/mdf4/mdf4_block.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::uint64_t link_bytes = 8;
constexpr std::uint64_t longest_block = std::uint64_t{16} << 20U;

/// What XML writes for characters of its own.
std::string without_escapes(std::string text) {
  constexpr std::array<std::pair<std::string_view, char>, 5> escapes{
      {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}}};
  for (const auto& [written, meant] : escapes) {
    for (std::size_t at = text.find(written); at != std::string::npos; at = text.find(written, at + 1)) {
      text.replace(at, written.size(), 1, meant);
    }
  }
  return text;
}

std::string element_text(const std::string& xml) {
  const std::size_t begin = xml.find("<TX");
  const std::size_t open = begin == std::string::npos ? begin : xml.find('>', begin);
  const std::size_t close = open == std::string::npos ? open : xml.find("</TX>", open);
  return close == std::string::npos ? "" : without_escapes(xml.substr(open + 1, close - open - 1));
}

}  // namespace

void refuse_mdf4(const std::string& what, const std::string& why) {
  throw RecordingError(fmt::format("{}: {}; it is damaged, copy or record it again", what, why));
}

Mdf4Head read_head(const FileBytes& file, std::uint64_t at) {
  std::array<std::uint8_t, mdf4_head_bytes> raw{};
  file.read(at, raw);
  const std::string what = fmt::format("{}: the block at byte {}", file.name(), at);
  ByteReader bytes(raw, ByteOrder::lowest_first, what);
  Mdf4Head out;
  out.id = bytes.text(4);
  out.at = at;
  bytes.skip(4);
  out.bytes = bytes.u64();
  out.links = bytes.u64();
  if (!out.id.starts_with("##")) refuse_mdf4(what, "no block of MDF begins there");
  if (out.bytes < mdf4_head_bytes || out.links > (out.bytes - mdf4_head_bytes) / link_bytes) {
    refuse_mdf4(what, fmt::format("{} links in {} bytes", out.links, out.bytes));
  }
  if (!file.holds(at, out.bytes)) {
    throw RecordingError(
        fmt::format("{}: is cut short or damaged: the block {} at byte {} is said to have {} bytes, but the file has "
                    "{}; copy or record it again",
                    file.name(), out.id.substr(2), at, out.bytes, file.size()));
  }
  return out;
}

Mdf4Block read_block(const FileBytes& file, std::uint64_t at, std::string_view id) {
  Mdf4Block out{read_head(file, at), {}, {}, {}};
  out.what = fmt::format("{}: the block {} at byte {}", file.name(), out.head.id.substr(2), at);
  if (!id.empty() && out.head.id != id) refuse_mdf4(out.what, fmt::format("it should be {}", id.substr(2)));
  if (out.head.bytes > longest_block) refuse_mdf4(out.what, fmt::format("it has {} bytes", out.head.bytes));
  std::vector<std::uint8_t> raw(static_cast<std::size_t>(out.head.bytes - mdf4_head_bytes));
  file.read(at + mdf4_head_bytes, raw);
  ByteReader bytes(raw, ByteOrder::lowest_first, out.what);
  out.links.resize(static_cast<std::size_t>(out.head.links));
  for (std::uint64_t& link : out.links) link = bytes.u64();
  out.data.assign(raw.begin() + static_cast<std::ptrdiff_t>(out.links.size() * link_bytes), raw.end());
  return out;
}

std::string read_text(const FileBytes& file, std::uint64_t at) {
  if (at == 0) return {};
  const Mdf4Block block = read_block(file, at, "");
  std::string text(block.data.begin(), std::ranges::find(block.data, std::uint8_t{0}));
  if (block.head.id == "##MD") text = element_text(text);
  if (block.head.id != "##MD" && block.head.id != "##TX") refuse_mdf4(block.what, "it should be a text");
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace spoolflow::recording
