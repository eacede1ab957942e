#pragma once
/// An instance behind the FMI 2.0 functions: exceptions become a status and a message to the importer's logger.
#include <exception>
#include <memory>
#include <string>

#include "spoolflow/export/fmu/fmi2.hpp"
#include "spoolflow/export/fmu/instance.hpp"
#include "spoolflow/export/state_bytes.hpp"

namespace spoolflow::exports::fmu {

class Fmi2Instance {
 public:
  Fmi2Instance(std::string name, const fmi2CallbackFunctions& callbacks)
      : name_(std::move(name)), callbacks_(callbacks) {}

  void log(fmi2Status status, const char* category, const std::string& message) const {
    if (callbacks_.logger == nullptr) return;
    std::string text;  // the logger takes it for a printf format
    for (const char letter : message) text.append(letter == '%' ? 2 : 1, letter);
    callbacks_.logger(callbacks_.componentEnvironment, name_.c_str(), status, category, text.c_str());
  }

  /// Calls `work` and turns what it throws into a status.
  template <class Work>
  fmi2Status guarded(Work&& work) const noexcept {
    try {
      work();
      return fmi2OK;
    } catch (const StepRefused& error) {
      return log(fmi2Discard, "logStatusDiscard", error.what()), fmi2Discard;
    } catch (const std::exception& error) {
      return log(fmi2Error, "logStatusError", error.what()), fmi2Error;
    } catch (...) {
      return log(fmi2Fatal, "logStatusFatal", "a failure without a name"), fmi2Fatal;
    }
  }

  std::unique_ptr<Instance> instance;

 private:
  std::string name_;
  fmi2CallbackFunctions callbacks_;
};

/// `work` on the instance behind a component; fmi2Error where there is none.
template <class Work>
fmi2Status on_fmi2(fmi2Component component, Work&& work) noexcept {
  if (component == nullptr) return fmi2Error;
  auto& behind = *static_cast<Fmi2Instance*>(component);
  return behind.guarded([&] { work(*behind.instance); });
}

/// A function that this FMU does not offer.
inline fmi2Status not_offered_in_fmi2(fmi2Component component, const char* function) noexcept {
  return on_fmi2(component, [&](Instance&) { throw CallError(std::string(function) + " is not offered by this FMU"); });
}

}  // namespace spoolflow::exports::fmu
