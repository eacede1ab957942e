#pragma once
/// One simulated recording as a TOML file describes it.
///
///     protocol = "ramps"               # required; the protocols of protocol.hpp
///     valve = "size_6"                 # a preset, or the path of a valve file beside this one
///     seed = 3
///     direction = "b"                  # bench tests: b opens P to B, a opens P to A
///     edge = "path"                    # axial_force_map and spring: P to B and A to T together (or their mirror
///                                      # images), or one edge of "PB", "AT", "PA", "BT"
///     [run]                            # settings of the protocol
///     pressure_differences_bar = [60]
///     [machine.ripple]                 # operation: what a machine does to the valve (machine.hpp)
///     amplitude_bar = 3
///     [plant.spool_friction]           # anything a valve file may hold
///     base_N = 2.0
#include <filesystem>

#include "spoolflow/rig/bench/protocol.hpp"

namespace spoolflow::rig {

struct Scenario {
  ValveUnderTest valve;                ///< before spread and wear
  std::filesystem::path valve_file{};  ///< that it was read from; empty: a preset
  Protocol protocol;
  bool direction_a = false;  ///< a bench test of direction a, P to A
  Machine machine{};         ///< round the valve at work
};

/// Throws SettingsError with file, line, value, range and the nearest key.
[[nodiscard]] Scenario read_scenario(const std::filesystem::path& file);

/// Valve as built, and its run.
struct PlannedScenario {
  ValveUnderTest valve;
  BenchRun run;
};
[[nodiscard]] PlannedScenario plan(const Scenario& scenario);

}  // namespace spoolflow::rig
