/// The functions of spoolflow.h that make and drive a sensor. Nothing thrown leaves them.
#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>

#include "spoolflow/estimation/columns.hpp"
#include "spoolflow/estimation/state_check.hpp"
#include "spoolflow/export/c_interface/spoolflow.h"
#include "spoolflow/export/state_bytes.hpp"
#include "spoolflow/model/json_text.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/numerics/padding.hpp"

namespace {

using spoolflow::estimation::RunningSensor;
using spoolflow::estimation::RunningState;
using spoolflow::model::Model;
namespace sensor = spoolflow::sensor;
namespace exports = spoolflow::exports;

/// A model that several sensors may share.
struct SharedModel {
  Model model;
  std::uint64_t checksum;  ///< of the file's text
};

void write_message(std::string_view text, char* message, std::size_t size) {
  if (message == nullptr || size == 0) return;
  const std::size_t length = std::min(text.size(), size - 1);
  std::memcpy(message, text.data(), length);
  message[length] = '\0';
}

/// The observer was asked for, and the model has none.
struct NotCalibrated : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};
/// The file cannot be opened or is empty.
struct BadFile : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Calls `work` and turns what it throws into a result with its message.
template <class Work>
spoolflow_result guarded(char* message, std::size_t size, Work&& work) noexcept {
  write_message("", message, size);
  try {
    work();
    return SPOOLFLOW_OK;
  } catch (const NotCalibrated& error) {
    return write_message(error.what(), message, size), SPOOLFLOW_NOT_CALIBRATED;
  } catch (const BadFile& error) {
    return write_message(error.what(), message, size), SPOOLFLOW_BAD_FILE;
  } catch (const spoolflow::model::ModelError& error) {
    return write_message(error.what(), message, size), SPOOLFLOW_BAD_MODEL;
  } catch (const exports::StateError& error) {
    return write_message(error.what(), message, size), SPOOLFLOW_BAD_STATE;
  } catch (const std::bad_alloc&) {
    return write_message("out of memory", message, size), SPOOLFLOW_OUT_OF_MEMORY;
  } catch (const std::exception& error) {
    return write_message(error.what(), message, size), SPOOLFLOW_FAILED;
  } catch (...) {
    return write_message("a failure without a name", message, size), SPOOLFLOW_FAILED;
  }
}

spoolflow_result refuse(const char* text, char* message, std::size_t size) noexcept {
  write_message(text, message, size);
  return SPOOLFLOW_BAD_ARGUMENT;
}

RunningSensor::Parameters parameters(const Model& model, spoolflow_estimator estimator) {
  if (estimator == SPOOLFLOW_OBSERVER && !model.has_observer()) {
    throw NotCalibrated(
        "the model of " + model.valve.name +
        " is not calibrated for the observer; calibrate it with a solenoid_dynamic recording, or ask for "
        "the condensed sensor");
  }
  if (estimator == SPOOLFLOW_CONDENSED || !model.has_observer()) {
    if (!model.whole()) return &model.condensed.parameters;
    return RunningSensor::WholeCondensed{&model.condensed.parameters, &model.p_to_a->condensed.parameters};
  }
  if (!model.whole()) return &model.observer->parameters;
  return sensor::WholeValveParameters<double>{&model.observer->parameters, &model.p_to_a->observer->parameters};
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code unreadable;
  if (!in || std::filesystem::is_directory(file, unreadable)) {
    throw BadFile(file.string() + ": cannot be opened; check the path, or make a model with `spoolflow calibrate`");
  }
  std::string text = spoolflow::model::read_json_text(in);
  if (text.empty()) {
    throw BadFile(file.string() + ": the file is empty; make the model again with `spoolflow calibrate`");
  }
  return text;
}

spoolflow_estimate answer_in_c(const sensor::Estimate<double>& estimate) {
  return {estimate.flow_m3_per_s,          estimate.flow_lower_m3_per_s, estimate.flow_upper_m3_per_s,
          estimate.pressure_difference_Pa, estimate.magnetic_force_N,    estimate.spring_force_N,
          estimate.flow_force_N,           estimate.friction_force_N,    static_cast<std::uint32_t>(estimate.status)};
}

}  // namespace

struct spoolflow_sensor {
  std::shared_ptr<const SharedModel> shared;
  RunningSensor running;

  spoolflow_sensor(std::shared_ptr<const SharedModel> model, spoolflow_estimator estimator)
      : shared(std::move(model)),
        running(parameters(shared->model, estimator), shared->model.valve.rated_flow_m3_per_s) {}

  [[nodiscard]] exports::StateOwner owner() const { return {shared->checksum, running.runs_condensed() ? 1U : 2U}; }
};

namespace {

std::unique_ptr<spoolflow_sensor> made(const std::string& text, const std::string& name,
                                       spoolflow_estimator estimator) {
  auto shared = std::make_shared<const SharedModel>(
      SharedModel{spoolflow::model::parse_model(text, name), spoolflow::numerics::checksum(text.data(), text.size())});
  return std::make_unique<spoolflow_sensor>(std::move(shared), estimator);
}

bool known(spoolflow_estimator estimator) {
  return estimator == SPOOLFLOW_BEST || estimator == SPOOLFLOW_CONDENSED || estimator == SPOOLFLOW_OBSERVER;
}

}  // namespace

spoolflow_result spoolflow_create(const char* path, spoolflow_estimator estimator, spoolflow_sensor** sensor,
                                  char* message, size_t message_size) {
  if (sensor == nullptr) return refuse("sensor must not be NULL", message, message_size);
  *sensor = nullptr;
  if (path == nullptr) return refuse("path must not be NULL", message, message_size);
  if (!known(estimator)) return refuse("estimator is unknown", message, message_size);
  return guarded(message, message_size, [&] { *sensor = made(text_of(path), path, estimator).release(); });
}

spoolflow_result spoolflow_create_from_memory(const char* text, size_t size, spoolflow_estimator estimator,
                                              spoolflow_sensor** sensor, char* message, size_t message_size) {
  if (sensor == nullptr) return refuse("sensor must not be NULL", message, message_size);
  *sensor = nullptr;
  if (text == nullptr) return refuse("text must not be NULL", message, message_size);
  if (!known(estimator)) return refuse("estimator is unknown", message, message_size);
  return guarded(message, message_size, [&] { *sensor = made(std::string(text, size), "model", estimator).release(); });
}

spoolflow_result spoolflow_copy(const spoolflow_sensor* sensor, spoolflow_sensor** copy) {
  if (copy == nullptr) return SPOOLFLOW_BAD_ARGUMENT;
  *copy = nullptr;
  if (sensor == nullptr) return SPOOLFLOW_BAD_ARGUMENT;
  return guarded(nullptr, 0, [&] { *copy = std::make_unique<spoolflow_sensor>(*sensor).release(); });
}

void spoolflow_destroy(spoolflow_sensor* sensor) {
  delete sensor;
}

spoolflow_estimator spoolflow_runs(const spoolflow_sensor* sensor) {
  return sensor->running.runs_condensed() ? SPOOLFLOW_CONDENSED : SPOOLFLOW_OBSERVER;
}

const char* spoolflow_valve_name(const spoolflow_sensor* sensor) {
  return sensor->shared->model.valve.name.c_str();
}

double spoolflow_rated_flow(const spoolflow_sensor* sensor) {
  return sensor->shared->model.valve.rated_flow_m3_per_s;
}

int spoolflow_is_whole(const spoolflow_sensor* sensor) {
  return sensor->shared->model.whole() ? 1 : 0;
}

spoolflow_result spoolflow_step(spoolflow_sensor* sensor, const spoolflow_sample* sample,
                                spoolflow_estimate* estimate) {
  if (sensor == nullptr || sample == nullptr || estimate == nullptr) return SPOOLFLOW_BAD_ARGUMENT;
  *estimate = answer_in_c(sensor->running.step(
      {sample->time_s, sample->current_A, sample->voltage_V, sample->position_m, sample->oil_temperature_K}));
  return SPOOLFLOW_OK;
}

spoolflow_result spoolflow_step_whole(spoolflow_sensor* sensor, const spoolflow_whole_sample* sample,
                                      spoolflow_estimate* estimate) {
  return spoolflow_step_whole_ports(sensor, sample, nullptr, estimate);
}

spoolflow_result spoolflow_step_whole_ports(spoolflow_sensor* sensor, const spoolflow_whole_sample* sample,
                                            const spoolflow_port_pressures* ports, spoolflow_estimate* estimate) {
  if (sensor == nullptr || sample == nullptr || estimate == nullptr) return SPOOLFLOW_BAD_ARGUMENT;
  if (!sensor->shared->model.whole()) return SPOOLFLOW_BAD_ARGUMENT;
  sensor::PortPressures<double> measured;
  if (ports != nullptr) measured = {ports->p_Pa, ports->a_Pa, ports->b_Pa, ports->t_Pa};
  *estimate = answer_in_c(sensor->running.step(spoolflow::estimation::of_both_coils(
      {sample->time_s, sample->current_a_A, sample->current_b_A, sample->voltage_a_V, sample->voltage_b_V,
       sample->position_m, sample->oil_temperature_K, measured})));
  return SPOOLFLOW_OK;
}

namespace {

std::span<const double> column(const double* first, std::size_t count) {
  return first == nullptr ? std::span<const double>() : std::span(first, count);
}

/// `samples`: whatever `run` takes.
template <class Samples>
void step_columns(RunningSensor& running, const Samples& samples, const spoolflow_outputs& outputs) {
  const auto put = [](auto* column, std::size_t k, auto value) {
    if (column != nullptr) column[k] = value;
  };
  run(running, samples, [&](std::size_t k, const sensor::Estimate<double>& answer) {
    const spoolflow_estimate estimate = answer_in_c(answer);
    put(outputs.flow_m3_per_s, k, estimate.flow_m3_per_s);
    put(outputs.flow_lower_m3_per_s, k, estimate.flow_lower_m3_per_s);
    put(outputs.flow_upper_m3_per_s, k, estimate.flow_upper_m3_per_s);
    put(outputs.pressure_difference_Pa, k, estimate.pressure_difference_Pa);
    put(outputs.magnetic_force_N, k, estimate.magnetic_force_N);
    put(outputs.spring_force_N, k, estimate.spring_force_N);
    put(outputs.flow_force_N, k, estimate.flow_force_N);
    put(outputs.friction_force_N, k, estimate.friction_force_N);
    put(outputs.status, k, estimate.status);
  });
}

/// Columns of both coils, with a TimedSample at each index.
struct BothCoils {
  const spoolflow_whole_inputs& inputs;
  std::size_t count;

  [[nodiscard]] std::size_t size() const { return count; }
  [[nodiscard]] spoolflow::estimation::TimedSample operator[](std::size_t k) const {
    const auto of = [k](const double* column) {
      return column == nullptr ? spoolflow::estimation::not_measured : column[k];
    };
    return spoolflow::estimation::of_both_coils({inputs.time_s[k], inputs.current_a_A[k], inputs.current_b_A[k],
                                                 of(inputs.voltage_a_V), of(inputs.voltage_b_V), inputs.position_m[k],
                                                 of(inputs.oil_temperature_K)});
  }
};

}  // namespace

spoolflow_result spoolflow_step_arrays(spoolflow_sensor* sensor, size_t count, const spoolflow_inputs* inputs,
                                       const spoolflow_outputs* outputs) {
  if (sensor == nullptr || inputs == nullptr || outputs == nullptr || inputs->time_s == nullptr ||
      inputs->current_A == nullptr || inputs->position_m == nullptr) {
    return SPOOLFLOW_BAD_ARGUMENT;
  }
  const spoolflow::estimation::Columns columns{.time_s = column(inputs->time_s, count),
                                               .current_A = column(inputs->current_A, count),
                                               .voltage_V = column(inputs->voltage_V, count),
                                               .position_m = column(inputs->position_m, count),
                                               .oil_temperature_K = column(inputs->oil_temperature_K, count)};
  step_columns(sensor->running, columns, *outputs);
  return SPOOLFLOW_OK;
}

spoolflow_result spoolflow_step_whole_arrays(spoolflow_sensor* sensor, size_t count,
                                             const spoolflow_whole_inputs* inputs, const spoolflow_outputs* outputs) {
  if (sensor == nullptr || inputs == nullptr || outputs == nullptr || inputs->time_s == nullptr ||
      inputs->current_a_A == nullptr || inputs->current_b_A == nullptr || inputs->position_m == nullptr ||
      !sensor->shared->model.whole()) {
    return SPOOLFLOW_BAD_ARGUMENT;
  }
  step_columns(sensor->running, BothCoils{*inputs, count}, *outputs);
  return SPOOLFLOW_OK;
}

spoolflow_result spoolflow_reset(spoolflow_sensor* sensor) {
  if (sensor == nullptr) return SPOOLFLOW_BAD_ARGUMENT;
  sensor->running.reset();
  return SPOOLFLOW_OK;
}

size_t spoolflow_state_size(const spoolflow_sensor* sensor) {
  return sensor == nullptr ? 0 : exports::packed_size(sizeof(RunningState));
}

spoolflow_result spoolflow_get_state(const spoolflow_sensor* sensor, void* bytes, size_t size) {
  if (sensor == nullptr || bytes == nullptr) return SPOOLFLOW_BAD_ARGUMENT;
  if (size < spoolflow_state_size(sensor)) return SPOOLFLOW_TOO_SMALL;
  RunningState state = sensor->running.state();
  spoolflow::numerics::clear_padding(state);
  exports::pack_state(sensor->owner(), &state, sizeof state, static_cast<char*>(bytes));
  return SPOOLFLOW_OK;
}

spoolflow_result spoolflow_set_state(spoolflow_sensor* sensor, const void* bytes, size_t size, char* message,
                                     size_t message_size) {
  if (sensor == nullptr || bytes == nullptr) {
    return refuse("sensor and bytes must not be NULL", message, message_size);
  }
  return guarded(message, message_size, [&] {
    std::array<char, sizeof(RunningState)> plain;
    exports::unpack_state(sensor->owner(), static_cast<const char*>(bytes), size, plain.data(), plain.size());
    if (!spoolflow::estimation::may_be_running_state(plain.data()))
      throw exports::StateError("the state's bytes are damaged: they hold what no state can");
    RunningState state;
    std::memcpy(&state, plain.data(), sizeof state);
    sensor->running.set_state(state);
  });
}
