#pragma once
/// Instructions of the sensor by the header and function of spoolflow/sensor in which they were written.
#include <map>
#include <string>

namespace spoolflow::bench {

/// Instructions by header, and there by function.
using Profile = std::map<std::string, std::map<std::string, int>>;

inline constexpr const char* elsewhere = "entry, return and others";

/// `inlined`: of each instruction's address what `addr2line -a -i -f -C` says.
[[nodiscard]] Profile profile_of(const std::string& inlined);

}  // namespace spoolflow::bench
