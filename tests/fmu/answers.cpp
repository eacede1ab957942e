/// answers LIBRARY TOKEN RESOURCES OUTPUT INPUT=MIDDLE:SWING…: a co-simulation FMU of FMI 3.0 stepped for two seconds
/// of 1 ms while each input swings about its middle, at 1 Hz. Variables are named by their value references. Prints
/// what the output is after each step. Compiled by a test for this machine and for another.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <vector>

#include "spoolflow/export/fmu/fmi3.hpp"

namespace {

template <class Function>
Function* function(void* library, const char* name) {
  void* const address = dlsym(library, name);
  if (address == nullptr) std::fprintf(stderr, "no %s\n", name), std::exit(2);
  return reinterpret_cast<Function*>(address);
}

struct Input {
  fmi3ValueReference reference;
  double middle, swing;
};

std::vector<Input> inputs_of(int count, char** texts) {
  std::vector<Input> inputs;
  for (int k = 0; k < count; ++k) {
    Input input{};
    if (std::sscanf(texts[k], "%u=%lf:%lf", &input.reference, &input.middle, &input.swing) == 3)
      inputs.push_back(input);
  }
  return inputs;
}

void require(fmi3Status status) {
  if (status > fmi3Warning) std::fprintf(stderr, "status %d\n", static_cast<int>(status)), std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) return 2;
  void* const library = dlopen(argv[1], RTLD_NOW);
  if (library == nullptr) return std::fprintf(stderr, "%s\n", dlerror()), 2;
  using Instantiate =
      fmi3Instance(fmi3String, fmi3String, fmi3String, bool, bool, bool, bool, const fmi3ValueReference*, std::size_t,
                   fmi3InstanceEnvironment, fmi3LogMessageCallback, fmi3IntermediateUpdateCallback);
  const fmi3Instance fmu = function<Instantiate>(library, "fmi3InstantiateCoSimulation")(
      "answers", argv[2], argv[3], false, false, false, false, nullptr, 0, nullptr, nullptr, nullptr);
  if (fmu == nullptr) return std::fprintf(stderr, "not instantiated\n"), 2;
  const auto set =
      function<fmi3Status(fmi3Instance, const fmi3ValueReference*, std::size_t, const double*, std::size_t)>(
          library, "fmi3SetFloat64");
  const auto get = function<fmi3Status(fmi3Instance, const fmi3ValueReference*, std::size_t, double*, std::size_t)>(
      library, "fmi3GetFloat64");
  const auto do_step =
      function<fmi3Status(fmi3Instance, double, double, bool, bool*, bool*, bool*, double*)>(library, "fmi3DoStep");
  require(function<fmi3Status(fmi3Instance, bool, double, double, bool, double)>(
      library, "fmi3EnterInitializationMode")(fmu, false, 0, 0, false, 0));
  require(function<fmi3Status(fmi3Instance)>(library, "fmi3ExitInitializationMode")(fmu));
  const auto output = static_cast<fmi3ValueReference>(std::strtoul(argv[4], nullptr, 10));
  const std::vector<Input> inputs = inputs_of(argc - 5, argv + 5);
  for (int k = 0; k < 2000; ++k) {
    for (const Input& input : inputs) {
      const double value = input.middle + input.swing * std::sin(6.283185307 * 1e-3 * k);
      require(set(fmu, &input.reference, 1, &value, 1));
    }
    bool event = false, ends = false, early = false;
    double last_s = 0, answer = 0;
    require(do_step(fmu, 1e-3 * k, 1e-3, true, &event, &ends, &early, &last_s));
    require(get(fmu, &output, 1, &answer, 1));
    std::printf("%.12g\n", answer);
  }
  return 0;
}
