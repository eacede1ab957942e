/// Makes the libraries for other platforms, and the compiler of firmware, known to the export of every program that
/// this file is linked into.
#include "addons/cross/embedded_foreign_binaries.hpp"
#include "addons/cross/firmware_library.hpp"
#include "spoolflow/export/embedded_parts.hpp"

namespace spoolflow::exports {
namespace {

[[maybe_unused]] const bool known = [] {
  foreign_fmu_binaries() = embedded_foreign_binaries();
  firmware_compiler() = firmware_library;
  return true;
}();

}  // namespace
}  // namespace spoolflow::exports
