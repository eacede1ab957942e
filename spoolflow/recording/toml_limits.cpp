#include "spoolflow/recording/toml_limits.hpp"

#include <algorithm>

#include <fmt/format.h>

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

}  // namespace spoolflow::recording
