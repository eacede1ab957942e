#pragma once
/// Variables of MATLAB files of version 5 ("MAT-File Level 5 Format"): a tag, flags, sizes, a name, the numbers.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace spoolflow::recording {

enum class MatClass : std::uint8_t { structure = 2, text = 4, number = 6, word = 13 };

/// All of a column vector's variable that stands before its numbers, which follow with padding to 8 bytes.
[[nodiscard]] std::vector<std::uint8_t> mat_vector_head(const std::string& name, MatClass kind, std::uint64_t rows);
/// A whole variable, or a field without a name: a matrix of letters, a line a row, filled up with blanks. ASCII.
[[nodiscard]] std::vector<std::uint8_t> mat_text(const std::string& name, const std::vector<std::string>& lines);
/// `fields`: names of at most 31 letters, each with a variable without a name.
[[nodiscard]] std::vector<std::uint8_t> mat_structure(
    const std::string& name, const std::vector<std::pair<std::string, std::vector<std::uint8_t>>>& fields);

}  // namespace spoolflow::recording
