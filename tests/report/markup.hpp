#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace spoolflow::report {

/// The page without what stands inside its <script> elements.
inline std::string without_scripts(const std::string& page) {
  std::string out;
  std::size_t at = 0;
  while (true) {
    const std::size_t tag = page.find("<script", at);
    const std::size_t begin = tag == std::string::npos ? tag : page.find('>', tag);
    const std::size_t end = begin == std::string::npos ? begin : page.find("</script>", begin);
    if (end == std::string::npos) return out + page.substr(at);
    out += page.substr(at, begin + 1 - at);
    at = end;
  }
}

/// Empty where every element is closed in order; else the first tag that is not. Knows HTML's elements without an end.
inline std::string unbalanced_markup(const std::string& page) {
  const std::string markup = without_scripts(page);
  constexpr std::array empty_elements{"meta", "br", "!doctype"};
  std::vector<std::string> open;
  for (std::size_t at = markup.find('<'); at != std::string::npos; at = markup.find('<', at + 1)) {
    const std::size_t end = markup.find('>', at);
    if (end == std::string::npos) return markup.substr(at, 40);
    const bool closing = markup[at + 1] == '/';
    const std::size_t begin = at + (closing ? 2 : 1);
    const std::string name = markup.substr(begin, std::min(markup.find_first_of(" />\n", begin), end) - begin);
    if (std::find(empty_elements.begin(), empty_elements.end(), name) != empty_elements.end()) continue;
    if (closing) {
      if (open.empty() || open.back() != name) return "</" + name;
      open.pop_back();
    } else if (markup[end - 1] != '/') {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "<" + open.back();
}

}  // namespace spoolflow::report
