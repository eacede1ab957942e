#pragma once
/// The findings as pictures for docs/rig.md.
#include <filesystem>

#include "tests/findings/condensed_errors.hpp"
#include "tests/findings/flow_forces.hpp"
#include "tests/findings/hunting.hpp"
#include "tests/findings/solenoid_loops.hpp"

namespace spoolflow::findings {

struct Measured {
  std::vector<SolenoidLoop> plain, dithered;
  std::vector<FlowForceCurve> flow_forces;
  std::vector<TemperatureEffect> temperature;
  std::vector<Rest> rests;
  CondensedRuns condensed;
};

/// Writes SVG files into `folder`, which exists.
void draw(const Measured& measured, const std::filesystem::path& folder);

}  // namespace spoolflow::findings
