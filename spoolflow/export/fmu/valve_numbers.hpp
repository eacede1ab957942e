#pragma once
/// The virtual valve's parameters as a row of numbers, in the order in which the rig describes them.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/export/fmu/resource.hpp"
#include "spoolflow/numerics/checksum.hpp"
#include "spoolflow/rig/electronics/electronics.hpp"
#include "spoolflow/rig/instruments/instruments.hpp"
#include "spoolflow/rig/plant/valve_plant.hpp"

namespace spoolflow::exports::fmu {

/// A valve as built, with the electronics and instruments that it brings along.
struct VirtualValve {
  rig::PlantParameters plant;
  rig::Electronics electronics;
  rig::Instruments instruments;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("plant", self.plant);
    visit("electronics", self.electronics);
    visit("instruments", self.instruments);
  }
};

/// Choices that are no described numbers come first: kind of load, ideal hold, kind of the solenoids' hysteresis,
/// return line of the load, shape of the dither, what chooses the solenoid.
inline constexpr std::size_t valve_choices = 7;
inline std::vector<double> numbers_of(const VirtualValve& valve) {
  std::vector<double> out{static_cast<double>(valve.plant.load.kind),
                          valve.plant.load.ideal_hold ? 1.0 : 0.0,
                          static_cast<double>(valve.plant.solenoid_a.hysteresis.kind),
                          static_cast<double>(valve.plant.solenoid_b.hysteresis.kind),
                          valve.plant.load.return_to_tank ? 1.0 : 0.0,
                          static_cast<double>(valve.electronics.dither.shape),
                          valve.electronics.sign_chooses ? 1.0 : 0.0};
  rig::for_each_parameter(valve, [&](std::string_view, const rig::Parameter&, double value) { out.push_back(value); });
  return out;
}

/// Name of the order of the numbers.
inline std::string valve_order() {
  numerics::Checksum keys;
  const VirtualValve any;
  rig::for_each_parameter(
      any, [&](std::string_view path, const rig::Parameter&, double) { keys.add(path.data(), path.size()); });
  return "valve " + std::to_string(keys.value());
}

/// The inverse of numbers_of. Throws ResourceError where there are too few or too many numbers.
inline void take_numbers(std::span<const double> numbers, VirtualValve& valve) {
  std::size_t next = valve_choices;
  rig::for_each_parameter(valve, [&](std::string_view, const rig::Parameter&, double& value) {
    if (next < numbers.size()) value = numbers[next];
    ++next;
  });
  const auto is_hysteresis = [](double number) { return number >= 0 && number <= 1; };
  if (next != numbers.size() || !(numbers[0] >= 0 && numbers[0] <= 5) || !is_hysteresis(numbers[2]) ||
      !is_hysteresis(numbers[3]) || !(numbers[5] >= 0 && numbers[5] <= 2)) {
    throw ResourceError("the resource holds other numbers than this valve has; export the FMU again");
  }
  valve.plant.load.kind = static_cast<rig::LoadKind>(static_cast<int>(numbers[0]));
  valve.plant.load.ideal_hold = numbers[1] != 0;
  valve.plant.solenoid_a.hysteresis.kind = static_cast<rig::HysteresisKind>(static_cast<int>(numbers[2]));
  valve.plant.solenoid_b.hysteresis.kind = static_cast<rig::HysteresisKind>(static_cast<int>(numbers[3]));
  valve.plant.load.return_to_tank = numbers[4] != 0;
  valve.electronics.dither.shape = static_cast<rig::DitherShape>(static_cast<int>(numbers[5]));
  valve.electronics.sign_chooses = numbers[6] != 0;
}

}  // namespace spoolflow::exports::fmu
