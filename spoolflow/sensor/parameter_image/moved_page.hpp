#pragma once
/// A page of parameters moved on by what references of the machine have found (machine_reference.hpp), written into the
/// spare page word by word, in slices between samples:
///
///     PageMove move;
///     if (begin(move, valve, finding_of(machine, state), created_s) == ImageRefusal::none)
///       while (!advance(move, 8, [&](std::uint32_t place, std::uint32_t word) { spare_page[place] = word; })) {}
///
/// The first pass sums, the second writes, the magic last. Then check the new page and change over to it as to any
/// other (image_check.hpp); the page in use stays as it is, to go back to.
#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/machine_reference.hpp"
#include "spoolflow/sensor/parameter_image/parameters_from.hpp"

namespace spoolflow::sensor {

struct PageChange {
  /// No page is moved further, against the model as it was exported.
  static constexpr float most_width = 0.35F, most_zero_m = 60e-6F;
  float edge_width;         ///< conductance and flow force, as a share more
  float flow_share;         ///< standard uncertainty of the flow that is left of it, for the band
  float position_zero_m;    ///< the position sensor reads so much too much
  std::uint64_t created_s;  ///< of the new page, since 1970 in UTC; larger than the old one's
};

/// How far a page has come. 40 bytes on a machine of 32 bits.
struct PageMove {
  const ImageHeader* from;
  const ObserverParameters<float>* tables;
  PageChange change;
  std::uint32_t words;  ///< of the page
  std::uint32_t next;   ///< of twice as many: summed, then written
  std::uint32_t rest;   ///< of the CRC-32
};

namespace detail {

inline constexpr std::uint32_t crc_word = image_header_bytes / sizeof(std::uint32_t) - 1U;
inline constexpr std::uint32_t created_word = offsetof(ImageHeader, created_s) / sizeof(std::uint32_t);
inline constexpr std::uint32_t width_word = offsetof(ImageHeader, adapted_edge_width) / sizeof(std::uint32_t);
inline constexpr std::uint32_t zero_word = offsetof(ImageHeader, adapted_position_zero_m) / sizeof(std::uint32_t);
inline constexpr std::uint32_t count_word = offsetof(ImageHeader, adaptations) / sizeof(std::uint32_t);

inline float adapted_width(const PageMove& move) {
  return (1.0F + move.from->adapted_edge_width) * (1.0F + move.change.edge_width) - 1.0F;
}
inline float adapted_zero_m(const PageMove& move) {
  return move.from->adapted_position_zero_m + move.change.position_zero_m;
}

inline std::uint32_t moved_header_word(const PageMove& move, std::uint32_t place) {
  switch (place) {
    case created_word:
      return static_cast<std::uint32_t>(move.change.created_s & 0xFFFFFFFFU);
    case created_word + 1U:
      return static_cast<std::uint32_t>(move.change.created_s >> 32U);
    case width_word:
      return bits_as<std::uint32_t>(adapted_width(move));
    case zero_word:
      return bits_as<std::uint32_t>(adapted_zero_m(move));
    case count_word:
      return move.from->adaptations + 1U;
    case crc_word:
      return ~move.rest;
    default:
      return word_at(move.from, place);
  }
}

/// Where a number of the tables stands in the page.
inline std::uint32_t place_of(const PageMove& move, const float& number) {
  const auto* const at = reinterpret_cast<const unsigned char*>(&number);
  const auto* const page = reinterpret_cast<const unsigned char*>(move.from);
  return static_cast<std::uint32_t>(static_cast<std::size_t>(at - page) / sizeof(float));
}

template <class Table>
bool lies_in(const PageMove& move, std::uint32_t place, const Table& table) {
  return place - place_of(move, table.values.front()) < table.values.size();
}

/// Whether it is the beginning of an axis of positions, or the one position that stands alone.
inline bool is_position(const PageMove& move, std::uint32_t place) {
  const ObserverParameters<float>& valve = *move.tables;
  const ActuatorParameters<float>& actuator = valve.actuator;
  return place == place_of(move, actuator.magnetic_force.map.column_axis.first) ||
         place == place_of(move, actuator.friction_N.column_axis.first) ||
         place == place_of(move, actuator.coil.flux_linkage.map.column_axis.first) ||
         place == place_of(move, valve.spring.curve.axis.first) ||
         place == place_of(move, valve.edge.position_m.first) || place == place_of(move, valve.closed_below_m) ||
         place == place_of(move, valve.stopped_above_m);
}

inline std::uint32_t moved_word(const PageMove& move, std::uint32_t place) {
  if (place <= crc_word) return moved_header_word(move, place);
  const std::uint32_t word = word_at(move.from, place);
  const float number = bits_as<float>(word);
  const ObserverParameters<float>& valve = *move.tables;
  if (lies_in(move, place, valve.edge.conductance) || lies_in(move, place, valve.edge.flow_force_N))
    return bits_as<std::uint32_t>(number * (1.0F + move.change.edge_width));
  if (is_position(move, place)) return bits_as<std::uint32_t>(number + move.change.position_zero_m);
  if (place == place_of(move, valve.environment.flow_share))
    return bits_as<std::uint32_t>(larger(number, move.change.flow_share));
  return word;
}

}  // namespace detail

/// `valve`: of the page in use, which holds the observer of one direction and nothing else (`export parameters
/// --sensors observer`); else `sensor_not_held`. `not_physical`: a number is none, the page is no newer, or it would
/// lie beyond what is moved.
inline ImageRefusal begin(PageMove& move, const ValveParameters& valve, const PageChange& change) {
  move.words = move.next = 0;
  if (!valve.has(image_has_observer) || valve.header->sensors != image_has_observer)
    return ImageRefusal::sensor_not_held;
  move.from = valve.header;
  move.tables = valve.observer_b;
  move.change = change;
  const bool within_limits = magnitude(detail::adapted_width(move)) <= PageChange::most_width &&
                             magnitude(detail::adapted_zero_m(move)) <= PageChange::most_zero_m &&
                             within(change.flow_share, 1.0F) && change.created_s > valve.header->created_s;
  if (!within_limits) return ImageRefusal::not_physical;
  move.words = valve.header->total_bytes / sizeof(std::uint32_t);
  move.rest = 0xFFFFFFFFU;
  return ImageRefusal::none;
}

/// The same by what references have come to: a finding that moves nothing is `not_physical`.
inline ImageRefusal begin(PageMove& move, const ValveParameters& valve, const MachineFinding<float>& finding,
                          std::uint64_t created_s) {
  constexpr auto flow_per_width = static_cast<float>(ReferencePriors::volume_per_width);
  move.words = move.next = 0;
  if (finding.verdict != MachineVerdict::moves) return ImageRefusal::not_physical;
  return begin(move, valve,
               PageChange{finding.edge_width, flow_per_width * finding.edge_width_deviation, finding.position_zero_m,
                          created_s});
}

/// So many more words, summed or written by `write(place, word)`, places counted in words. True once all is written;
/// more calls change nothing.
template <class Write>
bool advance(PageMove& move, std::uint32_t words, Write&& write) {
  for (std::uint32_t k = 0; k < words && move.next < 2U * move.words; ++k, ++move.next) {
    if (move.next < move.words) {
      if (move.next != detail::crc_word) move.rest = detail::crc32_with(move.rest, detail::moved_word(move, move.next));
      continue;
    }
    constexpr std::uint32_t magic_words = sizeof image_magic / sizeof(std::uint32_t);
    std::uint32_t place = move.next - move.words + magic_words;
    if (place >= move.words) place -= move.words;
    write(place, detail::moved_word(move, place));
  }
  return move.words > 0U && move.next == 2U * move.words;
}

}  // namespace spoolflow::sensor
