#pragma once
/// Columns that are called a time.
#include <string>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// Whether the column is called a time and its unit, where stated, is one: time_s, t, zeit_ms, pressure_time.
[[nodiscard]] bool named_time(const FileColumn& column);

/// The unit that such a column's name or the file states: "ms" of t_ms; empty where neither does.
[[nodiscard]] std::string unit_of_time(const FileColumn& column);

/// Whether `time` carries the name of `column`: pressure_time of pressure_bar.
[[nodiscard]] bool carries_name(const FileColumn& time, const FileColumn& column);

}  // namespace spoolflow::recording
