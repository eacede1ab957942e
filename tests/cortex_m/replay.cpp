#include "tests/cortex_m/replay.hpp"

#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "tests/cortex_m/packed_run.hpp"
#include "tests/cortex_m/step_ways.hpp"
#include "tests/cortex_m/worst_stack.hpp"

namespace spoolflow::cortex_m {
namespace {

namespace fs = std::filesystem;
using estimation::Estimator;

std::uint32_t flash_bytes(Workshop& workshop, const Core& core, const std::string& which) {
  workshop.run(compiler(core) + which +
               SPOOLFLOW_FIRMWARE
               "/sensor_image.cpp -o sensor.elf -nostartfiles -nostdlib "
               "-Wl,--gc-sections -Wl,-e,sensor_step " +
               core.libraries);
  std::istringstream sizes(workshop.run("arm-none-eabi-size sensor.elf | tail -1"));
  std::uint32_t text = 0, data = 0;
  if (!(sizes >> text >> data)) throw std::runtime_error("arm-none-eabi-size: no sizes");
  return text + data;
}

StepCost cost(const Figures& figures, const std::string& name, const std::string& way) {
  return {way, figures.at(name + " steps"), figures.at(name + " median"), figures.at(name + " mean"),
          figures.at(name + " largest")};
}

/// The order of mode_of in firmware/sensor_under_test.hpp.
std::vector<std::string> ways(Estimator estimator) {
  if (estimator == Estimator::condensed) return {"sample missing", "closed", "open", "outside its map"};
  return {"sample missing", "rest",           "rest, block", "transient",     "transient, block",
          "opening",        "opening, block", "closing",     "closing, block"};
}

/// -D for the firmware's sources.
std::string which_sensor(Estimator estimator) {
  return estimator == Estimator::condensed ? "-DREPLAY_CONDENSED " : "";
}

}  // namespace

std::string replay_firmware(Estimator estimator, const Core& core) {
  return compiler(core) + "-g -fcallgraph-info=su " + which_sensor(estimator) +
         SPOOLFLOW_FIRMWARE "/board.cpp " SPOOLFLOW_FIRMWARE "/replay.cpp -o replay.elf" + link() + core.libraries;
}

model::Model on_both_sides(model::Model model) {
  model.p_to_a = model::Direction{model.condensed, model.observer, model.evidence};
  model.valve.direction = "both";
  return model;
}

Replay replay(const model::Model& model, Estimator estimator, const fs::path& recording, const Core& core) {
  Workshop workshop(model);
  workshop.write("run.bin", packed_run(model, estimator, recording));
  workshop.run(replay_firmware(estimator, core));
  const Figures figures = figures_of(workshop.run(emulator(core, "replay.elf")));
  if (figures.at("overflowing") > 0) throw std::runtime_error("a step took more instructions than the firmware counts");

  Replay out{};
  out.points = figures.at("points");
  out.largest_error_percent = 1e-4 * figures.at("error_ppm");
  out.not_a_number = figures.at("not_a_number");
  out.made_nan = (figures.at("flags_recorded") & 1U) != 0;
  out.met_denormal = (figures.at("flags") & 0x88U) != 0;
  out.statuses = static_cast<sensor::Status>(figures.at("statuses"));
  out.all = cost(figures, "all", "all");
  const std::vector<std::string> names = ways(estimator);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const StepCost way = cost(figures, fmt::format("mode{}", k), names[k]);
    if (way.steps > 0) out.ways.push_back(way);
  }
  if (std::string(core.flags).find("hard") != std::string::npos)
    out.longest_way = static_cast<std::uint32_t>(
        longest_way_of(workshop, "replay.elf", step_code_of(workshop, "replay.elf")).size() + call_instructions);
  out.state_bytes = figures.at("state_bytes");
  out.stack_bytes = figures.at("stack_bytes");
  out.worst_stack_bytes = worst_stack_bytes(workshop.run("cat replay.elf-replay.ci"), "one_step");
  out.flash_bytes = flash_bytes(workshop, core, which_sensor(estimator));
  return out;
}

int self_test_status(const model::Model& model, const Core& core) {
  Workshop workshop(model);
  workshop.run(compiler(core) + SPOOLFLOW_FIRMWARE "/board.cpp self_test.cpp -o self_test.elf" + link() +
               core.libraries);
  workshop.run(emulator(core, "self_test.elf"), 3);
  return workshop.status();
}

}  // namespace spoolflow::cortex_m
