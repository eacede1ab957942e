#pragma once
/// What runs inside an FMU: a sampled system with a fixed step. Each FMU links one component and its load_component.
///
/// To add one: describe its variables in a file of its own (the exporter needs them, too), derive from Component,
/// define load_component, and name the files in CMakeLists.txt.
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "spoolflow/export/fmu/variable.hpp"

namespace spoolflow::exports::fmu {

/// A call that cannot be followed; the instance is as before.
struct CallError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

class Component {
 public:
  Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  virtual ~Component() = default;

  [[nodiscard]] virtual const std::vector<Variable>& variables() const = 0;
  /// Identifies model and kind: a state of one FMU is refused by another.
  [[nodiscard]] virtual std::uint64_t identity() const = 0;
  /// Seconds between samples [s], by the parameters among `values`.
  [[nodiscard]] virtual double sample_step_s(std::span<const double> values) const = 0;
  /// Parameters have been set: takes them over. Called before start and again when a tunable parameter has changed.
  /// Throws CallError where they do not fit together, and goes on with those before.
  virtual void tune(std::span<const double> values) = 0;
  /// The state before the first sample, and among `values` the outputs that the inputs mean there.
  virtual void start(std::span<double> values) = 0;
  /// Sample number `number`, 0 at the start time: reads inputs and writes outputs among `values`.
  virtual void sample(std::span<double> values, std::int64_t number) = 0;
  /// Everything that a state has to keep beside `values`; trivially copyable bytes.
  [[nodiscard]] virtual std::span<char> memory() = 0;
  /// Bytes of the memory that are no value become zero, so that equal states have equal bytes.
  virtual void clear_padding() = 0;
  /// Whether bytes that came from elsewhere can be this memory at all.
  [[nodiscard]] virtual bool may_be_memory(std::span<const char> bytes) const = 0;
};

/// Reads the FMU's resource. `token` is what the importer took from modelDescription.xml. Throws ResourceError.
[[nodiscard]] std::unique_ptr<Component> load_component(const std::string& resource_folder, const std::string& token);

}  // namespace spoolflow::exports::fmu
