/// What a step of the exported sensors costs on emulated cores: instructions, flash, memory.
/// cortex_m_cost MODEL.json RECORDING
#include <exception>

#include <fmt/format.h>

#include "tests/cortex_m/replay.hpp"

namespace {

using namespace spoolflow;

void print(const cortex_m::Core& core, estimation::Estimator estimator, const cortex_m::Replay& replay) {
  fmt::print("{}, {}: {} samples, largest difference to double precision on the host {:.4f} % of the rated flow\n",
             core.name, estimation::name(estimator), replay.points, replay.largest_error_percent);
  fmt::print("  {:<20}{:>9}{:>9}{:>9}{:>9}\n", "instructions a step", "steps", "median", "mean", "largest");
  const auto line = [](const cortex_m::StepCost& cost) {
    fmt::print("  {:<20}{:>9}{:>9}{:>9}{:>9}\n", cost.way, cost.steps, cost.median, cost.mean, cost.largest);
  };
  line(replay.all);
  for (const cortex_m::StepCost& way : replay.ways) line(way);
  if (replay.longest_way) fmt::print("  longest way through the code {} instructions\n", *replay.longest_way);
  fmt::print("  code and tables {} bytes of flash, state {} bytes, stack {} bytes at most\n\n", replay.flash_bytes,
             replay.state_bytes, replay.worst_stack_bytes);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: cortex_m_cost MODEL.json RECORDING\n");
    return 2;
  }
  try {
    const model::Model model = model::read_model(argv[1]);
    const auto cost_on = [&](const cortex_m::Core& core) {
      for (const auto estimator : {estimation::Estimator::observer, estimation::Estimator::condensed}) {
        print(core, estimator, cortex_m::replay(model, estimator, argv[2], core));
      }
    };
    for (const cortex_m::Core& core : cortex_m::cores) cost_on(core);
    for (const cortex_m::Core& core : cortex_m::soft_float_cores) cost_on(core);
  } catch (const std::exception& error) {
    fmt::print(stderr, "cortex_m_cost: {}\n", error.what());
    return 1;
  }
  return 0;
}
