#pragma once
/// Files that travel inside the program (cmake/SpoolflowEmbed.cmake).
#include <span>
#include <string_view>

namespace spoolflow::exports {

struct EmbeddedFile {
  std::string_view name;
  std::string_view bytes;
};

/// The headers of spoolflow/sensor as they stood when this program was built.
[[nodiscard]] std::span<const EmbeddedFile> sensor_headers();
/// The files of an exported folder that are the same for every valve, and the frame of its README: NAME.in each.
[[nodiscard]] std::span<const EmbeddedFile> cpp_texts();
/// "icon.png", "icon.svg" and "LICENSE".
[[nodiscard]] std::span<const EmbeddedFile> fmu_assets();
/// Shared libraries of the FMUs for the platform that this program is built for: "sensor_fmu.so" and the valve's, on
/// 64-bit Arm "sensor_fmu_aarch64.so".
[[nodiscard]] std::span<const EmbeddedFile> fmu_binaries();
/// What the sensor's and the virtual valve's FMU are compiled from, by its path from the project's root.
[[nodiscard]] std::span<const EmbeddedFile> sensor_fmu_sources();
[[nodiscard]] std::span<const EmbeddedFile> valve_fmu_sources();

}  // namespace spoolflow::exports
