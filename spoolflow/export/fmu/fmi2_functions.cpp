/// FMI 2.0: the functions that a co-simulation FMU works by.
#include <algorithm>

#include "spoolflow/export/fmu/exported.hpp"
#include "spoolflow/export/fmu/fmi2_instance.hpp"
#include "spoolflow/export/fmu/resource_place.hpp"

namespace fmu = spoolflow::exports::fmu;
using fmu::Fmi2Instance;
using fmu::Instance;
using fmu::on_fmi2;
using fmu::StateBytes;

SPOOLFLOW_FMI const char* fmi2GetTypesPlatform() {
  return "default";
}

SPOOLFLOW_FMI const char* fmi2GetVersion() {
  return "2.0";
}

SPOOLFLOW_FMI fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean, std::size_t, const fmi2String[]) {
  return on_fmi2(component, [](Instance&) {});  // warnings and errors are always logged, and nothing else is
}

SPOOLFLOW_FMI fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                            const fmi2CallbackFunctions* callbacks, fmi2Boolean, fmi2Boolean) {
  if (callbacks == nullptr) return nullptr;
  auto out = std::make_unique<Fmi2Instance>(name == nullptr ? "" : name, *callbacks);
  const fmi2Status status = out->guarded([&] {
    if (name == nullptr || *name == '\0') throw fmu::CallError("an instance needs a name");
    if (type != fmi2CoSimulation) throw fmu::CallError("this FMU offers co-simulation only");
    if (guid == nullptr) throw fmu::CallError("fmuGUID is missing");
    const std::string folder = fmu::folder_of_uri(resources == nullptr ? "" : resources);
    if (folder.empty()) {
      throw fmu::CallError(std::string("fmuResourceLocation '") + (resources == nullptr ? "" : resources) +
                           "' is no file URI");
    }
    out->instance = std::make_unique<Instance>(fmu::load_component(folder, guid));
  });
  return status == fmi2OK ? out.release() : nullptr;
}

SPOOLFLOW_FMI void fmi2FreeInstance(fmi2Component component) {
  delete static_cast<Fmi2Instance*>(component);
}

SPOOLFLOW_FMI fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean, fmi2Real, fmi2Real start_time,
                                             fmi2Boolean stop_defined, fmi2Real stop_time) {
  return on_fmi2(component, [&](Instance& instance) { instance.set_up(start_time, stop_defined != 0, stop_time); });
}

SPOOLFLOW_FMI fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  return on_fmi2(component, [](Instance& instance) { instance.enter_initialization(); });
}

SPOOLFLOW_FMI fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return on_fmi2(component, [](Instance& instance) { instance.exit_initialization(); });
}

SPOOLFLOW_FMI fmi2Status fmi2Terminate(fmi2Component component) {
  return on_fmi2(component, [](Instance& instance) { instance.terminate(); });
}

SPOOLFLOW_FMI fmi2Status fmi2Reset(fmi2Component component) {
  return on_fmi2(component, [](Instance& instance) { instance.reset(); });
}

namespace {

template <class Value>
fmi2Status get(fmi2Component component, const fmi2ValueReference* references, std::size_t count, Value* values,
               fmu::Type type) {
  return on_fmi2(component, [&](Instance& instance) {
    for (std::size_t k = 0; k < count; ++k) values[k] = static_cast<Value>(instance.get(references[k], type));
  });
}

template <class Value>
fmi2Status set(fmi2Component component, const fmi2ValueReference* references, std::size_t count, const Value* values,
               fmu::Type type) {
  return on_fmi2(component, [&](Instance& instance) {
    instance.set({references, count}, type, [&](std::size_t k) { return static_cast<double>(values[k]); });
  });
}

fmi2Status no_strings(fmi2Component component, std::size_t count) {
  return on_fmi2(component, [&](Instance&) {
    if (count > 0) throw fmu::CallError("this FMU has no variables of type String");
  });
}

}  // namespace

SPOOLFLOW_FMI fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                                     fmi2Real values[]) {
  return get(component, references, count, values, fmu::Type::real);
}

SPOOLFLOW_FMI fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference references[],
                                        std::size_t count, fmi2Integer values[]) {
  return get(component, references, count, values, fmu::Type::integer);
}

SPOOLFLOW_FMI fmi2Status fmi2GetBoolean(fmi2Component component, const fmi2ValueReference references[],
                                        std::size_t count, fmi2Boolean values[]) {
  return get(component, references, count, values, fmu::Type::boolean);
}

SPOOLFLOW_FMI fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                                       fmi2String[]) {
  return no_strings(component, count);
}

SPOOLFLOW_FMI fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                                     const fmi2Real values[]) {
  return set(component, references, count, values, fmu::Type::real);
}

SPOOLFLOW_FMI fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference references[],
                                        std::size_t count, const fmi2Integer values[]) {
  return set(component, references, count, values, fmu::Type::integer);
}

SPOOLFLOW_FMI fmi2Status fmi2SetBoolean(fmi2Component component, const fmi2ValueReference references[],
                                        std::size_t count, const fmi2Boolean values[]) {
  return on_fmi2(component, [&](Instance& instance) {
    instance.set({references, count}, fmu::Type::boolean, [&](std::size_t k) { return values[k] != 0 ? 1.0 : 0.0; });
  });
}

SPOOLFLOW_FMI fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                                       const fmi2String[]) {
  return no_strings(component, count);
}

SPOOLFLOW_FMI fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return on_fmi2(component, [&](Instance& instance) { fmu::keep_state(*state, instance.state()); });
}

SPOOLFLOW_FMI fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return on_fmi2(component, [&](Instance& instance) { instance.set_state(fmu::bytes_of(state)); });
}

SPOOLFLOW_FMI fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return on_fmi2(component, [&](Instance&) { fmu::free_state(state); });
}

SPOOLFLOW_FMI fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, std::size_t* size) {
  return on_fmi2(component, [&](Instance&) { *size = fmu::bytes_of(state).size(); });
}

SPOOLFLOW_FMI fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[],
                                               std::size_t size) {
  return on_fmi2(component, [&](Instance&) { fmu::copy_state(state, bytes, size); });
}

SPOOLFLOW_FMI fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[], std::size_t size,
                                                 fmi2FMUstate* state) {
  return on_fmi2(component, [&](Instance& instance) {
    StateBytes read(bytes, bytes + size);
    instance.check_state(read);
    fmu::keep_state(*state, std::move(read));
  });
}

SPOOLFLOW_FMI fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean) {
  return on_fmi2(component, [&](Instance& instance) { instance.do_step(time, step); });
}

SPOOLFLOW_FMI fmi2Status fmi2GetStatus(fmi2Component, const fmi2StatusKind, fmi2Status*) {
  return fmi2Discard;  // no step is ever pending
}

SPOOLFLOW_FMI fmi2Status fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Real* value) {
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  return on_fmi2(component, [&](Instance& instance) { *value = instance.time_s(); });
}

SPOOLFLOW_FMI fmi2Status fmi2GetIntegerStatus(fmi2Component, const fmi2StatusKind, fmi2Integer*) {
  return fmi2Discard;
}

SPOOLFLOW_FMI fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Boolean* value) {
  if (kind != fmi2Terminated) return fmi2Discard;
  return on_fmi2(component, [&](Instance&) { *value = 0; });  // this FMU never asks for an end
}

SPOOLFLOW_FMI fmi2Status fmi2GetStringStatus(fmi2Component, const fmi2StatusKind, fmi2String*) {
  return fmi2Discard;
}
