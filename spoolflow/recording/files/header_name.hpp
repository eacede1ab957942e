#pragma once
/// What a column's name says about channel and unit.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"
#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// A unit in brackets at the end of a name, where indices such as (:,2) are none: "I_sol [mA]" or "p1 (bar)" give
/// "I_sol" and "mA", "p1" and "bar".
struct BracketedName {
  std::string_view stem;
  std::string_view unit;  ///< empty: no brackets
};
[[nodiscard]] BracketedName split_brackets(std::string_view name);

/// `<channel>_<unit>`, or the bare channel's name with its unit in brackets or in a units row.
struct ChannelHeader {
  Channel channel;
  std::string unit;  ///< "1" for `test`; empty: the file does not say
};
[[nodiscard]] std::optional<ChannelHeader> channel_header(const FileColumn& column);

/// A row of units below the names: no numbers, and at least one unit that is known.
[[nodiscard]] bool is_units_row(const std::vector<std::string_view>& cells);

/// The unit that the file itself states for a column, apart from a suffix of its name; empty where it does not.
[[nodiscard]] std::string stated_unit(const FileColumn& column);

}  // namespace spoolflow::recording
