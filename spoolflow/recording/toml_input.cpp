#include "spoolflow/recording/toml_input.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/input_bytes.hpp"

namespace spoolflow::recording {

namespace {

/// Behind the text in quotes that begins at `at`, of one line or, between three quotes, of many.
std::size_t behind_quotes(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool many_lines = text.substr(at).starts_with(std::string(3, quote));
  const std::string end(many_lines ? 3 : 1, quote);
  for (at += end.size(); at < text.size(); ++at) {
    if (text.substr(at).starts_with(end)) return at + end.size();
    if (text[at] == '\n' && !many_lines) return at;  // never closed: the parser reports it
    if (text[at] == '\\' && quote == '"') ++at;
  }
  return text.size();
}

}  // namespace

std::optional<std::string> too_deep_toml(std::string_view text) {
  std::size_t line = 1, brackets = 0, dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      const std::size_t behind = behind_quotes(text, at);
      line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                                  text.begin() + static_cast<std::ptrdiff_t>(behind), '\n'));
      at = behind;
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '[' || c == '{') ++brackets;
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    if (c == '.') ++dots;
    if (c == '=' || c == ',' || c == '\n') dots = 0;
    if (c == '\n') ++line;
    if (brackets > deepest_toml || dots >= deepest_toml) {
      return fmt::format("line {}: nests deeper than {} levels; correct it there", line, deepest_toml);
    }
    ++at;
  }
  return std::nullopt;
}

std::string read_toml_text(const std::filesystem::path& file) {
  InputBytes input(file);
  std::string text(largest_toml_bytes + 1, '\0');
  text.resize(input.read(text.data(), text.size()));
  if (text.size() > largest_toml_bytes) {
    throw RecordingError(fmt::format("{}: is larger than {} MiB; it is no file of settings, campaign or channel map",
                                     input.name(), largest_toml_bytes >> 20));
  }
  if (const auto deep = too_deep_toml(text)) throw RecordingError(fmt::format("{}, {}", input.name(), *deep));
  return text;
}

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

void TomlTable::allow_only(const std::vector<std::string>& allowed) const {
  for (const auto& [key, node] : table) {
    if (std::ranges::find(allowed, key.str()) != allowed.end()) continue;
    throw RecordingError(unknown_key(place_of(node, file), key.str(), name, allowed));
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

std::optional<std::size_t> TomlTable::optional_choice(std::string_view key,
                                                      std::span<const std::string_view> names) const {
  const std::optional<std::string> written = optional_text(key);
  if (!written) return std::nullopt;
  const auto found = std::ranges::find(names, *written);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::vector<std::string> allowed(names.begin(), names.end());
  throw RecordingError(fmt::format("{}: {} = \"{}\" is not known{}; allowed: {}", place(key), key, *written,
                                   did_you_mean(*written, allowed), listed(allowed)));
}

std::size_t TomlTable::choice(std::string_view key, std::span<const std::string_view> names) const {
  (void)text(key);
  return *optional_choice(key, names);
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

std::vector<TomlTable> TomlTable::tables(std::string_view key, std::string_view to_do) const {
  const toml::array* const list = table[key].as_array();
  if (list == nullptr || list->empty()) throw RecordingError(fmt::format("{}: {}", place(key), to_do));
  std::vector<TomlTable> out;
  for (const toml::node& node : *list) {
    const toml::table* const each = node.as_table();
    if (each == nullptr)
      throw RecordingError(fmt::format("{}: write each {} as a table [[{}]]", place_of(node, file), key, key));
    out.push_back({*each, file, fmt::format("[[{}]]", key)});
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

std::optional<double> TomlTable::optional_within(std::string_view key, const NumberRange& range) const {
  const auto value = range.least > 0 ? optional_positive(key) : optional_number(key);
  if (!value || (*value >= range.least && *value <= range.most)) return value;
  throw RecordingError(fmt::format("{}: {} = {:g} is not between {:g} and {:g}; {}", place(key), key, *value,
                                   range.least, range.most, range.otherwise));
}

double TomlTable::within(std::string_view key, const NumberRange& range) const {
  (void)number(key);
  return *optional_within(key, range);
}

double TomlTable::positive(std::string_view key) const {
  (void)number(key);
  return *optional_positive(key);
}

}  // namespace spoolflow::recording
