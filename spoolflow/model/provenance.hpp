#pragma once
/// Where a model came from.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::model {

struct InputFile {
  std::string protocol;   ///< as in the campaign, or "campaign" for the campaign file itself
  std::string file;       ///< as written in the campaign
  std::string sha256;     ///< 64 hexadecimal digits
  std::uint64_t samples;  ///< rows read; 0 for the campaign file
};

struct Provenance {
  std::string tool_version;
  std::string created;  ///< UTC, ISO 8601
  std::vector<InputFile> inputs;
};

/// Throws std::runtime_error where the file cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file);
[[nodiscard]] std::string sha256_of_text(std::string_view text);
/// The present moment in UTC, ISO 8601 to the second; SOURCE_DATE_EPOCH overrides it for reproducible models.
[[nodiscard]] std::string creation_time();

}  // namespace spoolflow::model
