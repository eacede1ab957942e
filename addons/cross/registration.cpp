/// Makes the libraries for other platforms, the compiler of firmware and SSP files known to the export of every program
/// that this file is linked into.
#include "addons/cross/embedded_foreign_binaries.hpp"
#include "addons/cross/firmware_library.hpp"
#include "addons/cross/system_structure.hpp"
#include "spoolflow/export/fmu_archive.hpp"

namespace spoolflow::exports {
namespace {

[[maybe_unused]] const bool known = [] {
  foreign_fmu_binaries() = embedded_foreign_binaries();
  firmware_compiler() = firmware_library;
  system_package() = valve_and_sensor;
  return true;
}();

}  // namespace
}  // namespace spoolflow::exports
