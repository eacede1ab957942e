#include "spoolflow/recording/toml_place.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/recording/nearest_name.hpp"
#include "spoolflow/recording/recording_error.hpp"

namespace spoolflow::recording {
toml::table read_toml(const std::filesystem::path& file) {
  std::error_code error;
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file, error)) {
    throw RecordingError(fmt::format("{}: cannot be opened; check the path", file.string()));
  }
  std::ostringstream text;
  text << in.rdbuf();
  try {
    return toml::parse(text.str(), file.string());
  } catch (const toml::parse_error& problem) {
    throw RecordingError(fmt::format("{}, line {}: is no valid TOML: {}", file.string(), problem.source().begin.line,
                                     problem.description()));
  }
}

std::string place_of(const toml::node& node, const std::filesystem::path& file) {
  return fmt::format("{}, line {}", file.string(), node.source().begin.line);
}

void refuse_unknown_keys(const toml::table& table, std::initializer_list<std::string_view> known,
                         const std::string& where, const std::filesystem::path& file) {
  for (const auto& [key, value] : table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    throw RecordingError(fmt::format("{}: {} has no key \"{}\"; did you mean \"{}\"?", place_of(value, file), where,
                                     std::string(key.str()), nearest_name(key.str(), known)));
  }
}

std::string text_of(const toml::table& table, std::string_view key, const std::string& where,
                    const std::filesystem::path& file) {
  const toml::node* node = table.get(key);
  if (node == nullptr)
    throw RecordingError(fmt::format("{}: {} has no \"{}\"; add {} = \"…\"", place_of(table, file), where, key, key));
  const auto text = node->value_exact<std::string>();
  if (!text)
    throw RecordingError(fmt::format("{}: {}.{} is no text; write it in quotes", place_of(*node, file), where, key));
  return *text;
}

double positive_of(const toml::table& table, std::string_view key, const std::string& where,
                   const std::filesystem::path& file) {
  const toml::node* node = table.get(key);
  if (node == nullptr)
    throw RecordingError(
        fmt::format("{}: {} has no \"{}\"; add it with a number above zero", place_of(table, file), where, key));
  const auto number = node->value<double>();
  if (!number || !(*number > 0) || *number > 1e12) {
    throw RecordingError(fmt::format("{}: {}.{} is no number above zero", place_of(*node, file), where, key));
  }
  return *number;
}

}  // namespace spoolflow::recording
