/// MDF 4 recordings as their reader takes them, in this process: bytes.
#include "spoolflow/recording/mdf4/mdf4_table.hpp"
#include "tests/fuzz/vector_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  static const fuzz::InputFile file("run.mf4");
  fuzz::read_vectors(file, data, size, recording::open_mdf4_table);
  return 0;
}
