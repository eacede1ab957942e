#pragma once
/// A CSV file that writes the times of a column beside it.
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// Whether columns have times of their own beside the first one that is called a time: a time that carries a column's
/// name (position_time_s of position_mm), or the first time's name again, numbered, before the columns that it is of
/// (Time 2, time_s.1). Each column that is none of these times then has its own_time. A time of another name, such as
/// the date beside the seconds, is a column as any other.
[[nodiscard]] bool pair_times(std::vector<FileColumn>& columns);

}  // namespace spoolflow::recording
