#pragma once
/// A calibrated valve out of a flash page: the image is checked, and the sensor's parameters are references into it.
/// Nothing is copied: `ValveParameters` is five addresses, 20 bytes on a machine of 32 bits.
///
///     static spoolflow::sensor::ValveParameters valve;
///     if (parameters_from(page, page_bytes, valve) == ImageRefusal::none) step(*valve.observer_b, state, sample);
///
/// A whole valve's are `WholeValveParameters<float>{valve.observer_b, valve.observer_a}`, and of the condensed sensor
/// `WholeCondensedTables<float>{valve.condensed_b, valve.condensed_a}`: two addresses each.
#include "spoolflow/sensor/parameter_image/image_check.hpp"
#include "spoolflow/sensor/parameter_image/table_sanity.hpp"

#if __cplusplus >= 202002L && __has_include(<span>)
#include <span>
#endif

namespace spoolflow::sensor {

/// What an accepted image holds. The page must stay as it is for as long as a sensor is stepped with it.
struct ValveParameters {
  const ImageHeader* header{};                    ///< whose valve, of which model; null: none was accepted
  const ObserverParameters<float>* observer_b{};  ///< flow P to B, or the only direction; null where not held
  const ObserverParameters<float>* observer_a{};  ///< flow P to A of a whole valve
  const CondensedTables<float>* condensed_b{};
  const CondensedTables<float>* condensed_a{};

  [[nodiscard]] constexpr bool has(std::uint32_t sensors) const {
    return header != nullptr && (header->sensors & sensors) == sensors;
  }
  [[nodiscard]] constexpr bool whole() const { return has(image_is_whole_valve); }
};

namespace detail {

/// The table of that place, or null where the image does not hold it or holds it otherwise than `Tables` is.
template <class Tables>
const Tables* table_at(const ImageHeader& header, std::size_t place) {
  static_assert(std::is_trivially_copyable_v<Tables> && sizeof(Tables) % sizeof(float) == 0 &&
                alignof(Tables) == alignof(float));
  const ImageTable& table = header.tables[place];
  if (table.bytes != sizeof(Tables) || table.offset < image_header_bytes || table.offset % image_table_alignment != 0 ||
      table.offset > header.total_bytes || header.total_bytes - table.offset < table.bytes)
    return nullptr;
  const void* const bytes = reinterpret_cast<const unsigned char*>(&header) + table.offset;
  return static_cast<const Tables*>(bytes);
}

/// Finds one table and looks at it; it is held if and only if `held`.
template <class Tables>
ImageRefusal refer(const ImageHeader& header, std::size_t place, bool held, const Tables*& out) {
  if (!held) return header.tables[place].bytes == 0 ? ImageRefusal::none : ImageRefusal::wrong_sizes;
  out = table_at<Tables>(header, place);
  return out != nullptr ? sanity(*out) : ImageRefusal::wrong_sizes;
}

inline ImageRefusal refer(const ImageHeader& header, ValveParameters& out) {
  constexpr std::uint32_t known = image_has_condensed | image_has_observer | image_is_whole_valve;
  const bool condensed = (header.sensors & image_has_condensed) != 0;
  const bool observer = (header.sensors & image_has_observer) != 0;
  if ((header.sensors & ~known) != 0 || !(condensed || observer)) return ImageRefusal::wrong_sizes;
  if (!ends(header.valve_name) || !ends(header.direction) || !ends(header.tool_version)) return ImageRefusal::no_text;
  const bool whole = (header.sensors & image_is_whole_valve) != 0;
  ImageRefusal refusal = refer(header, image_condensed_b, condensed, out.condensed_b);
  if (refusal == ImageRefusal::none) refusal = refer(header, image_condensed_a, condensed && whole, out.condensed_a);
  if (refusal == ImageRefusal::none) refusal = refer(header, image_observer_b, observer, out.observer_b);
  if (refusal == ImageRefusal::none) refusal = refer(header, image_observer_a, observer && whole, out.observer_a);
  return refusal;
}

}  // namespace detail

/// The parameters of an image that has been looked at to its end; `out` is {} where it is refused.
inline ImageRefusal parameters_of(const ImageCheck& check, ValveParameters& out) {
  out = {};
  ImageRefusal refusal = found(check);
  if (refusal == ImageRefusal::none) refusal = detail::refer(*check.header, out);
  if (refusal != ImageRefusal::none) {
    out = {};
    return refusal;
  }
  out.header = check.header;
  return refusal;
}

/// Looks at all of an image at once. `size`: of the page [bytes], of which the image may be the beginning.
inline ImageRefusal parameters_from(const void* image, std::size_t size, ValveParameters& out) {
  ImageCheck check;
  const ImageRefusal refusal = begin(check, image, size);
  if (refusal != ImageRefusal::none) {
    out = {};
    return refusal;
  }
  advance(check, check.words);
  return parameters_of(check, out);
}

#if __cplusplus >= 202002L && defined(__cpp_lib_span)
inline ImageRefusal parameters_from(std::span<const std::byte> page, ValveParameters& out) {
  return parameters_from(page.data(), page.size(), out);
}
#endif

}  // namespace spoolflow::sensor
