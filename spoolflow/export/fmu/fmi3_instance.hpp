#pragma once
/// An instance behind the FMI 3.0 functions: exceptions become a status and a message to the importer's log.
#include <exception>
#include <memory>
#include <string>

#include "spoolflow/export/fmu/fmi3.hpp"
#include "spoolflow/export/fmu/instance.hpp"
#include "spoolflow/export/state_bytes.hpp"

namespace spoolflow::exports::fmu {

class Fmi3Instance {
 public:
  Fmi3Instance(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger)
      : environment_(environment), logger_(logger) {}

  void log(fmi3Status status, const char* category, const std::string& message) const {
    if (logger_ != nullptr) logger_(environment_, status, category, message.c_str());
  }

  /// Calls `work` and turns what it throws into a status.
  template <class Work>
  fmi3Status guarded(Work&& work) const noexcept {
    try {
      work();
      return fmi3OK;
    } catch (const StepRefused& error) {
      return log(fmi3Discard, "logStatusDiscard", error.what()), fmi3Discard;
    } catch (const std::exception& error) {
      return log(fmi3Error, "logStatusError", error.what()), fmi3Error;
    } catch (...) {
      return log(fmi3Fatal, "logStatusFatal", "a failure without a name"), fmi3Fatal;
    }
  }

  std::unique_ptr<Instance> instance;

 private:
  fmi3InstanceEnvironment environment_;
  fmi3LogMessageCallback logger_;
};

/// `work` on the instance behind the handle; fmi3Error where there is none.
template <class Work>
fmi3Status on_fmi3(fmi3Instance handle, Work&& work) noexcept {
  if (handle == nullptr) return fmi3Error;
  auto& behind = *static_cast<Fmi3Instance*>(handle);
  return behind.guarded([&] { work(*behind.instance); });
}

/// A function that this FMU does not offer.
inline fmi3Status not_offered_in_fmi3(fmi3Instance handle, const char* function) noexcept {
  return on_fmi3(handle, [&](Instance&) { throw CallError(std::string(function) + " is not offered by this FMU"); });
}

}  // namespace spoolflow::exports::fmu
