#include "tests/cortex_m/step_ways.hpp"

#include <sstream>

#include <fmt/format.h>

#include "spoolflow/sensor/magnetic_hysteresis.hpp"

namespace spoolflow::cortex_m {
namespace {

/// The line of source on which the instruction stands, innermost.
std::string line_of(Workshop& workshop, const std::string& program, std::uint32_t address) {
  std::istringstream said(workshop.run(fmt::format("arm-none-eabi-addr2line -e {} {:#x}", program, address)));
  std::string line;
  std::getline(said, line);
  return line;
}

}  // namespace

StepCode step_code_of(Workshop& workshop, const std::string& program) {
  // Behind all code lie the tables and the recording, which need not be printed.
  const std::string begin_of_data = "$(arm-none-eabi-nm " + program + " | sed -n 's/ . run_begin$//p')";
  return step_code(
      workshop.run(fmt::format("arm-none-eabi-objdump -d -z --stop-address=0x{} {}", begin_of_data, program)),
      "one_step");
}

std::vector<std::uint32_t> longest_way_of(Workshop& workshop, const std::string& program, const StepCode& code) {
  const LoopBounds stops = [&](std::uint32_t address) -> std::optional<std::uint32_t> {
    if (line_of(workshop, program, address).find("/magnetic_hysteresis.hpp:") == std::string::npos) return {};
    return sensor::hysteresis_elements;
  };
  try {
    return longest_way(code, stops);
  } catch (const UnknownLoop& loop) {
    throw std::runtime_error(fmt::format("{}: {}", line_of(workshop, program, loop.address), loop.what()));
  }
}

}  // namespace spoolflow::cortex_m
