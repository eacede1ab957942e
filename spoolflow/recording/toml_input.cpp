#include "spoolflow/recording/toml_input.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/toml_limits.hpp"

namespace spoolflow::recording {

toml::table read_toml(const std::filesystem::path& file) {
  const std::string text = read_toml_text(file);
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw RecordingError(fmt::format("{}, line {}: {}; correct the TOML there", file.string(),
                                     error.source().begin.line, error.description()));
  }
}

std::string place_of(const toml::node& node, const std::filesystem::path& file) {
  const auto line = node.source().begin.line;
  return line == 0 ? file.string() : fmt::format("{}, line {}", file.string(), line);
}

void TomlTable::allow_only(std::initializer_list<std::string_view> keys) const {
  const std::vector<std::string> allowed(keys.begin(), keys.end());
  for (const auto& [key, node] : table) {
    if (std::find(allowed.begin(), allowed.end(), key.str()) != allowed.end()) continue;
    throw RecordingError(fmt::format("{}: unknown key '{}' in {}{}; allowed: {}", place_of(node, file), key.str(), name,
                                     did_you_mean(key.str(), allowed), listed(allowed)));
  }
}

std::string TomlTable::place(std::string_view key) const {
  const toml::node* node = table.get(key);
  return place_of(node == nullptr ? static_cast<const toml::node&>(table) : *node, file);
}

std::optional<std::string> TomlTable::optional_text(std::string_view key) const {
  const toml::node* node = table.get(key);
  if (node == nullptr) return std::nullopt;
  auto value = node->value_exact<std::string>();
  if (!value) throw RecordingError(fmt::format("{}: '{}' in {} must be a text in quotes", place(key), key, name));
  return value;
}

std::string TomlTable::text(std::string_view key) const {
  const auto value = optional_text(key);
  if (!value || value->empty()) {
    throw RecordingError(fmt::format("{}: {} needs a key '{}' with a text in quotes", place(key), name, key));
  }
  return *value;
}

std::optional<std::vector<std::string>> TomlTable::list_of_texts(std::string_view key) const {
  const toml::node* const node = table.get(key);
  const toml::array* const list = node == nullptr ? nullptr : node->as_array();
  if (list == nullptr) return std::nullopt;
  std::vector<std::string> out;
  for (const toml::node& each : *list) {
    auto value = each.value_exact<std::string>();
    if (!value) return std::nullopt;
    out.push_back(std::move(*value));
  }
  return out;
}

std::optional<double> TomlTable::optional_number(std::string_view key) const {
  const toml::node* node = table.get(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value)) {
    throw RecordingError(fmt::format("{}: '{}' in {} must be a finite number", place(key), key, name));
  }
  return value;
}

double TomlTable::number(std::string_view key) const {
  const auto value = optional_number(key);
  if (!value) throw RecordingError(fmt::format("{}: {} needs a key '{}' with a number", place(key), name, key));
  return *value;
}

std::optional<double> TomlTable::optional_positive(std::string_view key) const {
  const auto value = optional_number(key);
  if (value && !(*value > 0.0)) {
    throw RecordingError(fmt::format("{}: '{}' in {} is {}; it must be above zero", place(key), key, name, *value));
  }
  return value;
}

double TomlTable::positive(std::string_view key) const {
  (void)number(key);
  return *optional_positive(key);
}

}  // namespace spoolflow::recording
