#include "spoolflow/export/cpp/exported_text.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "spoolflow/export/embedded_files.hpp"

namespace spoolflow::exports {

std::string exported_text(std::string_view name, const std::vector<FilledPlace>& places) {
  const auto file = std::ranges::find(cpp_texts(), name, &EmbeddedFile::name);
  if (file == cpp_texts().end()) throw std::logic_error(fmt::format("no text {} in the program", name));
  std::string out(file->bytes);
  for (const auto& [place, content] : places) {
    for (std::size_t at = out.find(place); at != std::string::npos; at = out.find(place, at + content.size()))
      out.replace(at, place.size(), content);
  }
  return out;
}

std::string in_a_block_comment(std::string name) {
  std::ranges::replace_if(
      name,
      [](char letter) {
        return static_cast<unsigned char>(letter) < ' ' || letter == '*' || letter == '\\' || letter == '?';
      },
      ' ');
  return name;
}

}  // namespace spoolflow::exports
