#include "spoolflow/export/fmu_archive.hpp"

#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/export/embedded_files.hpp"
#include "spoolflow/export/zip_archive.hpp"
#include "spoolflow/model/provenance.hpp"
#include "spoolflow/numerics/checksum.hpp"

namespace spoolflow::exports {
namespace {

std::string asset(std::string_view name) {
  for (const EmbeddedFile& file : fmu_assets()) {
    if (file.name == name) return std::string(file.bytes);
  }
  throw std::logic_error("no embedded file " + std::string(name));
}

}  // namespace

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

std::string fmu_archive(FmuContent content, const FmuParts& parts, FmiVersion version) {
  content.resource.token = instantiation_token(content, version);
  const bool fmi2 = version == FmiVersion::fmi2;
  const std::string linux64 = fmi2 ? "binaries/linux64/" : "binaries/x86_64-linux/";
  const std::string win64 = fmi2 ? "binaries/win64/" : "binaries/x86_64-windows/";
  std::vector<ArchiveMember> members{
      {"modelDescription.xml", fmi2 ? model_description_fmi2(content) : model_description_fmi3(content)},
      {std::string("resources/") + fmu::resource_name, fmu::resource_bytes(content.resource)},
      {"documentation/index.html", fmu_documentation(content)},
      {"documentation/licenses/license.txt", asset("LICENSE")}};
  // What could not be built where this program was is not there.
  const auto library = [&](const std::string& place, std::string_view bytes) {
    if (!bytes.empty()) members.push_back({place, std::string(bytes)});
  };
  library(linux64 + content.identifier + ".so", parts.linux64);
  library(win64 + content.identifier + ".dll", parts.win64);
  if (!fmi2) library("binaries/aarch64-linux/" + content.identifier + ".so", parts.aarch64);
  if (fmi2) {
    members.push_back({"model.png", asset("icon.png")});
  } else {
    members.push_back({"terminalsAndIcons/icon.png", asset("icon.png")});
    members.push_back({"terminalsAndIcons/icon.svg", asset("icon.svg")});
  }
  members.push_back({"sources/buildDescription.xml", build_description(content)});
  for (const EmbeddedFile& source : parts.sources) {
    members.push_back({"sources/" + std::string(source.name), std::string(source.bytes)});
  }
  return zip_archive(members, model::seconds_of(content.generation_time).value_or(0));
}

}  // namespace spoolflow::exports
