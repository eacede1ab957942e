#include "spoolflow/export/embedded_parts.hpp"

#include <stdexcept>

#include "spoolflow/export/fmu_binaries.hpp"

namespace spoolflow::exports {

FmuParts embedded_parts(const std::string& name, std::span<const EmbeddedFile> sources) {
  const auto binary = [](const std::string& file) {
    for (const EmbeddedFile& each : fmu_binaries()) {
      if (each.name == file) return each.bytes;
    }
    throw std::logic_error("no embedded binary " + file);
  };
  return {binary(name + ".so"), binary(name + ".dll"), binary(name + "_aarch64.so"), sources};
}

bool windows_is_served() {
  return !embedded_parts("sensor_fmu", {}).win64.empty();
}

std::vector<std::string> translation_units(std::span<const EmbeddedFile> sources) {
  std::vector<std::string> units;
  for (const EmbeddedFile& source : sources) {
    if (source.name.ends_with(".cpp")) units.emplace_back(source.name);
  }
  return units;
}

}  // namespace spoolflow::exports
