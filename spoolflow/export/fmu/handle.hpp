#pragma once
/// An instance behind the FMI functions of either version: exceptions become a status and a message to the importer's
/// log.
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "spoolflow/export/fmu/instance.hpp"
#include "spoolflow/export/state_bytes.hpp"

namespace spoolflow::exports::fmu {

/// Statuses, which both versions number alike.
enum StatusNumber { status_ok = 0, status_discard = 2, status_error = 3, status_fatal = 4 };

template <class Status>
class Handle {
 public:
  using Log = std::function<void(Status, const char* category, const std::string& message)>;
  explicit Handle(Log log) : log_(std::move(log)) {}

  /// Calls `work` and turns what it throws into a status.
  template <class Work>
  Status guarded(const Work& work) const noexcept {
    try {
      work();
      return static_cast<Status>(status_ok);
    } catch (const StepRefused& error) {
      return logged(status_discard, "logStatusDiscard", error.what());
    } catch (const std::exception& error) {
      return logged(status_error, "logStatusError", error.what());
    } catch (...) {
      return logged(status_fatal, "logStatusFatal", "a failure without a name");
    }
  }

  std::unique_ptr<Instance> instance;

 private:
  Status logged(StatusNumber status, const char* category, const char* message) const {
    log_(static_cast<Status>(status), category, message);
    return static_cast<Status>(status);
  }

  Log log_;
};

/// `work` on the instance behind the handle; an error where there is none.
template <class Status, class Work>
Status on(void* handle, const Work& work) noexcept {
  if (handle == nullptr) return static_cast<Status>(status_error);
  auto& behind = *static_cast<Handle<Status>*>(handle);
  return behind.guarded([&] { work(*behind.instance); });
}

/// A function that this FMU does not offer.
template <class Status>
Status not_offered(void* handle, const char* function) noexcept {
  return on<Status>(handle, [&](Instance&) { throw CallError(std::string(function) + " is not offered by this FMU"); });
}

/// No variable has this type.
template <class Status>
Status no_values(void* handle, std::size_t count, const char* type) noexcept {
  return on<Status>(handle, [&](Instance&) {
    if (count > 0) throw CallError(std::string("this FMU has no variables of type ") + type);
  });
}

inline void require_scalars(std::size_t references, std::size_t values) {
  if (references != values) throw CallError("as many values as value references are needed: all variables are scalars");
}

template <class Status, class Value>
Status get(void* handle, std::span<const std::uint32_t> references, std::span<Value> values, Type type) noexcept {
  return on<Status>(handle, [&](Instance& instance) {
    require_scalars(references.size(), values.size());
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<Value>(instance.get(references[k], type));
  });
}

template <class Status, class Value>
Status set(void* handle, std::span<const std::uint32_t> references, std::span<const Value> values, Type type) noexcept {
  return on<Status>(handle, [&](Instance& instance) {
    require_scalars(references.size(), values.size());
    instance.set(references, type, [&](std::size_t k) {
      return type == Type::boolean ? static_cast<double>(values[k] != 0) : static_cast<double>(values[k]);
    });
  });
}

}  // namespace spoolflow::exports::fmu
