#pragma once
/// Small dense linear algebra of fixed capacity: Cholesky's factor of a symmetric positive matrix, what is solved with
/// it, and its determinant. Nothing is allocated.
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace spoolflow::monitor {

/// Lower factor L of A = L L^T, row after row; A is `size` by `size` in the first size^2 numbers of `values`, which the
/// factor replaces. False where A is not positive.
[[nodiscard]] inline bool factorise(std::span<double> values, std::size_t size) {
  for (std::size_t r = 0; r < size; ++r) {
    for (std::size_t c = 0; c <= r; ++c) {
      double sum = values[r * size + c];
      for (std::size_t k = 0; k < c; ++k) sum -= values[r * size + k] * values[c * size + k];
      if (r != c) {
        values[r * size + c] = sum / values[c * size + c];
      } else {
        if (!(sum > 0)) return false;
        values[r * size + r] = std::sqrt(sum);
      }
    }
  }
  return true;
}

/// Solves L L^T x = right in place.
inline void solve_in_place(std::span<const double> factor, std::size_t size, std::span<double> right) {
  for (std::size_t r = 0; r < size; ++r) {
    for (std::size_t k = 0; k < r; ++k) right[r] -= factor[r * size + k] * right[k];
    right[r] /= factor[r * size + r];
  }
  for (std::size_t r = size; r-- > 0;) {
    for (std::size_t k = r + 1; k < size; ++k) right[r] -= factor[k * size + r] * right[k];
    right[r] /= factor[r * size + r];
  }
}

/// ln det A of the factor.
[[nodiscard]] inline double log_determinant(std::span<const double> factor, std::size_t size) {
  double sum = 0;
  for (std::size_t r = 0; r < size; ++r) sum += std::log(factor[r * size + r]);
  return 2 * sum;
}

[[nodiscard]] inline double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace spoolflow::monitor
