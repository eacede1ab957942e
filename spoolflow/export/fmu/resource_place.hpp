#pragma once
#include <string>
#include <string_view>

namespace spoolflow::exports::fmu {

/// The folder that a file URI (RFC 3986, 8089) means; a plain path is taken as it is. Empty for a URI of another scheme
/// or with a broken escape.
[[nodiscard]] std::string folder_of_uri(std::string_view uri);

}  // namespace spoolflow::exports::fmu
