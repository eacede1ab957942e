#include "tests/cortex_m/worst_stack.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace spoolflow::cortex_m {
namespace {

struct CallGraph {
  std::map<std::string, std::uint32_t> frame_bytes;
  std::map<std::string, std::vector<std::string>> callees;
};

CallGraph parsed(const std::string& text) {
  static const std::regex node("node: \\{ title: \"([^\"]+)\" label: \"([^\"]*)\".*"),
      edge("edge: \\{ sourcename: \"([^\"]+)\" targetname: \"([^\"]+)\".*"),
      bytes(".*\\\\n([0-9]+) bytes \\(([^)]+)\\).*");
  CallGraph out;
  std::istringstream lines(text);
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, found, node)) {
      const std::string name = found[1], label = found[2];
      if (!std::regex_match(label, found, bytes)) continue;
      if (found[2] == "dynamic") throw std::runtime_error(name + ": its stack depends on data");
      out.frame_bytes[name] = static_cast<std::uint32_t>(std::stoul(found[1]));
    } else if (std::regex_match(line, found, edge)) {
      out.callees[found[1]].push_back(found[2]);
    }
  }
  return out;
}

std::uint32_t deepest(const CallGraph& graph, const std::string& function, std::set<std::string>& above) {
  if (!above.insert(function).second) throw std::runtime_error(function + " calls itself");
  std::uint32_t below = 0;
  if (const auto callees = graph.callees.find(function); callees != graph.callees.end()) {
    for (const std::string& callee : callees->second) below = std::max(below, deepest(graph, callee, above));
  }
  above.erase(function);
  const auto frame = graph.frame_bytes.find(function);
  return below + (frame == graph.frame_bytes.end() ? 0 : frame->second);
}

}  // namespace

std::uint32_t worst_stack_bytes(const std::string& call_graph, const std::string& function) {
  const CallGraph graph = parsed(call_graph);
  std::vector<std::string> named;
  for (const auto& [name, bytes] : graph.frame_bytes) {
    if (name.find(function) != std::string::npos) named.push_back(name);
  }
  if (named.size() != 1)
    throw std::runtime_error(function + ": " + std::to_string(named.size()) + " functions are called so");
  std::set<std::string> above;
  return deepest(graph, named.front(), above);
}

}  // namespace spoolflow::cortex_m
