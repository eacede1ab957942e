#pragma once
/// The one file in an FMU's resources: numbers behind a header that names what they are for, ended by a checksum.
/// Numbers are IEEE doubles, lowest byte first, as on every platform that the FMUs run on.
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::exports::fmu {

/// A resource that cannot be used; the message names file, trouble and remedy.
struct ResourceError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

inline constexpr const char* resource_name = "parameters.bin";

struct Resource {
  std::string kind;   ///< what the numbers are for, and in which order: "spoolflow sensor …"
  std::string token;  ///< instantiation token (FMI 2: GUID) of the FMU that it belongs to
  std::string name;   ///< of the valve
  std::vector<double> numbers;
};

[[nodiscard]] std::string resource_bytes(const Resource& resource);
/// Throws ResourceError; `file` names the resource in messages.
[[nodiscard]] Resource parse_resource(std::string_view bytes, const std::string& file);
/// Reads FOLDER/parameters.bin. Throws ResourceError where it is not there, is damaged, or belongs to another token.
[[nodiscard]] Resource read_resource(const std::string& folder, const std::string& token);

}  // namespace spoolflow::exports::fmu
