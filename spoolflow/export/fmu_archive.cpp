#include "spoolflow/export/fmu_archive.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "spoolflow/export/embedded_files.hpp"
#include "spoolflow/export/zip_archive.hpp"
#include "spoolflow/model/provenance.hpp"
#include "spoolflow/numerics/checksum.hpp"

namespace spoolflow::exports {
namespace {

std::string asset(std::string_view name) {
  const auto found = std::ranges::find(fmu_assets(), name, &EmbeddedFile::name);
  if (found == fmu_assets().end()) throw std::logic_error("no embedded file " + std::string(name));
  return std::string(found->bytes);
}

/// Empty where the program was built without a compiler for it.
std::string_view binary(const std::string& file) {
  for (const std::span<const EmbeddedFile> binaries : {fmu_binaries(), foreign_fmu_binaries()}) {
    const auto found = std::ranges::find(binaries, file, &EmbeddedFile::name);
    if (found != binaries.end()) return found->bytes;
  }
  return {};
}

}  // namespace

std::span<const EmbeddedFile>& foreign_fmu_binaries() {
  static std::span<const EmbeddedFile> of_the_program;
  return of_the_program;
}

bool windows_is_served() {
  return !binary("sensor_fmu.dll").empty();
}

std::vector<std::string> translation_units(std::span<const EmbeddedFile> sources) {
  std::vector<std::string> units;
  for (const EmbeddedFile& source : sources) {
    if (source.name.ends_with(".cpp")) units.emplace_back(source.name);
  }
  return units;
}

std::string instantiation_token(const FmuContent& content, FmiVersion version) {
  numerics::Checksum first, second;
  const auto add = [&](const std::string& text) {
    first.add(text.data(), text.size() + 1);
    second.add(text.data(), text.size() + 1);
  };
  second.add("token", 5);
  add(version == FmiVersion::fmi2 ? "2" : "3");
  add(content.identifier), add(content.tool_version), add(content.model_name), add(content.resource.kind);
  for (const fmu::Variable& variable : content.variables) add(variable.name);
  const auto* numbers = reinterpret_cast<const char*>(content.resource.numbers.data());
  first.add(numbers, content.resource.numbers.size() * sizeof(double));
  second.add(numbers, content.resource.numbers.size() * sizeof(double));
  const std::string digits = fmt::format("{:016x}{:016x}", first.value(), second.value());
  return fmt::format("{{{}-{}-{}-{}-{}}}", digits.substr(0, 8), digits.substr(8, 4), digits.substr(12, 4),
                     digits.substr(16, 4), digits.substr(20));
}

std::string fmu_archive(FmuContent content, const std::string& library, std::span<const EmbeddedFile> sources,
                        FmiVersion version) {
  content.resource.token = instantiation_token(content, version);
  const bool fmi2 = version == FmiVersion::fmi2;
  const std::string linux64 = fmi2 ? "binaries/linux64/" : "binaries/x86_64-linux/";
  const std::string win64 = fmi2 ? "binaries/win64/" : "binaries/x86_64-windows/";
  std::vector<ArchiveMember> members{
      {"modelDescription.xml", fmi2 ? model_description_fmi2(content) : model_description_fmi3(content)},
      {std::string("resources/") + fmu::resource_name, fmu::resource_bytes(content.resource)},
      {"documentation/index.html", fmu_documentation(content)},
      {"documentation/licenses/license.txt", asset("LICENSE")}};
  const auto add_library = [&](const std::string& place, const std::string& file) {
    if (const std::string_view bytes = binary(file); !bytes.empty()) members.push_back({place, std::string(bytes)});
  };
  add_library(linux64 + content.identifier + ".so", library + ".so");
  add_library(win64 + content.identifier + ".dll", library + ".dll");
  // FMI 2.0 has no name for 64-bit Arm.
  if (!fmi2) add_library("binaries/aarch64-linux/" + content.identifier + ".so", library + "_aarch64.so");
  if (fmi2) {
    members.push_back({"model.png", asset("icon.png")});
  } else {
    members.push_back({"terminalsAndIcons/icon.png", asset("icon.png")});
    members.push_back({"terminalsAndIcons/icon.svg", asset("icon.svg")});
  }
  members.push_back({"sources/buildDescription.xml", build_description(content)});
  for (const EmbeddedFile& source : sources) {
    members.push_back({"sources/" + std::string(source.name), std::string(source.bytes)});
  }
  return zip_archive(members, model::seconds_of(content.generation_time).value_or(0));
}

}  // namespace spoolflow::exports
