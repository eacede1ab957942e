#pragma once
/// One FMU instance, whichever FMI version drives it: values, modes, the grid of samples, and states.
///
/// Samples lie at start + n step, counted by an integer. A communication step from t to t + h takes every sample in
/// [t, t + h) with the inputs as they were set at t; an instant that two steps share belongs to the later one. So the
/// result depends on the inputs at the sample instants alone, not on how time is cut into communication steps.
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "spoolflow/export/fmu/component.hpp"

namespace spoolflow::exports::fmu {

/// A communication step that is refused, but the importer may go on: the instance is as before.
struct StepRefused : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

enum class Mode : std::int32_t { instantiated, initialization, step, terminated };

/// A state in memory: what serialising writes.
using StateBytes = std::vector<char>;

/// What a state's handle points to. It begins with a null pointer because fmusim 0.0.39 asks to free a handle where the
/// standard wants its address: what it then finds there is no state, and freed is nothing.
struct KeptState {
  const void* nothing = nullptr;
  StateBytes bytes{};
};

/// Throws CallError for a null handle.
[[nodiscard]] inline const StateBytes& bytes_of(const void* state) {
  if (state == nullptr) throw CallError("there is no state; get or deserialize one first");
  return static_cast<const KeptState*>(state)->bytes;
}

/// Into the state that `handle` points to; where it is null, into a new one.
inline void keep_state(void*& handle, StateBytes bytes) {
  if (handle == nullptr) handle = new KeptState;
  static_cast<KeptState*>(handle)->bytes = std::move(bytes);
}
inline void free_state(void** handle) {
  if (handle == nullptr) return;
  delete static_cast<KeptState*>(*handle);
  *handle = nullptr;
}
/// Throws CallError for a null handle, or a buffer of fewer bytes than the state has.
inline void copy_state(const void* state, void* buffer, std::size_t size) {
  const StateBytes& from = bytes_of(state);
  if (size < from.size()) throw CallError("the buffer is smaller than the serialized state");
  std::memcpy(buffer, from.data(), from.size());
}

class Instance {
 public:
  explicit Instance(std::unique_ptr<Component> component);

  void set_up(double start_time_s, bool stop_defined, double stop_time_s);
  void enter_initialization();
  void exit_initialization();
  void terminate();
  /// As just instantiated.
  void reset();
  /// Throws StepRefused for a step of more than ten million samples.
  void do_step(double time_s, double step_s);

  [[nodiscard]] double get(std::uint32_t reference, Type type);
  /// All of them or, where one cannot be set, none: throws CallError. `value(k)` is that for `references[k]`.
  template <class Value>
  void set(std::span<const std::uint32_t> references, Type type, const Value& value) {
    for (std::size_t k = 0; k < references.size(); ++k) check(references[k], type, value(k));
    for (std::size_t k = 0; k < references.size(); ++k) put(references[k], value(k));
  }

  [[nodiscard]] StateBytes state();
  /// Throws StateError; the instance is untouched then.
  void set_state(const StateBytes& state);
  /// Throws StateError for bytes that are no state of this FMU.
  void check_state(const StateBytes& state);

  [[nodiscard]] double time_s() const { return clock_.reached_s; }

 private:
  /// Everything beside values and component that a state keeps.
  struct Clock {
    double start_s = 0;
    double stop_s = 0;
    double reached_s = 0;   ///< end of the last communication step
    double step_s = 0;      ///< between samples
    std::int64_t next = 0;  ///< number of the next sample
    Mode mode = Mode::instantiated;
    std::uint32_t stop_defined = 0;
    std::uint32_t tuned = 0;  ///< a tunable parameter has changed since the last sample
    std::uint32_t stale = 0;  ///< outputs wait for a preview of the start
  };

  [[nodiscard]] const Variable& variable(std::uint32_t reference, Type type) const;
  void require(Mode mode, const char* call) const;
  void check(std::uint32_t reference, Type type, double value) const;
  void put(std::uint32_t reference, double value);
  void preview();
  [[nodiscard]] std::size_t state_size();
  /// Clock, values and memory one behind the other. Throws StateError for what no state can hold.
  [[nodiscard]] StateBytes unpacked(const StateBytes& state);

  std::unique_ptr<Component> component_;
  std::vector<double> values_;
  Clock clock_;
};

}  // namespace spoolflow::exports::fmu
