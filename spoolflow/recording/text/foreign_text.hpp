#pragma once
/// Text that is no recording, by its kind.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::recording {

/// Throws RecordingError where the beginning shows JSON, XML or HTML, source code, a log of bus messages, a pointer of
/// Git LFS, or bytes that are no text: whatever numbers it holds are no table.
void refuse_other_kinds_of_text(std::string_view beginning, const std::string& file);

/// Throws RecordingError where the lines behind the first say something and nothing of it is a number: prose, lists,
/// columns that several blanks part. A header alone, one column of numbers and empty rows pass.
void refuse_text_without_numbers(const std::vector<std::string_view>& lines, char delimiter, const std::string& file);

}  // namespace spoolflow::recording
