/// MATLAB recordings through the process that reads them: bytes. What happens there is not seen in the coverage.
#include "tests/fuzz/sample_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  static const fuzz::InputFile file("run.mat");
  fuzz::read_in_child(file, data, size);
  return 0;
}
