#pragma once
/// What an image of parameters is, read back from its bytes.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/sensor/parameter_image/image_header.hpp"
#include "spoolflow/sensor/parameter_image/image_refusal.hpp"

namespace spoolflow::exports {

/// Whether bytes begin as an image does.
[[nodiscard]] bool begins_as_image(std::string_view bytes);
/// Whether there are bytes, and all are as an erased flash reads: all ones, or all zeros.
[[nodiscard]] bool is_erased(std::string_view bytes);

/// One table of an image.
struct ImageTableSummary {
  std::string name;      ///< "condensed", or of a whole valve "observer, P to A"
  std::uint32_t offset;  ///< from the image's first byte
  std::uint32_t bytes;
};

/// An image as the sensor's own check finds it.
struct ImageSummary {
  sensor::ImageRefusal refusal;
  std::size_t file_bytes;      ///< the image may be the beginning of a page
  bool erased;                 ///< all bytes
  sensor::ImageHeader header;  ///< zeros where the bytes hold none of this version
  bool header_read;
  std::uint32_t crc32;                    ///< as computed here; 0 where the image is not all there
  std::vector<ImageTableSummary> tables;  ///< as the header has them
  std::string problem;  ///< what a model file would be refused for in an image that the sensor takes; empty: nothing
};
[[nodiscard]] ImageSummary image_summary(std::string_view bytes);

/// The model's hash as 64 hexadecimal digits.
[[nodiscard]] std::string sha256_text(const sensor::ImageHeader& header);
/// A text of the header, up to its end.
[[nodiscard]] std::string_view field_text(const char* field, std::size_t room);
/// UTC, ISO 8601 to the second.
[[nodiscard]] std::string creation_text(const sensor::ImageHeader& header);
/// The sensors held, such as "observer, condensed, of the whole valve".
[[nodiscard]] std::string sensors_text(const sensor::ImageHeader& header);

}  // namespace spoolflow::exports
