#pragma once
/// The smallest MATLAB v5 file: columns of doubles, uncompressed, little-endian ("MAT-File Format", MathWorks, 1-9 to
/// 1-18).
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace spoolflow::apps {

struct MatlabVariable {
  std::string name;
  std::vector<double> values;
};

namespace detail {

inline void append(std::string& out, const void* data, std::size_t size) {
  out.append(static_cast<const char*>(data), size);
}

/// Tag, data, and zeros up to a multiple of 8 bytes.
inline void append_element(std::string& out, std::uint32_t type, const void* data, std::size_t size) {
  const std::uint32_t tag[2]{type, static_cast<std::uint32_t>(size)};
  append(out, tag, sizeof tag);
  append(out, data, size);
  out.append((8 - size % 8) % 8, '\0');
}

}  // namespace detail

inline std::string matlab_v5_file(const std::vector<MatlabVariable>& variables) {
  constexpr std::uint32_t miINT8 = 1, miINT32 = 5, miUINT32 = 6, miDOUBLE = 9, miMATRIX = 14, mxDOUBLE_CLASS = 6;
  std::string file = "MATLAB 5.0 MAT-file";
  file.resize(124, ' ');
  file += std::string("\x00\x01IM", 4);
  for (const MatlabVariable& variable : variables) {
    const std::uint32_t flags[2]{mxDOUBLE_CLASS, 0};
    const std::int32_t dimensions[2]{static_cast<std::int32_t>(variable.values.size()), 1};
    std::string matrix;
    detail::append_element(matrix, miUINT32, flags, sizeof flags);
    detail::append_element(matrix, miINT32, dimensions, sizeof dimensions);
    detail::append_element(matrix, miINT8, variable.name.data(), variable.name.size());
    detail::append_element(matrix, miDOUBLE, variable.values.data(), variable.values.size() * sizeof(double));
    detail::append_element(file, miMATRIX, matrix.data(), matrix.size());
  }
  return file;
}

}  // namespace spoolflow::apps
