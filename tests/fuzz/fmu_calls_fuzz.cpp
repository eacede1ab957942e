/// The FMU of the sensor: the functions of FMI 2.0 (first byte even) or 3.0 in any order, with any numbers, and states
/// whose bytes were changed, with a checksum that holds. Whatever comes, what was computed is finite and inside its
/// band.
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "spoolflow/export/fmu/fmi2.hpp"
#include "spoolflow/export/fmu/fmi3.hpp"
#include "spoolflow/export/fmu/sensor_numbers.hpp"
#include "spoolflow/export/fmu/sensor_variables.hpp"
#include "spoolflow/model/model.hpp"
#include "tests/fuzz/forged_state.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/odd_number.hpp"
#include "tests/fuzz/small_models.hpp"

extern "C" {
fmi2Component fmi2Instantiate(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions*, fmi2Boolean,
                              fmi2Boolean);
void fmi2FreeInstance(fmi2Component);
fmi2Status fmi2SetupExperiment(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real);
fmi2Status fmi2EnterInitializationMode(fmi2Component);
fmi2Status fmi2ExitInitializationMode(fmi2Component);
fmi2Status fmi2Terminate(fmi2Component);
fmi2Status fmi2Reset(fmi2Component);
fmi2Status fmi2GetReal(fmi2Component, const fmi2ValueReference[], std::size_t, fmi2Real[]);
fmi2Status fmi2SetReal(fmi2Component, const fmi2ValueReference[], std::size_t, const fmi2Real[]);
fmi2Status fmi2GetInteger(fmi2Component, const fmi2ValueReference[], std::size_t, fmi2Integer[]);
fmi2Status fmi2SetBoolean(fmi2Component, const fmi2ValueReference[], std::size_t, const fmi2Boolean[]);
fmi2Status fmi2GetFMUstate(fmi2Component, fmi2FMUstate*);
fmi2Status fmi2SetFMUstate(fmi2Component, fmi2FMUstate);
fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate*);
fmi2Status fmi2SerializedFMUstateSize(fmi2Component, fmi2FMUstate, std::size_t*);
fmi2Status fmi2SerializeFMUstate(fmi2Component, fmi2FMUstate, fmi2Byte[], std::size_t);
fmi2Status fmi2DeSerializeFMUstate(fmi2Component, const fmi2Byte[], std::size_t, fmi2FMUstate*);
fmi2Status fmi2DoStep(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);

fmi3Instance fmi3InstantiateCoSimulation(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean, fmi3Boolean,
                                         fmi3Boolean, const fmi3ValueReference[], std::size_t, fmi3InstanceEnvironment,
                                         fmi3LogMessageCallback, fmi3IntermediateUpdateCallback);
void fmi3FreeInstance(fmi3Instance);
fmi3Status fmi3EnterInitializationMode(fmi3Instance, fmi3Boolean, fmi3Float64, fmi3Float64, fmi3Boolean, fmi3Float64);
fmi3Status fmi3ExitInitializationMode(fmi3Instance);
fmi3Status fmi3Terminate(fmi3Instance);
fmi3Status fmi3Reset(fmi3Instance);
fmi3Status fmi3GetFloat64(fmi3Instance, const fmi3ValueReference[], std::size_t, fmi3Float64[], std::size_t);
fmi3Status fmi3SetFloat64(fmi3Instance, const fmi3ValueReference[], std::size_t, const fmi3Float64[], std::size_t);
fmi3Status fmi3GetInt32(fmi3Instance, const fmi3ValueReference[], std::size_t, fmi3Int32[], std::size_t);
fmi3Status fmi3SetBoolean(fmi3Instance, const fmi3ValueReference[], std::size_t, const fmi3Boolean[], std::size_t);
fmi3Status fmi3GetFMUState(fmi3Instance, fmi3FMUState*);
fmi3Status fmi3SetFMUState(fmi3Instance, fmi3FMUState);
fmi3Status fmi3FreeFMUState(fmi3Instance, fmi3FMUState*);
fmi3Status fmi3SerializedFMUStateSize(fmi3Instance, fmi3FMUState, std::size_t*);
fmi3Status fmi3SerializeFMUState(fmi3Instance, fmi3FMUState, fmi3Byte[], std::size_t);
fmi3Status fmi3DeserializeFMUState(fmi3Instance, const fmi3Byte[], std::size_t, fmi3FMUState*);
fmi3Status fmi3DoStep(fmi3Instance, fmi3Float64, fmi3Float64, fmi3Boolean, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                      fmi3Float64*);
}

namespace {

using namespace spoolflow;
using exports::fmu::BothDirections;

/// An FMU's unpacked resources; the token is their name.
std::string resource_folder(const std::string& token, const exports::fmu::Resource& resource) {
  static const fuzz::InputFile place("x");
  const std::filesystem::path folder = place.path().parent_path() / token;
  std::filesystem::create_directory(folder);
  std::ofstream(folder / exports::fmu::resource_name, std::ios::binary) << exports::fmu::resource_bytes(resource);
  return folder.string();
}

struct Fmus {
  std::vector<std::string> tokens, folders;

  Fmus() {
    const model::Model model = model::parse_model(fuzz::small_models().one, "model.json");
    const auto& condensed = model.condensed.parameters;
    const auto& observer = model.observer.value().parameters;
    add(model, condensed, "condensed");
    add(model, observer, "observer");
    add(model, BothDirections<sensor::ObserverParameters<double>>{observer, observer}, "observer of both directions");
  }
  template <class Parameters>
  void add(const model::Model& model, const Parameters& parameters, std::string_view estimator) {
    std::vector<double> numbers{model.valve.rated_flow_m3_per_s, model.valve.stroke_m};
    for (const double number : exports::fmu::numbers_of(parameters)) numbers.push_back(number);
    tokens.push_back("token" + std::to_string(tokens.size()));
    folders.push_back(resource_folder(
        tokens.back(), {exports::fmu::order_of<Parameters>(estimator), tokens.back(), model.valve.name, numbers}));
  }
};

constexpr int ok = 0;

/// Either version behind the calls that both have; each returns the standard's status, which begins alike.
struct Fmi2 {
  void* handle = nullptr;

  Fmi2(const Fmus& fmus, std::size_t which) {
    static const fmi2CallbackFunctions callbacks{nullptr, nullptr, nullptr, nullptr, nullptr};
    handle = fmi2Instantiate("one", fmi2CoSimulation, fmus.tokens[which].c_str(), fmus.folders[which].c_str(),
                             &callbacks, 0, 0);
    fuzz::require(handle != nullptr);
  }
  ~Fmi2() { fmi2FreeInstance(handle); }
  Fmi2(const Fmi2&) = delete;
  Fmi2& operator=(const Fmi2&) = delete;
  int enter(double start_s, bool stops, double stop_s) const {
    const int status = fmi2SetupExperiment(handle, 0, 0, start_s, stops, stop_s);
    return status == ok ? static_cast<int>(fmi2EnterInitializationMode(handle)) : status;
  }
  int exit() const { return fmi2ExitInitializationMode(handle); }
  int terminate() const { return fmi2Terminate(handle); }
  int reset() const { return fmi2Reset(handle); }
  int get(const unsigned* of, std::size_t count, double* out) const { return fmi2GetReal(handle, of, count, out); }
  int set(const unsigned* of, std::size_t count, const double* in) const { return fmi2SetReal(handle, of, count, in); }
  int get(unsigned of, int* out) const { return fmi2GetInteger(handle, &of, 1, out); }
  int flag(unsigned of, bool value) const {
    const int number = value ? 1 : 0;
    return fmi2SetBoolean(handle, &of, 1, &number);
  }
  int keep(void** state) const { return fmi2GetFMUstate(handle, state); }
  int take(void* state) const { return fmi2SetFMUstate(handle, state); }
  int drop(void** state) const { return fmi2FreeFMUstate(handle, state); }
  int size(void* state, std::size_t* size) const { return fmi2SerializedFMUstateSize(handle, state, size); }
  int write(void* state, std::vector<char>& to) const {
    return fmi2SerializeFMUstate(handle, state, to.data(), to.size());
  }
  int read(const std::vector<char>& from, void** state) const {
    return fmi2DeSerializeFMUstate(handle, from.data(), from.size(), state);
  }
  int step(double time_s, double step_s) const { return fmi2DoStep(handle, time_s, step_s, 1); }
};

struct Fmi3 {
  void* handle = nullptr;

  Fmi3(const Fmus& fmus, std::size_t which) {
    handle = fmi3InstantiateCoSimulation("one", fmus.tokens[which].c_str(), fmus.folders[which].c_str(), false, false,
                                         false, false, nullptr, 0, nullptr, nullptr, nullptr);
    fuzz::require(handle != nullptr);
  }
  ~Fmi3() { fmi3FreeInstance(handle); }
  Fmi3(const Fmi3&) = delete;
  Fmi3& operator=(const Fmi3&) = delete;
  int enter(double start_s, bool stops, double stop_s) const {
    return fmi3EnterInitializationMode(handle, false, 0, start_s, stops, stop_s);
  }
  int exit() const { return fmi3ExitInitializationMode(handle); }
  int terminate() const { return fmi3Terminate(handle); }
  int reset() const { return fmi3Reset(handle); }
  int get(const unsigned* of, std::size_t count, double* out) const {
    return fmi3GetFloat64(handle, of, count, out, count);
  }
  int set(const unsigned* of, std::size_t count, const double* in) const {
    return fmi3SetFloat64(handle, of, count, in, count);
  }
  int get(unsigned of, int* out) const { return fmi3GetInt32(handle, &of, 1, out, 1); }
  int flag(unsigned of, bool value) const { return fmi3SetBoolean(handle, &of, 1, &value, 1); }
  int keep(void** state) const { return fmi3GetFMUState(handle, state); }
  int take(void* state) const { return fmi3SetFMUState(handle, state); }
  int drop(void** state) const { return fmi3FreeFMUState(handle, state); }
  int size(void* state, std::size_t* size) const { return fmi3SerializedFMUStateSize(handle, state, size); }
  int write(void* state, std::vector<char>& to) const {
    return fmi3SerializeFMUState(handle, state, reinterpret_cast<fmi3Byte*>(to.data()), to.size());
  }
  int read(const std::vector<char>& from, void** state) const {
    return fmi3DeserializeFMUState(handle, reinterpret_cast<const fmi3Byte*>(from.data()), from.size(), state);
  }
  int step(double time_s, double step_s) const {
    bool event = true, terminate = true, early = true;
    double reached_s = 0;
    return fmi3DoStep(handle, time_s, step_s, true, &event, &terminate, &early, &reached_s);
  }
};

template <class Fmi>
class Calls {
 public:
  Calls(fuzz::Input& in, const Fmi& fmu) : in_(in), fmu_(fmu) {
    fuzz::require(fmu_.reset() == ok);
    if (in.byte() % 4 == 0) return;  // nearly always straight on to where steps may be taken
    fuzz::require(fmu_.enter(0, false, 0) == ok && fmu_.exit() == ok);
  }
  ~Calls() { fmu_.drop(&state_); }
  Calls(const Calls&) = delete;
  Calls& operator=(const Calls&) = delete;

  void make() {
    switch (in_.byte() % 16) {
      case 0:
        (void)fmu_.enter(in_.number(0, 10), in_.byte() % 2 == 0, in_.number(10, 10));
        break;
      case 1:
        (void)fmu_.exit();
        break;
      case 2:
        if (in_.byte() % 8 == 0) (void)fmu_.terminate();
        break;
      case 3:
        if (in_.byte() % 4 == 0 && fmu_.reset() == ok) time_s_ = 0;
        break;
      case 4:
        (void)fmu_.flag(static_cast<unsigned>(in_.below(64)), in_.byte() % 2 == 0);
        break;
      case 5:
      case 6:
        set_any();
        break;
      case 7:
        keep();
        break;
      case 8:
        take();
        break;
      case 9:
        look();
        break;
      default:
        step();
    }
  }

 private:
  void set_any() {
    const std::size_t count = in_.below(4);
    std::vector<unsigned> of;
    std::vector<double> numbers;
    for (std::size_t k = 0; k < count; ++k) {
      of.push_back(static_cast<unsigned>(in_.below(80)));
      numbers.push_back(in_.number(1, 1));
    }
    (void)fmu_.set(of.data(), count, numbers.data());
  }
  void keep() {
    if (fmu_.keep(&state_) != ok) return;
    std::size_t size = 0;
    fuzz::require(fmu_.size(state_, &size) == ok);
    kept_.resize(size - (in_.byte() % 8 == 0 ? 1 : 0));
    fuzz::require((fmu_.write(state_, kept_) == ok) == (kept_.size() == size));
  }
  void take() {
    std::vector<char> bytes = kept_;
    const bool forged = fuzz::forge_state(in_, bytes);
    if (fmu_.read(bytes, &state_) != ok || fmu_.take(state_) != ok) return;
    forged_ = forged_ || forged;
    look_for_time();
  }
  void look_for_time() {
    const unsigned time = exports::fmu::sensor_time;
    fuzz::require(fmu_.get(&time, 1, &time_s_) == ok);
  }
  void look() {
    unsigned any[3];
    double values[3];
    for (unsigned& each : any) each = static_cast<unsigned>(in_.below(80));
    (void)fmu_.get(any, 3, values);
    int status = 0;
    (void)fmu_.get(exports::fmu::sensor_status, &status);
  }
  void step() {
    const unsigned inputs[4]{exports::fmu::sensor_current, exports::fmu::sensor_voltage, exports::fmu::sensor_position,
                             exports::fmu::sensor_oil_temperature};
    const double numbers[4]{in_.number(1, 2), in_.number(8, 20), in_.number(0.5e-3, 2e-3), in_.number(313, 60)};
    (void)fmu_.set(inputs, 4, numbers);
    const double step_s = in_.byte() % 16 == 0 ? in_.number(1e-3, 1) : 1e-3 * (1 + in_.byte() % 8);
    if (step_s > 0.1 && step_s < 1e5) return;  // allowed, and takes long
    if (fmu_.step(in_.byte() % 16 == 0 ? in_.number(time_s_, 1) : time_s_, step_s) != ok) return;
    look_for_time();
    if (!forged_) hold();
  }
  void hold() {
    const unsigned of[3]{exports::fmu::sensor_flow_lower, exports::fmu::sensor_flow, exports::fmu::sensor_flow_upper};
    double flow[3];
    fuzz::require(fmu_.get(of, 3, flow) == ok);
    for (const double each : flow) fuzz::require(std::isfinite(each));
    fuzz::require(flow[0] <= flow[1] && flow[1] <= flow[2]);
  }

  fuzz::Input& in_;
  const Fmi& fmu_;
  void* state_ = nullptr;
  std::vector<char> kept_;
  bool forged_ = false;  ///< a changed state was taken
  double time_s_ = 0;
};

/// An instance of each FMU serves all inputs, reset before each: to read its resource takes longer than all the calls.
template <class Fmi>
void run(fuzz::Input& in) {
  static const Fmus fmus;
  static const Fmi instances[]{{fmus, 0}, {fmus, 1}, {fmus, 2}};
  Calls<Fmi> calls(in, instances[in.byte() % std::size(instances)]);
  while (!in.empty()) calls.make();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input in(data, size);
  if (in.byte() % 2 == 0) {
    run<Fmi2>(in);
  } else {
    run<Fmi3>(in);
  }
  return 0;
}
