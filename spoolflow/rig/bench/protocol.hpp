#pragma once
/// Every protocol of the rig by the name that scenario files use.
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "spoolflow/rig/bench/operation_protocols.hpp"
#include "spoolflow/rig/bench/solenoid_protocols.hpp"
#include "spoolflow/rig/bench/stroke_protocols.hpp"
#include "spoolflow/rig/bench/valve_under_test.hpp"

namespace spoolflow::rig {

/// The settings of one protocol.
using Protocol = std::variant<AxialForceProtocol, SolenoidForceMapProtocol, SolenoidDynamicProtocol, FlowBenchProtocol,
                              RampsProtocol, StepsProtocol, SineProtocol, DutyCycleProtocol, PressureStepsProtocol>;

struct NamedProtocol {
  std::string_view name;
  std::string_view purpose;
  Protocol settings;  ///< as they are unless a scenario says otherwise
};

[[nodiscard]] const std::vector<NamedProtocol>& protocols();
/// Throws std::out_of_range for an unknown name.
[[nodiscard]] Protocol protocol_named(std::string_view name);

/// Of one solenoid or one direction of flow alone, not of the valve at work.
[[nodiscard]] bool is_bench_test(const Protocol& protocol);

/// The run that the settings describe, on that valve; random courses follow from `seed`. Operation of a whole valve
/// records both coils, signed flow and the pressure difference of the open path.
[[nodiscard]] BenchRun plan(const Protocol& protocol, const ValveUnderTest& valve, std::uint64_t seed);

}  // namespace spoolflow::rig
