/// Model files: bytes. What is taken can be written, and comes back as it was.
#include "tests/fuzz/model_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  spoolflow::fuzz::keep_or_refuse_model({reinterpret_cast<const char*>(data), size});
  return 0;
}
