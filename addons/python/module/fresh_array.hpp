#pragma once
#include <cstdlib>
#include <new>
#include <pybind11/numpy.h>
#include <sys/mman.h>

namespace spoolflow::python {

/// A new array, its numbers not set. Large ones get large pages where the system has them: handing out
/// small ones one by one takes its time beside a sensor's steps.
template <class T>
pybind11::array_t<T> fresh_array(std::size_t size) {
  constexpr std::size_t large_page = std::size_t{2} << 20;
  const std::size_t bytes = size * sizeof(T);
  if (bytes < large_page) return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(size));
  const std::size_t rounded = (bytes + large_page - 1) / large_page * large_page;
  void* const memory = std::aligned_alloc(large_page, rounded);
  if (memory == nullptr) throw std::bad_alloc();
  (void)::madvise(memory, rounded, MADV_HUGEPAGE);  // where it cannot be, small ones do
  const pybind11::capsule keeper(memory, [](void* kept) { std::free(kept); });
  return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(size), static_cast<T*>(memory), keeper);
}

}  // namespace spoolflow::python
