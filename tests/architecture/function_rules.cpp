#include "tests/architecture/function_rules.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <regex>

#include <fmt/format.h>

#include "tests/architecture/sources.hpp"

namespace spoolflow::architecture {
namespace {

namespace fs = std::filesystem;

/// Functions of one depth of indentation: of namespaces at 0, of classes at 2.
class Functions {
 public:
  explicit Functions(std::string indent) : indent_(std::move(indent)) {}

  /// Takes the next line; returns the lines of a function that ends there, else 0.
  int take(const std::string& line, int number) {
    static const std::regex opens_no_function(
        R"(^\s*(namespace|struct|class|enum|union|if|else|for|while|do|switch|case|default|return|try|public|private|template)\b)");
    const bool at_depth = line.starts_with(indent_) && line.size() > indent_.size() && line[indent_.size()] != ' ';
    if (!at_depth) {
      if (signature_ && line.ends_with('{')) begin_ = *signature_;
      return 0;
    }
    if (line == indent_ + "}") {
      const int lines = begin_ == 0 ? 0 : number - begin_ + 1;
      begin_ = 0;
      signature_.reset();
      return lines;
    }
    if (line[indent_.size()] == '/' || line[indent_.size()] == '}' || line[indent_.size()] == '#') return 0;
    if (std::regex_search(line, opens_no_function)) {
      signature_.reset();
      begin_ = 0;
      return 0;
    }
    signature_ = line.ends_with(';') ? std::nullopt : std::optional<int>(number);
    if (signature_ && line.ends_with('{')) begin_ = number;
    return 0;
  }
  [[nodiscard]] int begin() const { return begin_; }

 private:
  std::string indent_;
  std::optional<int> signature_;
  int begin_ = 0;
};

void check_functions(const fs::path& file, const std::string& name, std::vector<std::string>& violations) {
  std::array<Functions, 2> depths{Functions(""), Functions("  ")};
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
    const int number = static_cast<int>(lines.size());
    for (Functions& depth : depths) {
      const int length = depth.take(line, number);
      if (length <= longest_function_lines) continue;
      const int begin = number - length + 1;
      if (begin > 1 && lines[static_cast<std::size_t>(begin) - 2].find("// long: ") != std::string::npos) continue;
      violations.push_back(
          fmt::format("{}:{}: a function of {} lines; past {} look for the second stage, or give the "
                      "reason in a line `// long: …` before it",
                      name, begin, length, longest_function_lines));
    }
  }
}

}  // namespace

std::vector<std::string> function_violations(const fs::path& root) {
  std::vector<std::string> violations;
  for (const fs::path& source : sources_below(root))
    check_functions(source, source.lexically_relative(root).generic_string(), violations);
  std::sort(violations.begin(), violations.end());
  return violations;
}

}  // namespace spoolflow::architecture
