#pragma once
/// Consecutive samples of one valve, a tenth of a second to a second of them, as they travel from a site to the fleet.
/// Laid out in docs/formats/block.md.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "addons/live/blocks/site_report.hpp"
#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::fleet {

inline constexpr std::size_t longest_valve_name = 65;  ///< site, '/', the valve's id at the site
inline constexpr std::size_t most_samples = 32768;     ///< of one block
inline constexpr std::size_t largest_block = 1 << 20;  ///< bytes, as a NATS server takes them

struct Block {
  std::string valve{};         ///< "SITE/ID"
  std::string model_sha256{};  ///< of the model file that is in force from this block on; 64 hexadecimal digits
  std::uint64_t session = 1;   ///< of the site's store, ascending: numbers begin at 1 with each
  std::uint64_t number = 1;    ///< that of the block before and one more
  std::uint64_t first = 1;     ///< below `number` where the site has lost the blocks from this one on; else the same
  std::int64_t wall_ms = 0;    ///< of the site's clock when the block was closed, since 1970-01-01 UTC
  std::vector<estimation::TimedSample> samples{};  ///< on their grids (on_grid)
  std::optional<SiteReport> report{};              ///< instead of samples, of a site that estimates by itself
  std::string set_aside{};  ///< does not travel: why nothing is made of the content, which is empty then
};

/// Samples must be on their grids, at most most_samples; names as long as stated. The same block gives the same bytes.
[[nodiscard]] std::vector<std::uint8_t> write_block(const Block& block);

/// Why bytes are no block.
enum class NoBlock : std::uint8_t {
  wrong_length,
  no_mark,
  other_version,
  wrong_checksum,
  wrong_name,     ///< of the valve
  wrong_number,   ///< of the header
  wrong_content,  ///< the header is whole
};
/// Continues "the block is".
[[nodiscard]] std::string_view name(NoBlock reason);

/// Every check before anything is made of the content; nothing larger is made than its header's bounded counts allow.
/// Whatever it takes a database keeps and a page shows: names and texts, their lengths, finite numbers, times.
[[nodiscard]] std::variant<Block, NoBlock> read_block(std::span<const std::uint8_t> bytes);
/// The header alone, of a block whose content may be wrong; nothing where the header or the checksum is.
[[nodiscard]] std::optional<Block> read_block_header(std::span<const std::uint8_t> bytes);

/// The partition that a valve belongs to, below partition_count: CRC-32 of its name modulo that.
inline constexpr std::uint32_t partition_count = 16;
[[nodiscard]] std::uint32_t partition_of(std::string_view valve);

}  // namespace spoolflow::fleet
