#include "spoolflow/export/parameters/image_summary.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>

#include <fmt/format.h>

#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/model/limit_check.hpp"
#include "spoolflow/sensor/parameter_image/parameters_from.hpp"

namespace spoolflow::exports {
namespace {

using sensor::ImageRefusal;

/// The bytes where a sensor may read them: at an address of its alignment.
std::vector<std::uint64_t> aligned(std::string_view bytes) {
  std::vector<std::uint64_t> out(bytes.size() / sizeof(std::uint64_t) + 1);  // one at least, also of no bytes
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(out.data()));
  return out;
}

/// Of all that the image holds but the sum itself.
std::uint32_t reckoned_crc32(const void* image, std::size_t size) {
  sensor::ImageCheck check;
  if (sensor::begin(check, image, size) != ImageRefusal::none) return 0;
  advance(check, check.words);
  return ~check.rest;
}

std::vector<ImageTableSummary> tables_of(const sensor::ImageHeader& header) {
  constexpr std::array<const char*, sensor::image_tables> names{"condensed", "condensed", "observer", "observer"};
  const bool whole = (header.sensors & sensor::image_is_whole_valve) != 0;
  std::vector<ImageTableSummary> out;
  for (std::size_t k = 0; k < sensor::image_tables; ++k) {
    if (header.tables[k].bytes == 0) continue;
    const char* const side = k % 2 == 0 ? ", P to B" : ", P to A";
    out.push_back({fmt::format("{}{}", names[k], whole ? side : ""), header.tables[k].offset, header.tables[k].bytes});
  }
  std::ranges::sort(out, {}, &ImageTableSummary::offset);
  return out;
}

std::string problem_of(const sensor::ValveParameters& valve) {
  for (const sensor::ObserverParameters<float>* observer : {valve.observer_b, valve.observer_a}) {
    if (observer == nullptr) continue;
    const auto found = model::violation(
        *observer, [](const auto& parameters, auto& visitor) { model::describe_observer(parameters, visitor); });
    if (found) {
      return fmt::format("observer{}{}: {}", observer == valve.observer_a ? ", P to A, " : ", ", found->path.substr(1),
                         found->problem);
    }
  }
  return {};
}

}  // namespace

bool begins_as_image(std::string_view bytes) {
  return bytes.starts_with(std::string_view(sensor::image_magic, sizeof sensor::image_magic));
}

bool is_erased(std::string_view bytes) {
  return !bytes.empty() && (bytes.front() == '\xff' || bytes.front() == '\0') &&
         bytes.find_first_not_of(bytes.front()) == std::string_view::npos;
}

ImageSummary image_summary(std::string_view bytes) {
  const std::vector<std::uint64_t> image = aligned(bytes);
  ImageSummary out{};
  out.file_bytes = bytes.size();
  out.erased = is_erased(bytes);
  sensor::ValveParameters valve;
  out.refusal = parameters_from(image.data(), bytes.size(), valve);
  sensor::ImageHeader header{};
  if (begins_as_image(bytes) && bytes.size() >= sizeof header) {
    std::memcpy(&header, bytes.data(), sizeof header);
    out.header_read =
        header.byte_order == sensor::image_byte_order && header.layout_version == sensor::image_layout_version;
    out.header = header;
  }
  if (!out.header_read) return out;
  out.crc32 = reckoned_crc32(image.data(), bytes.size());
  out.tables = tables_of(header);
  if (out.refusal == ImageRefusal::none) out.problem = problem_of(valve);
  return out;
}

std::string sha256_text(const sensor::ImageHeader& header) {
  std::string out;
  for (const std::uint8_t byte : header.model_sha256) out += fmt::format("{:02x}", byte);
  return out;
}

std::string_view field_text(const char* field, std::size_t room) {
  const std::string_view all(field, room);
  return all.substr(0, all.find('\0'));
}

std::string creation_text(const sensor::ImageHeader& header) {
  constexpr std::uint64_t last_s = 253402300799U;  // of the year 9999
  const auto created = static_cast<std::time_t>(std::min(header.created_s, last_s));
  std::tm utc{};
  gmtime_r(&created, &utc);
  std::array<char, 32> text;
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

std::string sensors_text(const sensor::ImageHeader& header) {
  std::string out;
  if ((header.sensors & sensor::image_has_observer) != 0) out += "observer";
  if ((header.sensors & sensor::image_has_condensed) != 0) out += out.empty() ? "condensed" : ", condensed";
  return out + ((header.sensors & sensor::image_is_whole_valve) != 0 ? ", of the whole valve" : ", of one direction");
}

}  // namespace spoolflow::exports
