/// Where the instructions of the observer's largest step go on an emulated Cortex-M4F: each that is executed in it,
/// attributed to the header and function of spoolflow/sensor that it was written in.
/// cortex_m_profile MODEL.json RECORDING
#include <algorithm>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "bench/sensor_profile.hpp"
#include "tests/cortex_m/packed_run.hpp"
#include "tests/cortex_m/workshop.hpp"

namespace {

using namespace spoolflow;

const cortex_m::Core& core = cortex_m::cores.front();

std::string firmware(const std::string& more, const std::string& out) {
  return cortex_m::compiler(core) + "-g " + more +
         SPOOLFLOW_FIRMWARE "/board.cpp " SPOOLFLOW_FIRMWARE "/profile.cpp -o " + out + cortex_m::link() +
         core.libraries;
}

/// Addresses of the executed instructions in `log`, with `-d exec` one a line: "Trace 0: host [table/address/…] name".
std::string executed(cortex_m::Workshop& workshop) {
  return workshop.run("sed -n 's|^Trace [0-9]*: [^ ]* \\[[^/]*/\\([0-9a-f]*\\)/.*|0x\\1|p' trace.log");
}

template <class Entry, class Count>
std::vector<Entry> by_size(std::vector<Entry> entries, const Count& count) {
  std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) { return count(a) > count(b); });
  return entries;
}

void print(const bench::Profile& profile, std::uint32_t sample) {
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
    print(bench::profile_of(workshop.run("arm-none-eabi-addr2line -a -i -f -C -e profile.elf < addresses")), sample);
  } catch (const std::exception& error) {
    fmt::print(stderr, "cortex_m_profile: {}\n", error.what());
    return 1;
  }
  return 0;
}
