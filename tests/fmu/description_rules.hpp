#pragma once
/// Rules of the FMI standards for modelDescription.xml beyond its schema, as validators check them.
#include <string>
#include <vector>

#include "tests/fmu/unpacked_fmu.hpp"

namespace spoolflow::exports {

/// One line a violation; empty where all is well.
[[nodiscard]] std::vector<std::string> description_violations(const UnpackedFmu& fmu);

}  // namespace spoolflow::exports
