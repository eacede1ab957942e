#include "spoolflow/export/parameters/parameter_image.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "spoolflow/export/number_groups.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/model/limit_check.hpp"
#include "spoolflow/numerics/crc32.hpp"
#include "spoolflow/sensor/parameter_image/parameters_from.hpp"

namespace spoolflow::exports {

std::unique_ptr<sensor::CondensedTables<float>> single_tables(const model::Condensed& condensed) {
  const auto tables = std::make_unique<sensor::CondensedTables<double>>();
  sensor::lay_out(condensed.parameters, *tables);
  return std::make_unique<sensor::CondensedTables<float>>(single_precision(*tables));
}

std::unique_ptr<sensor::ObserverParameters<float>> single_tables(const model::Observer& observer,
                                                                 const std::string& path) {
  auto single = std::make_unique<sensor::ObserverParameters<float>>(single_precision(observer.parameters));
  const auto found =
      model::violation(*single, [](auto& parameters, auto& visitor) { model::describe_observer(parameters, visitor); });
  if (found) {
    throw std::invalid_argument(
        fmt::format("in single precision the model's {}{}: {}; calibrate again and look at the report for what went "
                    "astray",
                    path, found->path, found->problem));
  }
  return single;
}

std::string sha256_of_model(const model::Model& model) {
  std::ostringstream out;
  model::write_model(out, model);
  return model::sha256_of_text(out.str());
}

namespace {

static_assert(std::endian::native == std::endian::little, "tables are written as they lie in this machine's memory");

/// As much of a text as a field holds with a zero behind it, whole UTF-8 characters.
template <std::size_t Room>
void put_text(std::string_view text, char (&field)[Room]) {
  std::size_t length = std::min(text.size(), Room - 1);
  while (length > 0 && length < text.size() && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
  std::memcpy(field, text.data(), length);
}

void put_sha256(const std::string& digits, std::uint8_t (&bytes)[32]) {
  for (std::size_t k = 0; k < std::size(bytes); ++k)
    bytes[k] = static_cast<std::uint8_t>(std::stoul(digits.substr(2 * k, 2), nullptr, 16));
}

void pad(std::string& bytes) {
  bytes.resize((bytes.size() + sensor::image_table_alignment - 1) / sensor::image_table_alignment *
               sensor::image_table_alignment);
}

/// The tables behind the header, each listed in it.
class Image {
 public:
  explicit Image(const sensor::ImageHeader& header) : header_(header), bytes_(sizeof header, '\0') {}

  template <class Tables>
  void add(std::size_t place, const Tables& tables) {
    pad(bytes_);
    header_.tables[place] = {static_cast<std::uint32_t>(bytes_.size()), sizeof(Tables)};
    bytes_.append(reinterpret_cast<const char*>(&tables), sizeof(Tables));
  }

  std::string finished() {
    pad(bytes_);
    header_.total_bytes = static_cast<std::uint32_t>(bytes_.size());
    header_.crc32 = 0;
    std::memcpy(bytes_.data(), &header_, sizeof header_);
    // Of all but the sum itself: of the bytes before it with those behind it.
    std::string summed = bytes_;
    summed.erase(offsetof(sensor::ImageHeader, crc32), sizeof header_.crc32);
    header_.crc32 = numerics::crc32({reinterpret_cast<const std::uint8_t*>(summed.data()), summed.size()});
    std::memcpy(bytes_.data(), &header_, sizeof header_);
    return bytes_;
  }

 private:
  sensor::ImageHeader header_;
  std::string bytes_;
};

sensor::ImageHeader identity(const model::Model& model, const ImageContents& contents) {
  sensor::ImageHeader header{};
  std::memcpy(header.magic, sensor::image_magic, sizeof header.magic);
  header.byte_order = sensor::image_byte_order;
  header.layout_version = sensor::image_layout_version;
  header.header_bytes = sensor::image_header_bytes;
  header.scalar = sensor::image_scalar_float;
  header.created_s = contents.created_s;
  header.rated_flow_m3_per_s = single_precision(model.valve.rated_flow_m3_per_s);
  header.stroke_m = single_precision(model.valve.stroke_m);
  put_sha256(sha256_of_model(model), header.model_sha256);
  put_text(model.valve.name, header.valve_name);
  put_text(model.valve.direction, header.direction);
  put_text(contents.tool_version, header.tool_version);
  return header;
}

}  // namespace

std::string parameter_image(const model::Model& model, const ImageContents& contents) {
  const bool observer = contents.observer && model.has_observer();
  if (!contents.condensed && !observer) {
    throw std::invalid_argument(
        "the model is not calibrated for the observer, and nothing else is asked for: calibrate with a "
        "solenoid_dynamic recording and an axial_force_map at two or more oil temperatures, or export the condensed "
        "sensor");
  }
  sensor::ImageHeader header = identity(model, contents);
  header.sensors = (contents.condensed ? sensor::image_has_condensed : 0U) |
                   (observer ? sensor::image_has_observer : 0U) | (model.whole() ? sensor::image_is_whole_valve : 0U);
  Image image(header);
  if (observer) image.add(sensor::image_observer_b, *single_tables(*model.observer, "/observer"));
  if (observer && model.whole())
    image.add(sensor::image_observer_a, *single_tables(model.p_to_a->observer.value(), "/p_to_a/observer"));
  if (contents.condensed) image.add(sensor::image_condensed_b, *single_tables(model.condensed));
  if (contents.condensed && model.whole())
    image.add(sensor::image_condensed_a, *single_tables(model.p_to_a->condensed));
  return image.finished();
}

}  // namespace spoolflow::exports
