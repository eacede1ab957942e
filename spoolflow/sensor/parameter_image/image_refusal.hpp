#pragma once
/// Why an image of parameters is not taken.
#include <cstdint>

namespace spoolflow::sensor {

enum class ImageRefusal : std::uint32_t {
  none = 0,
  too_short = 1,          ///< the page ends before the image does, or there is no room for a header
  misaligned = 2,         ///< its address is no multiple of image_alignment
  no_image = 3,           ///< the bytes do not begin as an image does: an erased page, or something else
  other_byte_order = 4,   ///< this machine, or the image, has bytes in the other order
  other_layout = 5,       ///< another version of the sensor wrote it: export the model again with this one
  other_scalar = 6,       ///< not in single precision
  damaged = 7,            ///< its CRC-32 does not hold
  wrong_sizes = 8,        ///< a table is not where or not as large as this version has it
  no_text = 9,            ///< a text of the header has no end
  not_finite = 10,        ///< a number of the tables is infinite or none
  axis_not_rising = 11,   ///< an axis does not rise, or in other steps than it states
  not_physical = 12,      ///< a number that is above zero in every valve is not
  sensor_not_held = 13,   ///< it holds other sensors than were asked for
  check_unfinished = 14,  ///< asked for before all of it was looked at
};

/// For people; firmware that does not call it does not hold the texts either.
constexpr const char* text_of(ImageRefusal refusal) {
  switch (refusal) {
    case ImageRefusal::none:
      return "accepted";
    case ImageRefusal::too_short:
      return "there are fewer bytes than the image has";
    case ImageRefusal::misaligned:
      return "its address is no multiple of eight";
    case ImageRefusal::no_image:
      return "these bytes are no image of parameters";
    case ImageRefusal::other_byte_order:
      return "its bytes stand in the other order than this machine's";
    case ImageRefusal::other_layout:
      return "it was written for another version of the sensor: export the model again";
    case ImageRefusal::other_scalar:
      return "its numbers are not in single precision";
    case ImageRefusal::damaged:
      return "it is damaged: its CRC-32 does not hold";
    case ImageRefusal::wrong_sizes:
      return "a table is not where or not as large as this version of the sensor has it";
    case ImageRefusal::no_text:
      return "a text of its header has no end";
    case ImageRefusal::not_finite:
      return "a number of its tables is not finite";
    case ImageRefusal::axis_not_rising:
      return "an axis of its tables does not rise in equal steps";
    case ImageRefusal::not_physical:
      return "a number of its tables is not above zero, as it is in every valve";
    case ImageRefusal::sensor_not_held:
      return "it does not hold the sensor that is asked for";
    case ImageRefusal::check_unfinished:
      return "it has not been looked at to its end";
  }
  return "refused by a code that is not known here";
}

}  // namespace spoolflow::sensor
