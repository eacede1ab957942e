#include "spoolflow/recording/files/matrix_names.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace spoolflow::recording {

std::vector<MatrixPart> matrix_parts(const FileColumn& matrix, std::uint64_t rows, std::uint64_t columns) {
  std::vector<MatrixPart> out;
  if (rows == 0 || columns == 0) return out;
  if (rows == 1 || columns == 1) {
    out.push_back({{matrix, rows * columns}, columns != 1, 0});
    return out;
  }
  constexpr std::uint64_t most = 256;
  const bool by_rows = columns > rows;
  for (std::uint64_t k = 0; k < std::min(most, by_rows ? rows : columns); ++k) {
    const std::string part = by_rows ? fmt::format("({},:)", k + 1) : fmt::format("(:,{})", k + 1);
    FileColumn column = matrix;
    column.name += part, column.leaf += part;
    out.push_back({{std::move(column), by_rows ? columns : rows}, by_rows, k});
  }
  return out;
}

}  // namespace spoolflow::recording
