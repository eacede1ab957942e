/// The virtual valve inside an FMU: plant, on-board electronics and instruments, stepped at the electronics' period.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "spoolflow/export/fmu/component.hpp"
#include "spoolflow/export/fmu/instance.hpp"
#include "spoolflow/export/fmu/number_text.hpp"
#include "spoolflow/export/fmu/valve_numbers.hpp"
#include "spoolflow/export/fmu/valve_variables.hpp"
#include "spoolflow/export/state_bytes.hpp"
#include "spoolflow/numerics/number_check.hpp"
#include "spoolflow/numerics/padding.hpp"
#include "spoolflow/rig/instruments/coil_panel.hpp"
#include "spoolflow/rig/plant/solenoid.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::exports::fmu {
namespace {

using rig::electronics_period_s;

/// Everything that moves.
struct ValveMemory {
  rig::PlantState plant;
  rig::ElectronicsState electronics;
  rig::Noise stage_noise;
  rig::LvdtReading lvdt;
  rig::CoilPanel active;  ///< of both coils, that of a negative
  rig::Transducer thermometer;
  rig::CoilPanel coil_a, coil_b;
  std::int64_t conversions = 0;

  ValveMemory(const VirtualValve& valve, std::uint64_t seed, const rig::PlantState& at_rest, double oil_temperature_C)
      : plant(at_rest),
        stage_noise(seed, "current sensing of the electronics"),
        lvdt(valve.instruments.lvdt, seed, at_rest.position_m, oil_temperature_C),
        active(valve.instruments, seed, ""),
        thermometer(valve.instruments.thermometer.errors, seed, "thermometer", oil_temperature_C),
        coil_a(valve.instruments, seed, " of solenoid a"),
        coil_b(valve.instruments, seed, " of solenoid b") {}
};
static_assert(std::is_trivially_copyable_v<ValveMemory>);

rig::PlantInput surroundings(std::span<const double> values) {
  rig::PlantInput input;
  input.supply_pressure_Pa = values[valve_supply_pressure];
  input.held_pressure_difference_Pa = values[valve_pressure_difference_set];
  input.load_force_N = values[valve_load_force];
  input.oil_temperature_C = units::degC_from_K(values[valve_oil_temperature_set]);
  input.ambient_temperature_C = units::degC_from_K(values[valve_ambient_temperature]);
  return input;
}

class ValveComponent : public Component {
 public:
  /// `numbers`: rated flow, then the valve.
  ValveComponent(const Resource& resource, std::uint64_t identity) : identity_(identity) {
    const std::span<const double> numbers(resource.numbers);
    take_numbers(numbers.subspan(1), valve_);
    variables_ = valve_variables(valve_, numbers[0]);
    std::vector<double> starts;
    for (const Variable& variable : variables_) starts.push_back(variable.start);
    begin(starts);
  }

  [[nodiscard]] const std::vector<Variable>& variables() const override { return variables_; }
  [[nodiscard]] std::uint64_t identity() const override { return identity_; }
  [[nodiscard]] double sample_step_s(std::span<const double>) const override { return electronics_period_s; }

  void tune(std::span<const double> values) override {
    valve_.electronics.dither.amplitude_A = values[valve_dither_amplitude];
    valve_.electronics.dither.frequency_Hz = values[valve_dither_frequency];
    valve_.plant.supply.ripple_Pa = values[valve_supply_ripple];
  }

  void start(std::span<double> values) override {
    check_inputs(values);
    begin(values);
    write_outputs(values, surroundings(values), 0);
  }

  void sample(std::span<double> values, std::int64_t number) override {
    check_inputs(values);
    ValveMemory& memory = *memory_;
    rig::PlantInput input = surroundings(values);
    const rig::SolenoidVoltages voltages =
        step(valve_.electronics, memory.electronics,
             {.position_set_m =
                  std::clamp(values[valve_position_set], -valve_.plant.spool.stroke_m, valve_.plant.spool.stroke_m),
              .position_signal_m = memory.lvdt.valve_signal_m(),
              .current_a_A = winding_current_A(valve_.plant.solenoid_a, memory.plant.solenoid_a),
              .current_b_A = winding_current_A(valve_.plant.solenoid_b, memory.plant.solenoid_b)},
             memory.stage_noise);
    input.voltage_a_V = voltages.a_V;
    input.voltage_b_V = voltages.b_V;
    step(valve_.plant, memory.plant, input, electronics_period_s);
    if (!std::isfinite(memory.plant.position_m) || !std::isfinite(memory.plant.pressure_P_Pa) ||
        !std::isfinite(memory.plant.solenoid_b.flux_linkage_Wb)) {
      throw std::runtime_error("the simulated valve left the finite numbers; check the inputs' sizes and units");
    }
    memory.lvdt.follow(memory.plant.position_m, input.oil_temperature_C, electronics_period_s);
    const double current_a_A = winding_current_A(valve_.plant.solenoid_a, memory.plant.solenoid_a);
    const double current_b_A = winding_current_A(valve_.plant.solenoid_b, memory.plant.solenoid_b);
    memory.active.follow(current_b_A - current_a_A, voltages.b_V - voltages.a_V);
    memory.coil_a.follow(current_a_A, voltages.a_V);
    memory.coil_b.follow(current_b_A, voltages.b_V);
    ++memory.conversions;
    const auto ticks = std::max<std::int64_t>(1, std::llround(values[valve_sample_step] / electronics_period_s));
    if ((number + 1) % ticks == 0) {
      memory.thermometer.follow(input.oil_temperature_C, static_cast<double>(ticks) * electronics_period_s);
      write_outputs(values, input, static_cast<double>(number + 1) * electronics_period_s);
    }
  }

  void clear_padding() override {
    numerics::clear_padding(memory_->plant);
    numerics::clear_padding(memory_->electronics);
  }
  [[nodiscard]] bool may_be_memory(std::span<const char> bytes) const override {
    if (bytes.size() != sizeof(ValveMemory)) return false;
    ValveMemory memory = *memory_;
    std::memcpy(&memory, bytes.data(), sizeof memory);
    return numerics::holds_numbers(memory.electronics) && numerics::holds_numbers(memory.plant) &&
           memory.conversions >= 0;
  }
  [[nodiscard]] std::span<char> memory() override { return {reinterpret_cast<char*>(&*memory_), sizeof(ValveMemory)}; }

 private:
  /// The plant does not survive a NaN or an absurd input: a step with one is refused before anything has moved.
  void check_inputs(std::span<const double> values) const {
    for (std::size_t k = 0; k < variables_.size(); ++k) {
      const Variable& input = variables_[k];
      if (input.causality != Causality::input) continue;
      if (!std::isfinite(values[k])) throw StepRefused("the input " + input.name + " is no finite number");
      if (values[k] < input.lowest || values[k] > input.highest) {
        throw StepRefused("the input " + input.name + " = " + number_text(values[k]) + " is outside " +
                          number_text(input.lowest) + " to " + number_text(input.highest) + " " + input.unit);
      }
    }
  }

  void begin(std::span<const double> values) {
    const rig::PlantInput input = surroundings(values);
    memory_.emplace(valve_, static_cast<std::uint64_t>(values[valve_seed]), plant_at_rest(valve_.plant, input),
                    input.oil_temperature_C);
  }

  /// One reading of every instrument, and the truth; starts new means of current and voltage.
  void write_outputs(std::span<double> values, const rig::PlantInput& input, double time_s) {
    ValveMemory& memory = *memory_;
    const auto conversions = static_cast<double>(std::max<std::int64_t>(1, memory.conversions));
    const auto set_coil = [&](rig::CoilPanel& coil, std::uint32_t current, std::uint32_t voltage) {
      coil.end_period(conversions);
      values[current] = coil.current_A();
      values[voltage] = coil.voltage_V();
    };
    set_coil(memory.active, valve_current, valve_voltage);
    set_coil(memory.coil_a, valve_current_a, valve_voltage_a);
    set_coil(memory.coil_b, valve_current_b, valve_voltage_b);
    memory.conversions = 0;
    values[valve_position] = memory.lvdt.acquired_m(time_s);
    values[valve_oil_temperature] = units::K_from_degC(memory.thermometer.reading());
    const rig::PlantOutput truth = observe(valve_.plant, memory.plant, input);
    values[valve_flow] = truth.position_m < 0 ? -truth.flow_m3_per_s : truth.flow_m3_per_s;
    values[valve_pressure_difference] = truth.pressure_difference_Pa;
    values[valve_true_position] = truth.position_m;
    values[valve_magnetic_force] = truth.magnetic_force_N;
    values[valve_flow_force] = truth.flow_force_N;
    values[valve_friction_force] = truth.armature_friction_force_N + truth.spool_friction_force_N;
    values[valve_pressure_P] = truth.pressure_P_Pa;
    values[valve_pressure_A] = truth.pressure_A_Pa;
    values[valve_pressure_B] = truth.pressure_B_Pa;
    values[valve_cylinder_position] = truth.cylinder_position_m;
    values[valve_true_velocity] = truth.velocity_m_per_s;
    values[valve_true_acceleration] = truth.acceleration_m_per_s2;
    values[valve_cylinder_velocity] = truth.cylinder_velocity_m_per_s;
  }

  std::uint64_t identity_;
  VirtualValve valve_;
  std::vector<Variable> variables_;
  std::optional<ValveMemory> memory_;
};

}  // namespace

std::unique_ptr<Component> load_component(const std::string& resource_folder, const std::string& token) {
  const Resource resource = read_resource(resource_folder, token);
  if (resource.kind != valve_order() || resource.numbers.size() < 3) {
    throw ResourceError("the resource holds '" + resource.kind +
                        "', not a virtual valve of this version; export the FMU again with `spoolflow export fmu`");
  }
  return std::make_unique<ValveComponent>(resource, numerics::checksum(resource.token.data(), resource.token.size()));
}

}  // namespace spoolflow::exports::fmu
