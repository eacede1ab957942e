#pragma once
/// TOML files with messages that name file and line. Included by the files that read TOML only: toml++ is a long read.
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace spoolflow::recording {

/// Throws RecordingError: no such file, or a mistake in its syntax with its line.
[[nodiscard]] toml::table read_toml(const std::filesystem::path& file);

/// "campaign.toml, line 17".
[[nodiscard]] std::string place_of(const toml::node& node, const std::filesystem::path& file);

/// One table of a file; `name` is as in the file: "[valve]".
struct TomlTable {
  const toml::table& table;
  const std::filesystem::path& file;
  std::string name;

  /// Throws RecordingError with file and line where a key is none of these, naming the nearest.
  void allow_only(std::initializer_list<std::string_view> keys) const;
  /// Throw RecordingError where the key is missing (the required ones), or its value is of another type.
  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] std::optional<std::string> optional_text(std::string_view key) const;
  /// Nothing where the key is missing, or its value is no list of texts alone.
  [[nodiscard]] std::optional<std::vector<std::string>> list_of_texts(std::string_view key) const;
  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] std::optional<double> optional_number(std::string_view key) const;
  /// As number(), and above zero.
  [[nodiscard]] double positive(std::string_view key) const;
  [[nodiscard]] std::optional<double> optional_positive(std::string_view key) const;
  [[nodiscard]] std::string place(std::string_view key) const;
};

}  // namespace spoolflow::recording
