#pragma once
/// A calibrated valve as bytes for a flash page: this header, then the sensors' tables as they lie in the memory of a
/// little-endian machine with floats of 32 bits. `spoolflow export parameters` writes it, parameters_from.hpp refers
/// into it. What stands here fits any C++17 compiler; the numbers' order is that of the structures.
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace spoolflow::sensor {

/// Grows with every change of the sensors' structures or of this header: an image serves the version that wrote it.
inline constexpr std::uint32_t image_layout_version = 6;

inline constexpr char image_magic[8] = {'S', 'P', 'O', 'O', 'L', 'V', 'L', 'V'};
/// Reads as such where bytes stand in the order in which the image holds them.
inline constexpr std::uint32_t image_byte_order = 0x01020304U;
/// The only scalar that there is: IEEE 754 binary32.
inline constexpr std::uint32_t image_scalar_float = 1;
/// What an image's address and the offset of each of its tables are multiples of [bytes].
inline constexpr std::uint32_t image_alignment = 8;
inline constexpr std::uint32_t image_table_alignment = 32;

/// Bits of what an image holds.
inline constexpr std::uint32_t image_has_condensed = 1U << 0;
inline constexpr std::uint32_t image_has_observer = 1U << 1;
inline constexpr std::uint32_t image_is_whole_valve = 1U << 2;

/// Places of the tables in the header. Those of a single direction stand where a whole valve has those of P to B.
inline constexpr std::size_t image_condensed_b = 0;
inline constexpr std::size_t image_condensed_a = 1;
inline constexpr std::size_t image_observer_b = 2;
inline constexpr std::size_t image_observer_a = 3;
inline constexpr std::size_t image_tables = 4;

/// Where a sensor's numbers lie.
struct ImageTable {
  std::uint32_t offset;  ///< from the image's first byte; 0: not held
  std::uint32_t bytes;
};

struct ImageHeader {
  char magic[8];
  std::uint32_t byte_order;
  std::uint32_t layout_version;
  std::uint32_t header_bytes;
  std::uint32_t total_bytes;  ///< of the image, header included; the page may be larger
  std::uint32_t scalar;
  std::uint32_t sensors;    ///< bits, see above
  std::uint64_t created_s;  ///< when it was exported, since 1970 in UTC; of two images the larger is the newer
  float rated_flow_m3_per_s;
  float stroke_m;
  std::uint8_t model_sha256[32];  ///< of the model file as spoolflow writes it
  char valve_name[64];            ///< UTF-8, ended by a zero; a longer name is cut
  char direction[8];              ///< "b": flow P to B; "a": flow P to A; "both": the whole valve
  char tool_version[24];          ///< that wrote the image
  ImageTable tables[image_tables];
  float adapted_edge_width;       ///< by which it was moved in the valve since it was exported (moved_page.hpp)
  float adapted_position_zero_m;  ///< the same of the position sensor's zero
  std::uint32_t adaptations;      ///< how often; 0 as exported
  std::uint32_t spare[8];         ///< 0
  std::uint32_t crc32;            ///< of all other bytes, the header's before those behind it
};

inline constexpr std::uint32_t image_header_bytes = 256;
static_assert(sizeof(ImageHeader) == image_header_bytes, "the header has no gaps");
static_assert(alignof(ImageHeader) <= image_alignment, "the header may be read where it lies");
static_assert(offsetof(ImageHeader, crc32) == image_header_bytes - sizeof(std::uint32_t), "the sum is its last word");
static_assert(std::is_trivially_copyable_v<ImageHeader>);

}  // namespace spoolflow::sensor
