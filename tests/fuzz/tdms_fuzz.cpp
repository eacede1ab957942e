/// TDMS recordings as their reader takes them, in this process: bytes.
#include "spoolflow/recording/tdms/tdms_table.hpp"
#include "tests/fuzz/vector_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  static const fuzz::InputFile file("run.tdms");
  fuzz::read_vectors(file, data, size, recording::open_tdms_table);
  return 0;
}
