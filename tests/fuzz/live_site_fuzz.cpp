/// The site's file: bytes, with a model m.json and a recording run.csv beside it. Sources are read, not begun.
#include <fstream>

#include "addons/live/site.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  static const fuzz::InputFile file("site.toml");
  static const bool prepared = [] {
    const auto folder = file.path().parent_path();
    std::filesystem::copy_file(SPOOLFLOW_FUZZ_MODEL, folder / "m.json");
    std::ofstream(folder / "run.csv") << "time_s,current_A,position_mm\n0,1,1\n";
    return true;
  }();
  fuzz::require(prepared);
  file.write(data, size);
  try {
    const live::SiteSettings site = live::read_site(file.path());
    fuzz::require(!site.valves.empty());
    for (const live::ValveSettings& valve : site.valves) {
      fuzz::require(!valve.id.empty() && !live::kind(valve.source).empty() && valve.model.model != nullptr);
    }
  } catch (const std::invalid_argument& error) {
    fuzz::require(error.what()[0] != '\0');
  }
  return 0;
}
