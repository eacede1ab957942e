/// The sensor inside an FMU.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/export/fmu/component.hpp"
#include "spoolflow/export/fmu/sensor_numbers.hpp"
#include "spoolflow/export/fmu/sensor_variables.hpp"
#include "spoolflow/model/limit_check.hpp"

namespace spoolflow::exports::fmu {
namespace {

template <class Parameters>
class SensorComponent : public Component {
 public:
  /// `numbers`: rated flow, stroke, parameters.
  SensorComponent(const Resource& resource, std::uint64_t identity)
      : identity_(identity), running_(&parameters_, resource.numbers.at(0)) {
    const std::span<const double> numbers(resource.numbers);
    take_numbers(numbers.subspan(2), parameters_);
    if (const auto wrong = broken_limit()) {
      throw ResourceError(model::joined({"the resource is damaged: ", wrong->path, ": ", wrong->problem,
                                         "; export the FMU again with `spoolflow export fmu`"}));
    }
    running_.parameters_changed();
    tunable_ = tunable_numbers(parameters_);
    variables_ = sensor_variables({numbers[0], numbers[1]}, tunable_);
  }

  [[nodiscard]] const std::vector<Variable>& variables() const override { return variables_; }
  [[nodiscard]] std::uint64_t identity() const override { return identity_; }
  [[nodiscard]] double sample_step_s(std::span<const double> values) const override {
    return values[sensor_sample_step];
  }
  void tune(std::span<const double> values) override {
    const Parameters before = parameters_;
    for (std::size_t k = 0; k < tunable_.size(); ++k) *tunable_[k].value = values[sensor_first_tunable + k];
    if (const auto wrong = broken_limit()) {
      parameters_ = before;
      throw CallError(model::joined(
          {"the parameters do not fit together: ", std::string_view(wrong->path).substr(1), ": ", wrong->problem}));
    }
    running_.parameters_changed();
  }
  void start(std::span<double> values) override {
    running_.reset();
    estimation::RunningSensor ahead = running_;
    tell(ahead.step(sample_of(values, 0)), values);
  }
  void sample(std::span<double> values, std::int64_t number) override {
    tell(running_.step(sample_of(values, number)), values);
  }
  [[nodiscard]] std::span<char> memory() override {
    return {reinterpret_cast<char*>(&running_.state()), sizeof(estimation::RunningState)};
  }

 private:
  [[nodiscard]] std::optional<model::Violation> broken_limit() const {
    return model::violation(parameters_, [](auto& parameters, auto& visitor) { describe(parameters, visitor); });
  }
  static estimation::TimedSample sample_of(std::span<const double> values, std::int64_t number) {
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    return {.time_s = static_cast<double>(number) * values[sensor_sample_step],
            .current_A = values[sensor_current],
            .voltage_V = values[sensor_use_voltage] != 0 ? values[sensor_voltage] : nothing,
            .position_m = values[sensor_position],
            .oil_temperature_K = values[sensor_use_oil_temperature] != 0 ? values[sensor_oil_temperature] : nothing};
  }
  static void tell(const sensor::Estimate<double>& estimate, std::span<double> values) {
    values[sensor_flow] = estimate.flow_m3_per_s;
    values[sensor_flow_lower] = estimate.flow_lower_m3_per_s;
    values[sensor_flow_upper] = estimate.flow_upper_m3_per_s;
    values[sensor_pressure_difference] = estimate.pressure_difference_Pa;
    values[sensor_magnetic_force] = estimate.magnetic_force_N;
    values[sensor_spring_force] = estimate.spring_force_N;
    values[sensor_flow_force] = estimate.flow_force_N;
    values[sensor_friction_force] = estimate.friction_force_N;
    const auto bits = static_cast<std::uint32_t>(estimate.status);
    values[sensor_status] = bits;
    values[sensor_fault] = (bits & sensor::fault_bits) != 0 ? 1 : 0;
  }

  std::uint64_t identity_;
  Parameters parameters_{};
  std::vector<TunableNumber> tunable_;
  std::vector<Variable> variables_;
  estimation::RunningSensor running_;
};

}  // namespace

std::unique_ptr<Component> load_component(const std::string& resource_folder, const std::string& token) {
  using Condensed = sensor::CondensedParameters<double>;
  using Observer = sensor::ObserverParameters<double>;
  const Resource resource = read_resource(resource_folder, token);
  const std::uint64_t identity = checksum(resource.token.data(), resource.token.size());
  if (resource.numbers.size() < 2) throw ResourceError("the resource holds no sensor");
  if (resource.kind == order_of<Observer>("observer")) {
    return std::make_unique<SensorComponent<Observer>>(resource, identity);
  }
  if (resource.kind == order_of<Condensed>("condensed")) {
    return std::make_unique<SensorComponent<Condensed>>(resource, identity);
  }
  throw ResourceError("the resource holds '" + resource.kind +
                      "', not a sensor of this version; export the FMU again with `spoolflow export fmu`");
}

}  // namespace spoolflow::exports::fmu
