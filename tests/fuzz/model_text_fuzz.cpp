/// Model files: bytes. What is taken can be written, and comes back as it was.
#include <sstream>

#include "spoolflow/model/model.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  try {
    const model::Model model = model::parse_model({reinterpret_cast<const char*>(data), size}, "model.json");
    std::ostringstream once, twice;
    model::write_model(once, model);
    model::write_model(twice, model::parse_model(once.str(), "again.json"));
    fuzz::require(once.str() == twice.str());
  } catch (const model::ModelError& error) {
    fuzz::require(error.what()[0] != '\0');
  }
  return 0;
}
