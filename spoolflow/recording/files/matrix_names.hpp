#pragma once
/// How the vectors of a matrix are named: MATLAB's own way of taking a column or a row.
#include <cstdint>
#include <string>
#include <vector>

#include "spoolflow/recording/files/vector_table.hpp"

namespace spoolflow::recording {

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
