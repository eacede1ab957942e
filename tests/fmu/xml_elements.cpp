#include "tests/fmu/xml_elements.hpp"

#include <regex>
#include <stdexcept>

namespace spoolflow::exports {

std::vector<XmlElement> xml_elements(const std::string& text) {
  static const std::regex attribute(R"re(([A-Za-z0-9_:.-]+)="([^"<]*)")re");
  std::vector<XmlElement> out;
  std::vector<std::string> open;
  std::size_t at = 0;
  while ((at = text.find('<', at)) != std::string::npos) {
    std::size_t end = at;
    for (bool quoted = false; end < text.size() && (quoted || text[end] != '>'); ++end) quoted ^= text[end] == '"';
    if (end == text.size()) throw std::runtime_error("a tag does not end");
    const std::string tag = text.substr(at + 1, end - at - 1);
    at = end;
    if (tag.starts_with('?') || tag.starts_with('!')) continue;
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != tag.substr(1))
        throw std::runtime_error("</" + tag.substr(1) + "> closes nothing");
      open.pop_back();
      continue;
    }
    XmlElement element;
    element.name = tag.substr(0, tag.find_first_of(" /\n"));
    for (const std::string& each : open) element.path += each + "/";
    element.path += element.name;
    for (std::sregex_iterator it(tag.begin(), tag.end(), attribute), last; it != last; ++it) {
      if (!element.attributes.emplace((*it)[1], (*it)[2]).second) throw std::runtime_error("twice: " + (*it)[1].str());
    }
    if (!tag.ends_with('/')) open.push_back(element.name);
    out.push_back(std::move(element));
  }
  if (!open.empty()) throw std::runtime_error(open.back() + " is not closed");
  return out;
}

}  // namespace spoolflow::exports
