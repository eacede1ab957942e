/// FMI 2.0: the functions that a co-simulation FMU works by.
#include <algorithm>

#include "spoolflow/export/fmu/exported.hpp"
#include "spoolflow/export/fmu/fmi2.hpp"
#include "spoolflow/export/fmu/handle.hpp"
#include "spoolflow/export/fmu/resource_place.hpp"

namespace fmu = spoolflow::exports::fmu;
using Fmi2Handle = fmu::Handle<fmi2Status>;
using fmu::Instance;
using fmu::StateBytes;

namespace {

Fmi2Handle::Log log_to(const fmi2CallbackFunctions& callbacks, const std::string& instance) {
  return [=](fmi2Status status, const char* category, const std::string& message) {
    if (callbacks.logger == nullptr) return;
    std::string text;  // the logger takes it for a printf format
    for (const char letter : message) text.append(letter == '%' ? 2 : 1, letter);
    callbacks.logger(callbacks.componentEnvironment, instance.c_str(), status, category, text.c_str());
  };
}

}  // namespace

SPOOLFLOW_FMI const char* fmi2GetTypesPlatform() {
  return "default";
}

SPOOLFLOW_FMI const char* fmi2GetVersion() {
  return "2.0";
}

SPOOLFLOW_FMI fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean, std::size_t, const fmi2String[]) {
  return fmu::on<fmi2Status>(component,
                             [](Instance&) {});  // warnings and errors are always logged, and nothing else is
}

SPOOLFLOW_FMI fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                            const fmi2CallbackFunctions* callbacks, fmi2Boolean, fmi2Boolean) {
  if (callbacks == nullptr) return nullptr;
  auto out = std::make_unique<Fmi2Handle>(log_to(*callbacks, name == nullptr ? "" : name));
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
  delete static_cast<Fmi2Handle*>(component);
}

SPOOLFLOW_FMI fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean, fmi2Real, fmi2Real start_time,
                                             fmi2Boolean stop_defined, fmi2Real stop_time) {
  return fmu::on<fmi2Status>(component,
                             [&](Instance& instance) { instance.set_up(start_time, stop_defined != 0, stop_time); });
}

SPOOLFLOW_FMI fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  return fmu::on<fmi2Status>(component, [](Instance& instance) { instance.enter_initialization(); });
}

SPOOLFLOW_FMI fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return fmu::on<fmi2Status>(component, [](Instance& instance) { instance.exit_initialization(); });
}

SPOOLFLOW_FMI fmi2Status fmi2Terminate(fmi2Component component) {
  return fmu::on<fmi2Status>(component, [](Instance& instance) { instance.terminate(); });
}

SPOOLFLOW_FMI fmi2Status fmi2Reset(fmi2Component component) {
  return fmu::on<fmi2Status>(component, [](Instance& instance) { instance.reset(); });
}

#define SPOOLFLOW_FMI2_VALUES(NAME, TYPE)                                                                      \
  SPOOLFLOW_FMI fmi2Status fmi2Get##NAME(fmi2Component component, const fmi2ValueReference references[],       \
                                         std::size_t count, fmi2##NAME values[]) {                             \
    return fmu::get<fmi2Status, fmi2##NAME>(component, {references, count}, {values, count}, fmu::Type::TYPE); \
  }                                                                                                            \
  SPOOLFLOW_FMI fmi2Status fmi2Set##NAME(fmi2Component component, const fmi2ValueReference references[],       \
                                         std::size_t count, const fmi2##NAME values[]) {                       \
    return fmu::set<fmi2Status, fmi2##NAME>(component, {references, count}, {values, count}, fmu::Type::TYPE); \
  }
SPOOLFLOW_FMI2_VALUES(Real, real)
SPOOLFLOW_FMI2_VALUES(Integer, integer)
SPOOLFLOW_FMI2_VALUES(Boolean, boolean)

SPOOLFLOW_FMI fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                                       fmi2String[]) {
  return fmu::no_values<fmi2Status>(component, count, "String");
}

SPOOLFLOW_FMI fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                                       const fmi2String[]) {
  return fmu::no_values<fmi2Status>(component, count, "String");
}

SPOOLFLOW_FMI fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return fmu::on<fmi2Status>(component, [&](Instance& instance) { fmu::keep_state(*state, instance.state()); });
}

SPOOLFLOW_FMI fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return fmu::on<fmi2Status>(component, [&](Instance& instance) { instance.set_state(fmu::bytes_of(state)); });
}

SPOOLFLOW_FMI fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return fmu::on<fmi2Status>(component, [&](Instance&) { fmu::free_state(state); });
}

SPOOLFLOW_FMI fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, std::size_t* size) {
  return fmu::on<fmi2Status>(component, [&](Instance&) { *size = fmu::bytes_of(state).size(); });
}

SPOOLFLOW_FMI fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[],
                                               std::size_t size) {
  return fmu::on<fmi2Status>(component, [&](Instance&) { fmu::copy_state(state, bytes, size); });
}

SPOOLFLOW_FMI fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[], std::size_t size,
                                                 fmi2FMUstate* state) {
  return fmu::on<fmi2Status>(component, [&](Instance& instance) {
    StateBytes read(bytes, bytes + size);
    instance.check_state(read);
    fmu::keep_state(*state, std::move(read));
  });
}

SPOOLFLOW_FMI fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean) {
  return fmu::on<fmi2Status>(component, [&](Instance& instance) { instance.do_step(time, step); });
}

SPOOLFLOW_FMI fmi2Status fmi2GetStatus(fmi2Component, const fmi2StatusKind, fmi2Status*) {
  return fmi2Discard;  // no step is ever pending
}

SPOOLFLOW_FMI fmi2Status fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Real* value) {
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  return fmu::on<fmi2Status>(component, [&](Instance& instance) { *value = instance.time_s(); });
}

SPOOLFLOW_FMI fmi2Status fmi2GetIntegerStatus(fmi2Component, const fmi2StatusKind, fmi2Integer*) {
  return fmi2Discard;
}

SPOOLFLOW_FMI fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Boolean* value) {
  if (kind != fmi2Terminated) return fmi2Discard;
  return fmu::on<fmi2Status>(component, [&](Instance&) { *value = 0; });  // this FMU never asks for an end
}

SPOOLFLOW_FMI fmi2Status fmi2GetStringStatus(fmi2Component, const fmi2StatusKind, fmi2String*) {
  return fmi2Discard;
}
