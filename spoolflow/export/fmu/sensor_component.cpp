/// The sensor inside an FMU.
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/estimation/state_check.hpp"
#include "spoolflow/export/fmu/component.hpp"
#include "spoolflow/export/fmu/sensor_numbers.hpp"
#include "spoolflow/export/fmu/sensor_variables.hpp"
#include "spoolflow/model/limit_check.hpp"
#include "spoolflow/numerics/padding.hpp"

namespace spoolflow::exports::fmu {
namespace {

using Condensed = sensor::CondensedParameters<double>;
using Observer = sensor::ObserverParameters<double>;
using estimation::RunningSensor;

template <class Parameters>
inline constexpr bool of_both = false;
template <class Parameters>
inline constexpr bool of_both<BothDirections<Parameters>> = true;

RunningSensor::Parameters parameters_of(const Condensed& parameters) {
  return &parameters;
}
RunningSensor::Parameters parameters_of(const Observer& parameters) {
  return &parameters;
}
RunningSensor::Parameters parameters_of(const BothDirections<Condensed>& parameters) {
  return RunningSensor::WholeCondensed{&parameters.b, &parameters.a};
}
RunningSensor::Parameters parameters_of(const BothDirections<Observer>& parameters) {
  return sensor::WholeValveParameters<double>{&parameters.b, &parameters.a};
}

template <class Parameters>
std::optional<model::Violation> violation_of(const Parameters& parameters) {
  return model::violation(parameters, [](auto& described, auto& visitor) { describe(described, visitor); });
}
template <class Parameters>
std::optional<model::Violation> violation_of(const BothDirections<Parameters>& parameters) {
  std::optional<model::Violation> found = violation_of(parameters.b);
  const std::string_view direction = found ? "/b" : "/a";
  if (!found) found = violation_of(parameters.a);
  if (found) found->path = model::joined({direction, found->path});
  return found;
}

template <class Parameters>
class SensorComponent : public Component {
 public:
  /// `numbers`: rated flow, stroke, parameters.
  SensorComponent(const Resource& resource, std::uint64_t identity)
      : identity_(identity), running_(parameters_of(parameters_), resource.numbers.at(0)) {
    const std::span<const double> numbers(resource.numbers);
    take_numbers(numbers.subspan(2), parameters_);
    if (const auto wrong = violation_of(parameters_)) {
      throw ResourceError(model::joined({"the resource is damaged: ", wrong->path, ": ", wrong->problem,
                                         "; export the FMU again with `spoolflow export fmu`"}));
    }
    running_.parameters_changed();
    tunable_ = tunable_numbers(parameters_);
    variables_ = sensor_variables({numbers[0], numbers[1], whole}, tunable_);
  }

  [[nodiscard]] const std::vector<Variable>& variables() const override { return variables_; }
  [[nodiscard]] std::uint64_t identity() const override { return identity_; }
  [[nodiscard]] double sample_step_s(std::span<const double> values) const override {
    return values[sensor_sample_step];
  }
  void tune(std::span<const double> values) override {
    const Parameters before = parameters_;
    for (std::size_t k = 0; k < tunable_.size(); ++k) *tunable_[k].value = values[first_tunable + k];
    if (const auto wrong = violation_of(parameters_)) {
      parameters_ = before;
      throw CallError(model::joined(
          {"the parameters do not fit together: ", std::string_view(wrong->path).substr(1), ": ", wrong->problem}));
    }
    running_.parameters_changed();
  }
  void start(std::span<double> values) override {
    running_.reset();
    RunningSensor ahead = running_;
    write_outputs(ahead.step(timed_sample(values, 0, whole)), values);
  }
  void sample(std::span<double> values, std::int64_t number) override {
    write_outputs(running_.step(timed_sample(values, number, whole)), values);
  }
  [[nodiscard]] std::span<char> memory() override {
    return {reinterpret_cast<char*>(&running_.state()), sizeof(estimation::RunningState)};
  }
  void clear_padding() override { numerics::clear_padding(running_.state()); }
  [[nodiscard]] bool may_be_memory(std::span<const char> bytes) const override {
    return bytes.size() == sizeof(estimation::RunningState) && estimation::may_be_running_state(bytes.data());
  }

 private:
  static constexpr bool whole = of_both<Parameters>;
  static constexpr std::size_t first_tunable = whole ? whole_first_tunable : sensor_first_tunable;

  static void write_outputs(const sensor::Estimate<double>& estimate, std::span<double> values) {
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
  RunningSensor running_;
};

/// Null where the resource holds something else.
template <class Parameters>
std::unique_ptr<Component> made(const Resource& resource, std::string_view estimator, std::uint64_t identity) {
  if (resource.kind != order_of<Parameters>(estimator)) return nullptr;
  return std::make_unique<SensorComponent<Parameters>>(resource, identity);
}

}  // namespace

std::unique_ptr<Component> load_component(const std::string& resource_folder, const std::string& token) {
  const Resource resource = read_resource(resource_folder, token);
  const std::uint64_t identity = numerics::checksum(resource.token.data(), resource.token.size());
  if (resource.numbers.size() < 2) throw ResourceError("the resource holds no sensor");
  std::unique_ptr<Component> out = made<Observer>(resource, "observer", identity);
  if (!out) out = made<Condensed>(resource, "condensed", identity);
  if (!out) out = made<BothDirections<Observer>>(resource, "observer of both directions", identity);
  if (!out) out = made<BothDirections<Condensed>>(resource, "condensed of both directions", identity);
  if (out) return out;
  throw ResourceError("the resource holds '" + resource.kind +
                      "', not a sensor of this version; export the FMU again with `spoolflow export fmu`");
}

}  // namespace spoolflow::exports::fmu
