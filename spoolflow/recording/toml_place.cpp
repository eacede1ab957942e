#include "spoolflow/recording/toml_place.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/recording/recording_error.hpp"

namespace spoolflow::recording {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = k;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      diagonal = above;
    }
  }
  return row.back();
}

}  // namespace

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

std::string nearest(std::string_view name, std::initializer_list<std::string_view> known) {
  return std::string(*std::min_element(known.begin(), known.end(), [&](std::string_view a, std::string_view b) {
    return edit_distance(name, a) < edit_distance(name, b);
  }));
}

void refuse_unknown_keys(const toml::table& table, std::initializer_list<std::string_view> known,
                         const std::string& where, const std::filesystem::path& file) {
  for (const auto& [key, value] : table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    throw RecordingError(fmt::format("{}: {} has no key \"{}\"; did you mean \"{}\"?", place_of(value, file), where,
                                     std::string(key.str()), nearest(key.str(), known)));
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
