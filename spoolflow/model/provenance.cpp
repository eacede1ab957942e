#include "spoolflow/model/provenance.hpp"

#include <array>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "spoolflow/model/sha256.hpp"

namespace spoolflow::model {

WearState last_wear(const Provenance& provenance) {
  for (auto each = provenance.adaptations.rbegin(); each != provenance.adaptations.rend(); ++each)
    if (each->wear) return *each->wear;
  return {};
}

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read for its checksum", file.string()));
  Sha256 sum;
  std::array<char, 1 << 16> buffer;
  while (in.read(buffer.data(), buffer.size()), in.gcount() > 0)
    sum.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
  return sum.hexadecimal();
}

std::string sha256_of_text(std::string_view text) {
  Sha256 sum;
  sum.add(text);
  return sum.hexadecimal();
}

namespace {
constexpr std::int64_t last_creation_s = 7258118399;  // a page of a later date would win over all that come
constexpr const char* iso_8601 = "%Y-%m-%dT%H:%M:%SZ";
}  // namespace

std::int64_t creation_seconds() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  if (epoch == nullptr) return static_cast<std::int64_t>(std::time(nullptr));
  const std::string_view text(epoch);
  std::int64_t seconds = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc() || end != text.data() + text.size() || seconds < 0 || seconds > last_creation_s) {
    throw std::invalid_argument(
        fmt::format("SOURCE_DATE_EPOCH is {:.40}: it must be whole seconds since 1970, 0 to {} (year 2199); set it so, "
                    "or unset it for the present time",
                    text, last_creation_s));
  }
  return seconds;
}

std::string creation_time() {
  const auto now = static_cast<std::time_t>(creation_seconds());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text;
  return {text.data(), std::strftime(text.data(), text.size(), iso_8601, &utc)};
}

std::optional<std::int64_t> seconds_of(const std::string& utc) {
  std::tm time{};
  const char* const end = strptime(utc.c_str(), iso_8601, &time);
  if (end == nullptr || *end != '\0') return std::nullopt;
  return timegm(&time);
}

}  // namespace spoolflow::model
