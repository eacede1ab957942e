#include "addons/live/blocks/block.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <zstd.h>

#include "addons/live/blocks/columns.hpp"
#include "addons/live/blocks/steps.hpp"
#include "spoolflow/numerics/crc32.hpp"
#include "spoolflow/numerics/little_endian.hpp"

namespace spoolflow::fleet {
namespace {

constexpr std::array<std::uint8_t, 4> block_mark{'S', 'F', 'B', 'L'};
constexpr std::uint8_t of_samples = 1, of_a_report = 2;  // versions
constexpr std::size_t largest_report = 1 << 22;          // bytes before it was compressed
constexpr std::size_t header_bytes = 104, checksum_bytes = 4, hash_bytes = 32, hash_at = 72;
constexpr std::uint16_t known_channels = (1U << block_channels.size()) - 1;
/// Quick, and the differences are small numbers already.
constexpr int zstd_level = 3;

using numerics::little_endian;
using numerics::put_little_endian;

constexpr std::string_view digits = "0123456789abcdef";

void put_hash(std::vector<std::uint8_t>& bytes, const std::string& hexadecimal) {
  for (std::size_t k = 0; k < hash_bytes; ++k) {
    std::size_t value = 0;
    for (std::size_t half = 0; half < 2; ++half) {
      const char c = 2 * k + half < hexadecimal.size() ? hexadecimal[2 * k + half] : '0';
      value = 16 * value + std::min(digits.find(c), std::size_t{15});
    }
    bytes.push_back(static_cast<std::uint8_t>(value));
  }
}

/// SITE/ID, of the letters that a site's file takes for both.
bool is_valve_name(std::string_view text) {
  const auto plain = [](std::string_view part, std::string_view others) {
    return !part.empty() && part.size() <= longest_valve_name / 2 && std::all_of(part.begin(), part.end(), [&](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
             others.find(c) != std::string_view::npos;
    });
  };
  const std::size_t slash = std::min(text.find('/'), text.size());
  return plain(text.substr(0, slash), "_-") && plain(text.substr(std::min(slash + 1, text.size())), "_-.");
}

std::string hash_text(std::span<const std::uint8_t> bytes) {
  std::string out;
  for (const std::uint8_t byte : bytes) {
    out += digits[byte >> 4U];
    out += digits[byte & 15U];
  }
  return out;
}

}  // namespace

std::vector<std::uint8_t> write_block(const Block& block) {
  const ColumnLayout layout = layout_of(block.samples);
  const std::vector<std::uint8_t> body =
      block.report ? write_report(*block.report) : write_columns(layout, block.samples);
  std::vector<std::uint8_t> out(block_mark.begin(), block_mark.end());
  out.push_back(block.report ? of_a_report : of_samples);
  out.push_back(static_cast<std::uint8_t>(block.valve.size()));
  put_little_endian(out, layout.channels);
  put_little_endian(out, block.session);
  put_little_endian(out, block.number);
  put_little_endian(out, block.first);
  put_little_endian(out, static_cast<std::uint64_t>(block.wall_ms));
  put_little_endian(out, static_cast<std::uint64_t>(layout.first_time));
  put_little_endian(out, static_cast<std::uint64_t>(layout.period));
  put_little_endian(out, static_cast<std::uint32_t>(block.samples.size()));
  put_little_endian(out, static_cast<std::uint32_t>(body.size()));
  put_little_endian(out, std::uint64_t{0});
  put_hash(out, block.model_sha256);
  out.insert(out.end(), block.valve.begin(), block.valve.end());
  const std::size_t before = out.size();
  if (!body.empty()) {
    out.resize(before + ZSTD_compressBound(body.size()));
    out.resize(before + ZSTD_compress(out.data() + before, out.size() - before, body.data(), body.size(), zstd_level));
  }
  put_little_endian(out, numerics::crc32(out));
  return out;
}

std::string_view name(NoBlock reason) {
  constexpr std::array<std::string_view, 7> names{
      "of another length than a block has",
      "not begun by SFBL",
      "of another version than 1 and 2",
      "damaged: its checksum is another",
      "of a valve whose name is not SITE/ID, each up to 32 letters, digits, '_' and '-' ('.' in an ID)",
      "outside its format: a number of its header (clock 1970 to 9999, first number 1 to number, samples to 32768)",
      "without sense: its content has other lengths than its header says, or texts or numbers that nobody can keep"};
  return names[static_cast<std::size_t>(reason)];
}

namespace {

/// Where the content of a block lies, and how it is to be read.
struct Content {
  ColumnLayout layout{};
  bool reports = false;
  std::size_t length = 0;  ///< before it was compressed
  std::span<const std::uint8_t> frame{};
};

/// What the header says; false where one of its numbers has no sense.
bool read_header(std::span<const std::uint8_t> bytes, Block& out, ColumnLayout& layout) {
  layout.channels = little_endian<std::uint16_t>(bytes, 6);
  out.session = little_endian<std::uint64_t>(bytes, 8);
  out.number = little_endian<std::uint64_t>(bytes, 16);
  out.first = little_endian<std::uint64_t>(bytes, 24);
  out.wall_ms = static_cast<std::int64_t>(little_endian<std::uint64_t>(bytes, 32));
  layout.first_time = static_cast<std::int64_t>(little_endian<std::uint64_t>(bytes, 40));
  layout.period = static_cast<std::int64_t>(little_endian<std::uint64_t>(bytes, 48));
  layout.samples = little_endian<std::uint32_t>(bytes, 56);
  out.model_sha256 = hash_text(bytes.subspan(hash_at, hash_bytes));
  const auto id = bytes.subspan(header_bytes, bytes[5]);
  out.valve.assign(id.begin(), id.end());
  constexpr std::int64_t most_period = std::int64_t{1} << 31U;
  const bool counts =
      out.first >= 1 && out.first <= out.number && out.number < largest_count && out.session < largest_count;
  const bool times = layout.first_time >= -last_time && layout.first_time <= last_time &&
                     layout.period >= -most_period && layout.period <= most_period;
  return counts && times && is_wall_ms(out.wall_ms) && (layout.channels & ~known_channels) == 0 &&
         layout.samples <= most_samples && little_endian<std::uint64_t>(bytes, 64) == 0;
}

/// Everything but the content.
std::optional<NoBlock> open_block(std::span<const std::uint8_t> bytes, Block& out, Content& content) {
  if (bytes.size() < header_bytes + checksum_bytes || bytes.size() > largest_block) return NoBlock::wrong_length;
  if (!std::equal(block_mark.begin(), block_mark.end(), bytes.begin())) return NoBlock::no_mark;
  if (bytes[4] != of_samples && bytes[4] != of_a_report) return NoBlock::other_version;
  const std::size_t body_at = header_bytes + bytes[5];
  const std::size_t end = bytes.size() - checksum_bytes;
  if (body_at > end) return NoBlock::wrong_length;
  if (numerics::crc32(bytes.first(end)) != little_endian<std::uint32_t>(bytes, end)) return NoBlock::wrong_checksum;

  const bool numbers = read_header(bytes, out, content.layout);
  if (!is_valve_name(out.valve)) return NoBlock::wrong_name;
  if (!numbers) return NoBlock::wrong_number;
  content.reports = bytes[4] == of_a_report;
  content.length = little_endian<std::uint32_t>(bytes, 60);
  content.frame = bytes.subspan(body_at, end - body_at);
  return std::nullopt;
}

bool read_content(const Content& content, Block& out) {
  const auto& [layout, reports, length, frame] = content;
  if (reports && (layout.samples != 0 || layout.channels != 0)) return false;
  const std::size_t most = reports ? largest_report : layout.samples * longest_number * (block_channels.size() + 1);
  if (length > most || (length == 0) != frame.empty()) return false;
  std::vector<std::uint8_t> body(length);
  if (length > 0) {
    if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != length) return false;
    const std::size_t written = ZSTD_decompress(body.data(), length, frame.data(), frame.size());
    if (ZSTD_isError(written) != 0 || written != length) return false;
  }
  return reports ? read_report(body, out.report.emplace()) : read_columns(layout, body, out.samples);
}

}  // namespace

std::variant<Block, NoBlock> read_block(std::span<const std::uint8_t> bytes) {
  Block out;
  Content content;
  if (const auto wrong = open_block(bytes, out, content)) return *wrong;
  if (!read_content(content, out)) return NoBlock::wrong_content;
  return out;
}

std::optional<Block> read_block_header(std::span<const std::uint8_t> bytes) {
  Block out;
  Content content;
  if (open_block(bytes, out, content)) return std::nullopt;
  return out;
}

std::uint32_t partition_of(std::string_view valve) {
  const std::vector<std::uint8_t> bytes(valve.begin(), valve.end());
  return numerics::crc32(bytes) % partition_count;
}

}  // namespace spoolflow::fleet
