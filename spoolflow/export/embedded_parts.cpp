#include "spoolflow/export/embedded_parts.hpp"

#include <span>
#include <string_view>

#include "spoolflow/export/embedded_files.hpp"

namespace spoolflow::exports {

std::span<const EmbeddedFile>& foreign_fmu_binaries() {
  static std::span<const EmbeddedFile> of_the_program;
  return of_the_program;
}

FmuParts embedded_parts(const std::string& name, std::span<const EmbeddedFile> sources) {
  const auto binary = [](const std::string& file) -> std::string_view {
    for (const std::span<const EmbeddedFile> binaries : {fmu_binaries(), foreign_fmu_binaries()}) {
      for (const EmbeddedFile& each : binaries) {
        if (each.name == file) return each.bytes;
      }
    }
    return {};
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
