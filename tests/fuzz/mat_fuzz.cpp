/// MATLAB recordings through the process that reads them: bytes. What happens there is not seen in the coverage.
#include "tests/fuzz/sample_file.hpp"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  static const spoolflow::recording::ForkServer fork_server;  // before libFuzzer's thread that watches the memory
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  static const fuzz::InputFile file("run.mat");
  fuzz::read_in_child(file, data, size);
  return 0;
}
