#pragma once
/// TOML files with messages that name file and line. Included by the files that read TOML only: toml++ is a long read.
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace spoolflow::recording {

// Limits of TOML text, held before it is parsed: parsers go down a level of their stack with each level of the text.
inline constexpr std::size_t largest_toml_bytes = std::size_t{4} << 20;  ///< a campaign has some kilobytes
inline constexpr std::size_t deepest_toml = 32;                          ///< brackets around a value; dots in a key

/// "line 3: nests deeper than 32 levels; correct it there"; nothing where the text may be parsed. Text in quotes and
/// comments does not count.
[[nodiscard]] std::optional<std::string> too_deep_toml(std::string_view text);

/// The text of a file for the parser. Throws RecordingError: no such file, larger or deeper than the limits.
[[nodiscard]] std::string read_toml_text(const std::filesystem::path& file);

/// Throws RecordingError: no such file, or a mistake in its syntax with its line.
[[nodiscard]] toml::table read_toml(const std::filesystem::path& file);

/// "campaign.toml, line 17".
[[nodiscard]] std::string place_of(const toml::node& node, const std::filesystem::path& file);

/// The numbers that a key may have, and what to give where one is outside: "give it in mm".
struct NumberRange {
  double least, most;
  std::string_view otherwise;
};

/// One table of a file; `name` is as in the file: "[valve]".
struct TomlTable {
  const toml::table& table;
  const std::filesystem::path& file;
  std::string name;

  /// Throws RecordingError with file and line where a key is none of these, naming the nearest.
  void allow_only(const std::vector<std::string>& allowed) const;
  /// Throw RecordingError where the key is missing (the required ones), or its value is of another type.
  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] std::optional<std::string> optional_text(std::string_view key) const;
  /// Which of the names the text is. Throw RecordingError, which lists the names, where it is none of them.
  [[nodiscard]] std::size_t choice(std::string_view key, std::span<const std::string_view> names) const;
  [[nodiscard]] std::optional<std::size_t> optional_choice(std::string_view key,
                                                           std::span<const std::string_view> names) const;
  /// Nothing where the key is missing, or its value is no list of texts alone.
  [[nodiscard]] std::optional<std::vector<std::string>> list_of_texts(std::string_view key) const;
  /// Of tables [[key]]. Throws RecordingError where there are none, with what to do, and where one is no table.
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key, std::string_view to_do) const;
  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] std::optional<double> optional_number(std::string_view key) const;
  /// As number(), and above zero.
  [[nodiscard]] double positive(std::string_view key) const;
  [[nodiscard]] std::optional<double> optional_positive(std::string_view key) const;
  /// As number(), and within the range.
  [[nodiscard]] double within(std::string_view key, const NumberRange& range) const;
  [[nodiscard]] std::optional<double> optional_within(std::string_view key, const NumberRange& range) const;
  [[nodiscard]] std::string place(std::string_view key) const;
};

}  // namespace spoolflow::recording
