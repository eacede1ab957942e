#pragma once
/// Limits of TOML text, held before it is parsed: parsers go down a level of their stack with each level of the text.
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace spoolflow::recording {

inline constexpr std::size_t largest_toml_bytes = std::size_t{4} << 20;  ///< a campaign has some kilobytes
inline constexpr std::size_t deepest_toml = 32;                          ///< brackets around a value; dots in a key

/// "line 3: nests deeper than 32 levels; correct it there"; nothing where the text may be parsed. Text in quotes and
/// comments does not count.
[[nodiscard]] std::optional<std::string> too_deep_toml(std::string_view text);

/// The text of a file for the parser. Throws RecordingError: no such file, larger or deeper than the limits.
[[nodiscard]] std::string read_toml_text(const std::filesystem::path& file);

}  // namespace spoolflow::recording
