/// The longest way through the machine code of a step on a Cortex-M4F beside the largest step of a recording, by the
/// header of spoolflow/sensor in which the instructions were written. Every step of the recording is followed in the
/// emulator's log and held against the graph of the code.
/// cortex_m_longest_way MODEL.json RECORDING
#include <algorithm>
#include <exception>
#include <set>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "bench/sensor_profile.hpp"
#include "tests/cortex_m/followed_steps.hpp"
#include "tests/cortex_m/packed_run.hpp"
#include "tests/cortex_m/step_ways.hpp"

namespace {

using namespace spoolflow;

const cortex_m::Core& core = cortex_m::cores.front();

bench::Profile profile(cortex_m::Workshop& workshop, const std::vector<std::uint32_t>& way) {
  std::string addresses;
  for (const std::uint32_t address : way) addresses += fmt::format("{:#x}\n", address);
  workshop.write("addresses", addresses);
  return bench::profile_of(workshop.run("arm-none-eabi-addr2line -a -i -f -C -e replay.elf < addresses"));
}

int total(const bench::Profile& profile, const std::string& header) {
  int sum = 0;
  const auto found = profile.find(header);
  if (found == profile.end()) return 0;
  for (const auto& entry : found->second) sum += entry.second;
  return sum;
}

/// The functions that take more on the longest way than in the largest step, those first that add most.
std::string added(const bench::Profile& largest, const bench::Profile& longest, const std::string& header) {
  std::vector<std::pair<int, std::string>> more;
  const auto in_longest = longest.find(header), in_largest = largest.find(header);
  if (in_longest == longest.end()) return {};
  for (const auto& [name, count] : in_longest->second) {
    int before = 0;
    if (in_largest != largest.end() && in_largest->second.count(name) > 0) before = in_largest->second.at(name);
    if (!name.empty() && count - before >= 8) more.emplace_back(before - count, name);
  }
  std::sort(more.begin(), more.end());
  std::string out;
  for (const auto& [less, name] : more) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", name, -less);
  return out;
}

void print(const bench::Profile& largest, const bench::Profile& longest) {
  std::set<std::string> headers;
  for (const bench::Profile* each : {&largest, &longest})
    for (const auto& entry : *each) headers.insert(entry.first);
  std::vector<std::string> rows(headers.begin(), headers.end());
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const std::string& a, const std::string& b) { return total(longest, a) > total(longest, b); });
  fmt::print("| header | largest step | longest way | what adds most |\n|---|---|---|---|\n");
  for (const std::string& header : rows)
    fmt::print("| {} | {} | {} | {} |\n", header, total(largest, header), total(longest, header),
               added(largest, longest, header));
  fmt::print("\n");
}

void count(const model::Model& model, estimation::Estimator estimator, const char* recording, const char* name) {
  cortex_m::Workshop workshop(model);
  workshop.write("run.bin", cortex_m::packed_run(model, estimator, recording));
  workshop.run(cortex_m::replay_firmware(estimator, core));
  const cortex_m::StepCode code = cortex_m::step_code_of(workshop, "replay.elf");
  const std::vector<std::uint32_t> longest = cortex_m::longest_way_of(workshop, "replay.elf", code);
  cortex_m::FollowedSteps followed(code);
  workshop.read_lines(cortex_m::emulator(core, "replay.elf") +
                          fmt::format(" -d exec,nochain -dfilter {} 2>&1 >/dev/null", followed.filter()),
                      [&](const std::string& line) { followed.read(line); });
  followed.end();
  fmt::print("{}: {} steps followed, none beside the graph of {} functions\n", name, followed.steps(),
             code.functions.size());
  fmt::print("largest of them {} instructions, longest way {}, call included\n\n",
             followed.largest().size() + cortex_m::call_instructions, longest.size() + cortex_m::call_instructions);
  print(profile(workshop, followed.largest()), profile(workshop, longest));
  if (followed.largest().size() > longest.size())
    throw std::runtime_error("a step takes more than the longest way: the graph is wrong");
}

}  // namespace

int main(int argc, char** argv) {
  using estimation::Estimator;
  if (argc != 3) {
    fmt::print(stderr, "usage: cortex_m_longest_way MODEL.json RECORDING\n");
    return 2;
  }
  try {
    const model::Model model = model::read_model(argv[1]);
    if (!model.whole()) {
      count(model, Estimator::observer, argv[2], "observer");
      count(model, Estimator::condensed, argv[2], "condensed");
    }
    const model::Model whole = model.whole() ? model : cortex_m::on_both_sides(model);
    count(whole, Estimator::observer, argv[2], "observer of a whole valve");
    count(whole, Estimator::condensed, argv[2], "condensed sensor of a whole valve");
  } catch (const std::exception& error) {
    fmt::print(stderr, "cortex_m_longest_way: {}\n", error.what());
    return 1;
  }
  return 0;
}
