#include "bench/sensor_profile.hpp"

#include <sstream>

namespace spoolflow::bench {
namespace {

/// What is written in these serves all stages and is attributed to the caller.
bool serves_all(const std::string& header) {
  return header == "table" || header == "scalar" || header == "status" || header == "sample" ||
         header == "position_state";
}

/// "…/spoolflow/sensor/NAME.hpp:12" gives NAME; empty where it lies elsewhere.
std::string header_of(const std::string& place) {
  const auto folder = place.find("spoolflow/sensor/");
  const auto ending = place.rfind(".hpp:");
  if (folder == std::string::npos || ending == std::string::npos) return {};
  const auto name = place.rfind('/', ending) + 1;
  return place.substr(name, ending - name);
}

/// The bare name of a demangled function; of a lambda that of the function it stands in.
std::string function_of(std::string text) {
  text = text.substr(0, text.find("::{lambda"));
  int depth = 0;
  std::string flat;
  for (const char letter : text) {
    if (letter == '<') ++depth;
    if (depth == 0) flat += letter;
    if (letter == '>') --depth;
  }
  flat = flat.substr(0, flat.find('('));
  return flat.substr(flat.find_last_of(" :") + 1);
}

}  // namespace

Profile profile_of(const std::string& inlined) {
  Profile profile;
  std::istringstream lines(inlined);
  bool found = true;
  for (std::string function, place; std::getline(lines, function);) {
    if (function.rfind("0x", 0) == 0) {
      if (!found) ++profile[elsewhere][""];
      found = false;
      continue;
    }
    std::getline(lines, place);
    const std::string header = header_of(place);
    if (found || header.empty() || serves_all(header)) continue;
    ++profile[header][function_of(function)];
    found = true;
  }
  if (!found) ++profile[elsewhere][""];
  return profile;
}

}  // namespace spoolflow::bench
