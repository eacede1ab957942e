#include "tests/fmu/fmu_instance.hpp"

#include <cstdarg>
#include <cstdio>
#include <dlfcn.h>
#include <stdexcept>

#include "spoolflow/export/fmu/fmi2.hpp"
#include "spoolflow/export/fmu/fmi3.hpp"

namespace spoolflow::exports {
namespace {

void log_fmi2(fmi2ComponentEnvironment environment, fmi2String, fmi2Status, fmi2String, fmi2String message, ...) {
  char text[2048];
  std::va_list arguments;
  va_start(arguments, message);
  std::vsnprintf(text, sizeof text, message, arguments);
  va_end(arguments);
  static_cast<FmuLog*>(environment)->messages.emplace_back(text);
}

void log_fmi3(fmi3InstanceEnvironment environment, fmi3Status, fmi3String, fmi3String message) {
  static_cast<FmuLog*>(environment)->messages.emplace_back(message);
}

template <class Function>
Function* found(const FmuLibrary& library, const char* name) {
  void* symbol = library.symbol(name);
  if (symbol == nullptr) throw std::runtime_error(std::string("the FMU does not export ") + name);
  return reinterpret_cast<Function*>(symbol);
}

std::string uri(const std::filesystem::path& path) {
  std::string out = "file://";
  for (const char letter : path.string()) {
    if (letter == ' ') {
      out += "%20";
    } else if (letter == '%') {
      out += "%25";
    } else {
      out += letter;
    }
  }
  return out;
}

/// Calls by their name in either version: PREFIX followed by the name.
class Instance : public FmuInstance {
 public:
  Instance(const FmuLibrary& library, void* handle, std::string prefix)
      : library_(library), handle_(handle), prefix_(std::move(prefix)) {}
  ~Instance() override { found<void(void*)>(library_, named("FreeInstance").c_str())(handle_); }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  FmuStatus exit_initialization() override { return call("ExitInitializationMode"); }
  FmuStatus terminate() override { return call("Terminate"); }
  FmuStatus reset() override { return call("Reset"); }

 protected:
  [[nodiscard]] std::string named(const char* function) const { return prefix_ + function; }
  template <class... Arguments>
  FmuStatus call(const char* function, Arguments... arguments) {
    return static_cast<FmuStatus>(
        found<int(void*, Arguments...)>(library_, named(function).c_str())(handle_, arguments...));
  }
  std::vector<char> state_by(const char* get, const char* free) {
    void* state = nullptr;
    std::size_t size = 0;
    if (call(get, &state) != FmuStatus::ok) return {};
    // What importers get wrong: no state at all, and (fmusim 0.0.39) the handle where its address belongs.
    void* const none = nullptr;
    const std::string size_of = "SerializedFMU" + std::string(1, get[6]) + "tateSize";
    if (call(size_of, none, &size) != FmuStatus::error || call(free, state) != FmuStatus::ok) return {};
    std::vector<char> bytes;
    if (call(size_of, state, &size) == FmuStatus::ok) {
      bytes.resize(size);
      if (call("SerializeFMU" + std::string(1, get[6]) + "tate", state, bytes.data(), size) != FmuStatus::ok)
        bytes.clear();
    }
    call(free, &state);
    return bytes;
  }
  template <class... Arguments>
  FmuStatus call(const std::string& function, Arguments... arguments) {
    return call(function.c_str(), arguments...);
  }
  FmuStatus set_state_by(const char* read, const char* set, const char* free, const std::vector<char>& bytes) {
    void* state = nullptr;
    const FmuStatus status = call(read, static_cast<const void*>(bytes.data()), bytes.size(), &state);
    if (status != FmuStatus::ok) return status;
    const FmuStatus done = call(set, state);
    call(free, &state);
    return done;
  }

 private:
  const FmuLibrary& library_;
  void* handle_;
  std::string prefix_;
};

class Fmi2 : public Instance {
 public:
  Fmi2(const FmuLibrary& library, void* handle, std::unique_ptr<fmi2CallbackFunctions> callbacks)
      : Instance(library, handle, "fmi2"), callbacks_(std::move(callbacks)) {}

  FmuStatus enter_initialization(double start_s) override {
    const FmuStatus status = call("SetupExperiment", 0, 0.0, start_s, 0, 0.0);
    return status == FmuStatus::ok ? call("EnterInitializationMode") : status;
  }
  FmuStatus step(double time_s, double step_s) override { return call("DoStep", time_s, step_s, 1); }
  FmuStatus set_all(const std::vector<unsigned>& references, const std::vector<double>& values) override {
    return call("SetReal", references.data(), references.size(), values.data());
  }
  FmuStatus set_flag(unsigned reference, bool value) override {
    const int flag = value ? 1 : 0;
    return call("SetBoolean", &reference, std::size_t{1}, &flag);
  }
  FmuStatus get(unsigned reference, double& value) override {
    return call("GetReal", &reference, std::size_t{1}, &value);
  }
  FmuStatus get_integer(unsigned reference, int& value) override {
    return call("GetInteger", &reference, std::size_t{1}, &value);
  }
  std::vector<char> state() override { return state_by("GetFMUstate", "FreeFMUstate"); }
  FmuStatus set_state(const std::vector<char>& bytes) override {
    return set_state_by("DeSerializeFMUstate", "SetFMUstate", "FreeFMUstate", bytes);
  }

 private:
  std::unique_ptr<fmi2CallbackFunctions> callbacks_;  // the standard wants them to live as long as the instance
};

class Fmi3 : public Instance {
 public:
  Fmi3(const FmuLibrary& library, void* handle) : Instance(library, handle, "fmi3") {}

  FmuStatus enter_initialization(double start_s) override {
    return call("EnterInitializationMode", false, 0.0, start_s, false, 0.0);
  }
  FmuStatus step(double time_s, double step_s) override {
    bool event = true, terminate = true, early = true;
    double reached_s = 0;
    const FmuStatus status = call("DoStep", time_s, step_s, true, &event, &terminate, &early, &reached_s);
    if (event || terminate || early) throw std::runtime_error("a step asked for more than was offered");
    if (status == FmuStatus::ok && reached_s != time_s + step_s) throw std::runtime_error("a step ended elsewhere");
    return status;
  }
  FmuStatus set_all(const std::vector<unsigned>& references, const std::vector<double>& values) override {
    return call("SetFloat64", references.data(), references.size(), values.data(), values.size());
  }
  FmuStatus set_flag(unsigned reference, bool value) override {
    return call("SetBoolean", &reference, std::size_t{1}, &value, std::size_t{1});
  }
  FmuStatus get(unsigned reference, double& value) override {
    return call("GetFloat64", &reference, std::size_t{1}, &value, std::size_t{1});
  }
  FmuStatus get_integer(unsigned reference, int& value) override {
    return call("GetInt32", &reference, std::size_t{1}, &value, std::size_t{1});
  }
  std::vector<char> state() override { return state_by("GetFMUState", "FreeFMUState"); }
  FmuStatus set_state(const std::vector<char>& bytes) override {
    return set_state_by("DeserializeFMUState", "SetFMUState", "FreeFMUState", bytes);
  }
};

}  // namespace

void FmuInstance::put(const std::string& name, double value) {
  if (set(fmu->reference(name), value) != FmuStatus::ok) throw std::runtime_error("cannot set " + name);
}

double FmuInstance::value(const std::string& name) {
  double value = 0;
  if (get(fmu->reference(name), value) != FmuStatus::ok) throw std::runtime_error("cannot get " + name);
  return value;
}

int FmuInstance::status_bits() {
  int bits = 0;
  if (get_integer(fmu->reference("status"), bits) != FmuStatus::ok) throw std::runtime_error("cannot get status");
  return bits;
}

FmuLibrary::FmuLibrary(const UnpackedFmu& fmu, const std::filesystem::path& library)
    : fmu_(fmu), handle_(::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) throw std::runtime_error(::dlerror());
}

FmuLibrary::~FmuLibrary() {
  ::dlclose(handle_);
}

void* FmuLibrary::symbol(const std::string& name) const {
  return ::dlsym(handle_, name.c_str());
}

std::unique_ptr<FmuInstance> FmuLibrary::instantiate(FmuLog& log, const std::string& token) const {
  const std::filesystem::path resources = fmu_.folder() / "resources";
  std::unique_ptr<FmuInstance> out;
  if (fmu_.version() == FmiVersion::fmi2) {
    auto callbacks =
        std::make_unique<fmi2CallbackFunctions>(fmi2CallbackFunctions{&log_fmi2, nullptr, nullptr, nullptr, &log});
    void* handle = found<void*(const char*, int, const char*, const char*, const fmi2CallbackFunctions*, int, int)>(
        *this, "fmi2Instantiate")("sensor", fmi2CoSimulation, token.c_str(), uri(resources).c_str(), callbacks.get(), 0,
                                  0);
    if (handle == nullptr) return nullptr;
    out = std::make_unique<Fmi2>(*this, handle, std::move(callbacks));
  } else {
    void* handle = found<void*(const char*, const char*, const char*, bool, bool, bool, bool, const unsigned*,
                               std::size_t, void*, fmi3LogMessageCallback, fmi3IntermediateUpdateCallback)>(
        *this, "fmi3InstantiateCoSimulation")("sensor", token.c_str(), (resources.string() + "/").c_str(), false, false,
                                              false, false, nullptr, 0, &log, &log_fmi3, nullptr);
    if (handle == nullptr) return nullptr;
    out = std::make_unique<Fmi3>(*this, handle);
  }
  out->fmu = &fmu_;
  return out;
}

}  // namespace spoolflow::exports
