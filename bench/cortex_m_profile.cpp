/// Where the instructions of the observer's largest step go on an emulated Cortex-M4F: each that is executed in it,
/// attributed to the header and function of spoolflow/sensor that it was written in.
/// cortex_m_profile MODEL.json RECORDING
#include <algorithm>
#include <exception>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "tests/cortex_m/packed_run.hpp"
#include "tests/cortex_m/workshop.hpp"

namespace {

using namespace spoolflow;

const cortex_m::Core& core = cortex_m::cores.front();

/// Instructions by header, and there by function.
using Profile = std::map<std::string, std::map<std::string, int>>;

std::string firmware(const std::string& more, const std::string& out) {
  return cortex_m::compiler(core) + "-g " + more +
         SPOOLFLOW_FIRMWARE "/board.cpp " SPOOLFLOW_FIRMWARE "/profile.cpp -o " + out + cortex_m::link() +
         core.libraries;
}

/// What is written in these serves all stages and is attributed to whoever asked for it.
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

/// Addresses of the executed instructions in `log`, with `-d exec` one a line: "Trace 0: host [table/address/…] name".
std::string executed(cortex_m::Workshop& workshop) {
  return workshop.run("sed -n 's|^Trace [0-9]*: [^ ]* \\[[^/]*/\\([0-9a-f]*\\)/.*|0x\\1|p' trace.log");
}

/// `inlined`: of each address what addr2line -a -i -f -C says.
Profile profile_of(const std::string& inlined) {
  Profile profile;
  std::istringstream lines(inlined);
  bool found = true;
  for (std::string function, place; std::getline(lines, function);) {
    if (function.rfind("0x", 0) == 0) {
      if (!found) ++profile["entry, return and others"][""];
      found = false;
      continue;
    }
    std::getline(lines, place);
    const std::string header = header_of(place);
    if (found || header.empty() || serves_all(header)) continue;
    ++profile[header][function_of(function)];
    found = true;
  }
  if (!found) ++profile["entry, return and others"][""];
  return profile;
}

template <class Entry, class Count>
std::vector<Entry> by_size(std::vector<Entry> entries, const Count& count) {
  std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) { return count(a) > count(b); });
  return entries;
}

void print(const Profile& profile, std::uint32_t sample) {
  std::vector<std::pair<std::string, int>> totals;
  int all = 0;
  for (const auto& [header, functions] : profile) {
    int total = 0;
    for (const auto& entry : functions) total += entry.second;
    totals.emplace_back(header, total);
    all += total;
  }
  const auto size = [](const auto& entry) { return entry.second; };
  fmt::print("sample {}: {} instructions\n\n| header | instructions | of them in |\n|---|---|---|\n", sample, all);
  for (const auto& [header, total] : by_size(totals, size)) {
    std::string where;
    const auto& functions = profile.at(header);
    for (const auto& [name, count] :
         by_size(std::vector<std::pair<std::string, int>>(functions.begin(), functions.end()), size))
      if (!name.empty() && count >= 8) where += fmt::format("{}{} {}", where.empty() ? "" : ", ", name, count);
    fmt::print("| {} | {} | {} |\n", header, total, where);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: cortex_m_profile MODEL.json RECORDING\n");
    return 2;
  }
  try {
    const model::Model model = model::read_model(argv[1]);
    cortex_m::Workshop workshop(model);
    workshop.write("run.bin", cortex_m::packed_run(model, estimation::Estimator::observer, argv[2]));
    workshop.run(firmware("", "profile.elf"));
    const auto sample = cortex_m::figures_of(workshop.run(cortex_m::emulator(core, "profile.elf"))).at("sample");
    workshop.run(firmware(fmt::format("-DTRACED_SAMPLE={} ", sample), "profile.elf"));
    std::istringstream symbol(
        workshop.run("arm-none-eabi-nm -S -C profile.elf | sed -n '/traced_step/p' | cut -d' ' -f1,2"));
    std::string address, size;
    if (!(symbol >> address >> size)) throw std::runtime_error("arm-none-eabi-nm: no traced_step");
    workshop.run(cortex_m::emulator(core, "profile.elf") +
                 fmt::format(" -singlestep -d exec,nochain -dfilter 0x{}+0x{} -D trace.log", address, size));
    workshop.write("addresses", executed(workshop));
    print(profile_of(workshop.run("arm-none-eabi-addr2line -a -i -f -C -e profile.elf < addresses")), sample);
  } catch (const std::exception& error) {
    fmt::print(stderr, "cortex_m_profile: {}\n", error.what());
    return 1;
  }
  return 0;
}
