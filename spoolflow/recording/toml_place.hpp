#pragma once
/// Values of a TOML file with their place, for messages that name file and line.
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace spoolflow::recording {

/// Throws RecordingError with the line where the file cannot be read or is no TOML.
[[nodiscard]] toml::table read_toml(const std::filesystem::path& file);
/// "FILE, line N".
[[nodiscard]] std::string place_of(const toml::node& node, const std::filesystem::path& file);
/// Throws where the table has a key that is none of `known`, proposing the nearest.
void refuse_unknown_keys(const toml::table& table, std::initializer_list<std::string_view> known,
                         const std::string& where, const std::filesystem::path& file);

/// The value of a key as text or number; throws RecordingError where it is missing or of another type.
[[nodiscard]] std::string text_of(const toml::table& table, std::string_view key, const std::string& where,
                                  const std::filesystem::path& file);
[[nodiscard]] double positive_of(const toml::table& table, std::string_view key, const std::string& where,
                                 const std::filesystem::path& file);

}  // namespace spoolflow::recording
