#pragma once
/// What a column's name says about channel and unit.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"
#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// A name and the unit in it: "I_sol [mA]", "Current (mA) - Plot 0", "I_coil mA", "Temp degC, filtered" and "p/bar"
/// give mA, mA, mA, degC and bar, and what stands before them. Brackets come before words, and known units before other
/// text in brackets at the end. Indices such as (:,2), [0] and (k) are no units, and neither are words that mean more
/// than a unit: in, second, meter, and the letters A and C, by which coils and sensors go.
struct NameAndUnit {
  std::string_view stem;
  std::string_view unit;  ///< empty: none
};
[[nodiscard]] NameAndUnit split_unit(std::string_view name);

/// "pressureTime_ms" and "p_time" in words: pressure, time, ms. A single capital T stays one: it is a temperature.
[[nodiscard]] std::vector<std::string> words_of(std::string_view name);

/// `<channel>_<unit>`, or the bare channel's name with its unit as split_unit() finds it or in a units row. The name
/// may have capital letters and other gaps ("Oil Temperature [degC]", "OilTemperature_degC") where a unit of the
/// channel stands with it; a column that has the name as it is comes before such a one.
struct ChannelHeader {
  Channel channel;
  std::string unit;   ///< "1" for `test`; empty: the file does not say
  bool exact = true;  ///< the channel's name as it is
};
[[nodiscard]] std::optional<ChannelHeader> channel_header(const FileColumn& column);

/// A row of units below the names: no numbers, no names with a unit, and at least one unit that is known.
[[nodiscard]] bool is_units_row(const std::vector<std::string_view>& cells);

/// The unit that the file itself states for a column, apart from a suffix of its name; empty where it does not.
[[nodiscard]] std::string stated_unit(const FileColumn& column);

}  // namespace spoolflow::recording
