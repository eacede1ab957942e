/// What the paper found, measured on the virtual rig: a table, and pictures on request. Fails where a finding does not
/// come out.
/// rig_findings [-o FOLDER_FOR_PICTURES]
#include <algorithm>
#include <exception>
#include <string_view>
#include <unistd.h>

#include <fmt/format.h>

#include "tests/findings/pictures.hpp"

namespace {

using namespace spoolflow::findings;
namespace fs = std::filesystem;

/// A folder that goes away with it.
struct TemporaryFolder {
  fs::path path;
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "spoolflow-findings-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    path = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { fs::remove_all(path); }
};

bool show(const std::vector<Finding>& findings) {
  bool all = true;
  for (const Finding& finding : findings) {
    fmt::print("{:<75}{:>7.2f} {:<8}{:>6g} to {:<5g}{:<12}{}\n", finding.what, finding.value, finding.unit,
               finding.lowest, finding.highest, finding.from, finding.holds() ? "" : "MISSED");
    all = all && finding.holds();
  }
  return all;
}

bool measure(const fs::path& pictures) {
  const TemporaryFolder folder;
  const Measured measured{.plain = solenoid_loops(0),
                          .dithered = solenoid_loops(6),
                          .flow_forces = flow_force_curves(50),
                          .temperature = temperature_effects(),
                          .rests = rests(),
                          .condensed = condensed_runs(folder.path)};
  fmt::print("{:<75}{:>7} {:<8}{:>6}    {:<5}{}\n", "finding", "value", "", "wanted", "", "from");
  const bool all[] = {show(solenoid_findings(measured.plain, measured.dithered)),
                      show(flow_force_findings(measured.flow_forces, measured.temperature)),
                      show(hunting_findings(measured.rests)), show(condensed_findings(measured.condensed))};
  if (!pictures.empty()) draw(measured, pictures);
  return std::all_of(std::begin(all), std::end(all), [](bool held) { return held; });
}

}  // namespace

int main(int argc, char** argv) {
  const bool with_pictures = argc == 3 && std::string_view(argv[1]) == "-o";
  if (argc != 1 && !with_pictures) {
    fmt::print(stderr, "usage: rig_findings [-o FOLDER_FOR_PICTURES]\n");
    return 2;
  }
  try {
    return measure(with_pictures ? argv[2] : "") ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "rig_findings: {}\n", error.what());
    return 1;
  }
}
