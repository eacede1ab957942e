/// FMI 3.0: instances of co-simulation, and the functions that they work by, but for their values.
#include <cstring>

#include "spoolflow/export/fmu/exported.hpp"
#include "spoolflow/export/fmu/fmi3.hpp"
#include "spoolflow/export/fmu/handle.hpp"

namespace fmu = spoolflow::exports::fmu;
using Fmi3Handle = fmu::Handle<fmi3Status>;
using fmu::Instance;
using fmu::StateBytes;
using std::size_t;

namespace {

Fmi3Handle::Log log_to(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger) {
  return [=](fmi3Status status, const char* category, const std::string& message) {
    if (logger != nullptr) logger(environment, status, category, message.c_str());
  };
}

/// An instance of a kind that this FMU is not.
fmi3Instance refused(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger) {
  log_to(environment, logger)(fmi3Error, "logStatusError", "this FMU offers co-simulation only");
  return nullptr;
}

}  // namespace

SPOOLFLOW_FMI const char* fmi3GetVersion() {
  return "3.0";
}

SPOOLFLOW_FMI fmi3Status fmi3SetDebugLogging(fmi3Instance handle, fmi3Boolean, size_t, const fmi3String[]) {
  return fmu::on<fmi3Status>(handle, [](Instance&) {});  // warnings and errors are always logged, and nothing else is
}

SPOOLFLOW_FMI fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                                       fmi3Boolean, fmi3Boolean, fmi3Boolean event_mode_used,
                                                       fmi3Boolean, const fmi3ValueReference[],
                                                       size_t intermediate_variables,
                                                       fmi3InstanceEnvironment environment,
                                                       fmi3LogMessageCallback logger, fmi3IntermediateUpdateCallback) {
  auto out = std::make_unique<Fmi3Handle>(log_to(environment, logger));
  const fmi3Status status = out->guarded([&] {
    if (name == nullptr || *name == '\0') throw fmu::CallError("an instance needs a name");
    if (token == nullptr) throw fmu::CallError("instantiationToken is missing");
    if (resources == nullptr || *resources == '\0') throw fmu::CallError("resourcePath is missing");
    if (event_mode_used) throw fmu::CallError("this FMU has no event mode");
    if (intermediate_variables > 0) throw fmu::CallError("this FMU has no intermediate update");
    std::string folder = resources;
    while (folder.size() > 1 && (folder.back() == '/' || folder.back() == '\\')) folder.pop_back();
    out->instance = std::make_unique<Instance>(fmu::load_component(folder, token));
  });
  return status == fmi3OK ? out.release() : nullptr;
}

SPOOLFLOW_FMI fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                                        fmi3InstanceEnvironment environment,
                                                        fmi3LogMessageCallback logger) {
  return refused(environment, logger);
}

SPOOLFLOW_FMI fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                                             fmi3Boolean, fmi3InstanceEnvironment environment,
                                                             fmi3LogMessageCallback logger, fmi3ClockUpdateCallback,
                                                             fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback) {
  return refused(environment, logger);
}

SPOOLFLOW_FMI void fmi3FreeInstance(fmi3Instance handle) {
  delete static_cast<Fmi3Handle*>(handle);
}

SPOOLFLOW_FMI fmi3Status fmi3EnterInitializationMode(fmi3Instance handle, fmi3Boolean, fmi3Float64,
                                                     fmi3Float64 start_time, fmi3Boolean stop_defined,
                                                     fmi3Float64 stop_time) {
  return fmu::on<fmi3Status>(handle, [&](Instance& instance) {
    instance.set_up(start_time, stop_defined, stop_time);
    instance.enter_initialization();
  });
}

SPOOLFLOW_FMI fmi3Status fmi3ExitInitializationMode(fmi3Instance handle) {
  return fmu::on<fmi3Status>(handle, [](Instance& instance) { instance.exit_initialization(); });
}

SPOOLFLOW_FMI fmi3Status fmi3Terminate(fmi3Instance handle) {
  return fmu::on<fmi3Status>(handle, [](Instance& instance) { instance.terminate(); });
}

SPOOLFLOW_FMI fmi3Status fmi3Reset(fmi3Instance handle) {
  return fmu::on<fmi3Status>(handle, [](Instance& instance) { instance.reset(); });
}

SPOOLFLOW_FMI fmi3Status fmi3GetFMUState(fmi3Instance handle, fmi3FMUState* state) {
  return fmu::on<fmi3Status>(handle, [&](Instance& instance) { fmu::keep_state(*state, instance.state()); });
}

SPOOLFLOW_FMI fmi3Status fmi3SetFMUState(fmi3Instance handle, fmi3FMUState state) {
  return fmu::on<fmi3Status>(handle, [&](Instance& instance) { instance.set_state(fmu::bytes_of(state)); });
}

SPOOLFLOW_FMI fmi3Status fmi3FreeFMUState(fmi3Instance handle, fmi3FMUState* state) {
  return fmu::on<fmi3Status>(handle, [&](Instance&) { fmu::free_state(state); });
}

SPOOLFLOW_FMI fmi3Status fmi3SerializedFMUStateSize(fmi3Instance handle, fmi3FMUState state, size_t* size) {
  return fmu::on<fmi3Status>(handle, [&](Instance&) { *size = fmu::bytes_of(state).size(); });
}

SPOOLFLOW_FMI fmi3Status fmi3SerializeFMUState(fmi3Instance handle, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  return fmu::on<fmi3Status>(handle, [&](Instance&) { fmu::copy_state(state, bytes, size); });
}

SPOOLFLOW_FMI fmi3Status fmi3DeserializeFMUState(fmi3Instance handle, const fmi3Byte bytes[], size_t size,
                                                 fmi3FMUState* state) {
  return fmu::on<fmi3Status>(handle, [&](Instance& instance) {
    StateBytes read(size);
    if (size > 0) std::memcpy(read.data(), bytes, size);
    instance.check_state(read);
    fmu::keep_state(*state, std::move(read));
  });
}

SPOOLFLOW_FMI fmi3Status fmi3DoStep(fmi3Instance handle, fmi3Float64 time, fmi3Float64 step, fmi3Boolean,
                                    fmi3Boolean* event_handling_needed, fmi3Boolean* terminate_simulation,
                                    fmi3Boolean* early_return, fmi3Float64* last_successful_time) {
  return fmu::on<fmi3Status>(handle, [&](Instance& instance) {
    if (event_handling_needed != nullptr) *event_handling_needed = false;
    if (terminate_simulation != nullptr) *terminate_simulation = false;
    if (early_return != nullptr) *early_return = false;
    if (last_successful_time != nullptr) *last_successful_time = instance.time_s();
    instance.do_step(time, step);
    if (last_successful_time != nullptr) *last_successful_time = instance.time_s();
  });
}
