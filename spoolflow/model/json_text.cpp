#include "spoolflow/model/json_text.hpp"

#include <fmt/format.h>

#include "spoolflow/model/model_error.hpp"

namespace spoolflow::model {

std::string read_json_text(std::istream& in) {
  constexpr std::size_t block = std::size_t{1} << 20;
  std::string text;
  while (in && text.size() <= largest_json_bytes) {
    const std::size_t before = text.size();
    text.resize(before + block);
    in.read(text.data() + before, static_cast<std::streamsize>(block));
    text.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  return text;
}

void require_json_limits(const std::string& text, const std::string& file) {
  if (text.size() > largest_json_bytes) {
    throw ModelError(
        fmt::format("{}: is larger than {} MiB; give a file that spoolflow wrote", file, largest_json_bytes >> 20));
  }
  if (text.find('\0') != std::string::npos) {
    throw ModelError(
        fmt::format("{}: is no text, and what spoolflow writes as JSON is; of a flash page or an FMU give the "
                    "model that it was made of",
                    file));
  }
  std::size_t line = 1, depth = 0;
  bool quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\n') ++line;
    if (c == '\\' && quoted) ++at;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (depth > deepest_json) {
      throw ModelError(fmt::format("{}, line {}: nests deeper than {} levels; give a file that spoolflow wrote", file,
                                   line, deepest_json));
    }
  }
}

nlohmann::ordered_json parsed_json(const std::string& text, const std::string& file) {
  require_json_limits(text, file);
  return nlohmann::ordered_json::parse(text, nullptr, false);
}

}  // namespace spoolflow::model
