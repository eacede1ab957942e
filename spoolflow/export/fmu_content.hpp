#pragma once
/// What goes into an FMU besides its binaries: one description for both versions of the standard.
#include <string>
#include <vector>

#include "spoolflow/export/fmu/resource.hpp"
#include "spoolflow/export/fmu/variable.hpp"

namespace spoolflow::exports {

enum class FmiVersion { fmi2, fmi3 };

struct FmuContent {
  std::string identifier;       ///< of the model: names binaries, "spoolflow_sensor"
  std::string model_name;       ///< shown to the user
  std::string description;      ///< one sentence
  std::string notes_html;       ///< paragraphs for the documentation page, as HTML
  std::string tool_version;     ///< of this program
  std::string generation_time;  ///< UTC, ISO 8601 to the second
  double step_s = 1e-3;         ///< proposed communication step
  double stop_s = 10;           ///< proposed end of an experiment that starts at 0
  std::vector<fmu::Variable> variables;
  std::vector<std::string> sources;  ///< to compile, as named in the FMU's folder sources
  fmu::Resource resource;            ///< its token is that of the FMU
};

/// A token that differs whenever numbers, variables, version or tool differ: {8-4-4-4-12} hexadecimal digits.
[[nodiscard]] std::string instantiation_token(const FmuContent& content, FmiVersion version);

/// modelDescription.xml by FMI 2.0 (schema fmi2ModelDescription.xsd) or 3.0 (fmi3ModelDescription.xsd).
[[nodiscard]] std::string model_description_fmi2(const FmuContent& content);
[[nodiscard]] std::string model_description_fmi3(const FmuContent& content);
/// sources/buildDescription.xml by FMI 3.0; FMI 2.0 takes the same file since 2.0.4, and only it names the language.
[[nodiscard]] std::string build_description(const FmuContent& content);
/// documentation/index.html
[[nodiscard]] std::string fmu_documentation(const FmuContent& content);

}  // namespace spoolflow::exports
