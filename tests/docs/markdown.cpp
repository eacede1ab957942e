#include "tests/docs/markdown.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <stdexcept>

namespace spoolflow::docs {
namespace {

/// Takes code out of a line and keeps it apart.
std::string without_code(const std::string& line, std::vector<std::string>& code_words) {
  std::string out;
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t begin = line.find('`', at);
    const std::size_t end = begin == std::string::npos ? begin : line.find('`', begin + 1);
    if (end == std::string::npos) break;
    out += line.substr(at, begin - at);
    code_words.push_back(line.substr(begin + 1, end - begin - 1));
    at = end + 1;
  }
  return out + line.substr(at);
}

void find_links(const std::string& line, std::vector<std::string>& links) {
  for (std::size_t at = line.find("]("); at != std::string::npos; at = line.find("](", at + 2)) {
    const std::size_t end = line.find(')', at);
    if (end != std::string::npos) links.push_back(line.substr(at + 2, end - at - 2));
  }
}

}  // namespace

Page read_page(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be opened");
  Page page{file, {}, {}, {}};
  bool block = false;
  for (std::string line; std::getline(in, line);) {
    const std::size_t text = line.find_first_not_of(' ');
    if (text != std::string::npos && line.compare(text, 3, "```") == 0) {
      block = !block;
      continue;
    }
    if (block) continue;
    if (!line.empty() && line.front() == '#') {
      const std::size_t begin = line.find_first_not_of("# ");
      if (begin != std::string::npos) page.headings.push_back(line.substr(begin));
    }
    find_links(without_code(line, page.code_words), page.links);
  }
  if (block) throw std::runtime_error(file.string() + ": a code block does not end");
  return page;
}

std::vector<Page> pages_below(const std::filesystem::path& folder) {
  std::vector<Page> pages;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".md") pages.push_back(read_page(entry.path()));
  }
  std::sort(pages.begin(), pages.end(), [](const Page& a, const Page& b) { return a.file < b.file; });
  return pages;
}

std::string anchor(const std::string& heading) {
  std::string out;
  for (const char letter : heading) {
    const auto code = static_cast<unsigned char>(letter);
    if (std::isalnum(code) != 0 || letter == '_' || letter == '-' || code >= 0x80) {
      out += static_cast<char>(std::tolower(code));
    } else if (letter == ' ') {
      out += '-';
    }
  }
  return out;
}

}  // namespace spoolflow::docs
