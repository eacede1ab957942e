#pragma once
/// Names by which a channel map can name each column: of columns of one name, and of the vectors of a matrix, MATLAB's
/// own way of taking a column or a row.
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"
#include "spoolflow/recording/files/vector_table.hpp"

namespace spoolflow::recording {

/// "I [A]" twice becomes "I [A] #1" and "I [A] #2"; the leaf, by which a channel is known, stays.
inline void number_equal_names(std::vector<FileColumn>& columns) {
  std::map<std::string, std::size_t> count, given;
  std::set<std::string> taken;
  for (const FileColumn& column : columns) ++count[column.name];
  for (const auto& [name, of_it] : count) {
    if (of_it == 1) taken.insert(name);
  }
  for (FileColumn& column : columns) {
    if (column.name.empty() || count[column.name] == 1) continue;
    std::size_t& number = given[column.name];
    std::string numbered;
    do numbered = column.name + " #" + std::to_string(++number);
    while (!taken.insert(numbered).second);
    column.name = std::move(numbered);
  }
}

/// One vector inside a matrix of rows x columns: numbers of the rows or columns counted from zero.
struct MatrixPart {
  VectorTable::Vector vector;
  bool is_row;
  std::uint64_t index;
};

/// The vector itself where the matrix is one; else its columns as name(:,1), name(:,2) and so on, or its rows as
/// name(1,:) where it is wider than tall. At most 256 of them; empty matrices have none.
[[nodiscard]] std::vector<MatrixPart> matrix_parts(const FileColumn& matrix, std::uint64_t rows, std::uint64_t columns);

}  // namespace spoolflow::recording
