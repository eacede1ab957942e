#pragma once
/// Consecutive samples of one valve, a tenth of a second to a second of them, as they travel from a site to the fleet.
/// Version 1 has samples, version 2 a report of results (site_report.hpp); addons/fleet/tests/block_reader.py reads
/// both.
///
/// Little-endian; at most 1 MiB; a contradictory block is refused as a whole.
///
///   byte  bytes
///   0     4   the letters SFBL
///   4     1   version, 1 or 2
///   5     1   L, bytes of the valve's name, 1 to 65
///   6     2   channels of the body, one bit each, in the order below; 0 in version 2
///   8     8   session of the site's store, ascending: numbers begin at 1 with each
///   16    8   number: that of the valve's block before and one more
///   24    8   first number that this block stands for: its own, or a smaller one where the site has lost the blocks
///             from that one on
///   32    8   the site's clock when the block was closed, ms since 1970-01-01 UTC, of the years 1970 to 9999
///   40    8   time of the first sample that has one, in steps of 2^-30 s, signed; 0 in version 2
///   48    8   sampling period in steps of 2^-30 s, signed, at most 2^31 to both sides; 0 in version 2
///   56    4   samples n, at most 32768; 0 in a block that only declares lost ones, and in version 2
///   60    4   bytes of the body before it was compressed, at most 110 n; of version 2 at most 4 MiB
///   64    8   0
///   72    32  SHA-256 of the model file that is in force from this block on
///   104   L   name of the valve, SITE/ID: up to 32 letters, digits, '_' and '-' each, and '.' in the ID
///   ...       the body, one zstd frame that states its length; nothing where n is 0
///   last  4   CRC-32 (IEEE 802.3, as in zlib) of all bytes before
///
/// Body of version 1: a column of n times, then one of n values for each channel, as whole numbers in LEB128. 0: no
/// value (NaN). 1: measured, but not now (infinite; only of current_a_A). Any other code c is the difference to the
/// expected value as (c - 2) folded: even numbers 2 d are d >= 0, odd ones -2 d - 1 are d < 0. Expected is, of a time,
/// the last time plus one period (at first the header's); of a value the channel's last value (at first 0).
///
///   bit   channel                step
///   0     current_A              2^-16 A
///   1     voltage_V              2^-12 V
///   2     position_m             2^-30 m
///   3     oil_temperature_K      2^-10 K
///   4, 5  current_a_A, voltage_a_V of a whole valve, as bits 0 and 1
///   6..9  pressure_p_Pa, _a_, _b_, _t_: 8 Pa
///
/// Every step is a power of two, so a whole number of steps is an exact double, and site and fleet compute with the
/// same values. Values reach to 2^31 - 1 steps, times to 2^62 - 2^40; values beyond are limited to these.
///
/// Body of version 2: numbers of 64 bits (doubles by their bits), 32 bits for lengths and status; a text is its length
/// and UTF-8 without control characters, at most 4096 bytes (names 256); a list is its length and its entries. The
/// second's summary, totals, indicators (once a minute), events and alarms follow in the order of site_report.hpp.
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
