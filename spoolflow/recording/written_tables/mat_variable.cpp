#include "spoolflow/recording/written_tables/mat_variable.hpp"

#include <algorithm>

#include "spoolflow/numerics/little_endian.hpp"

namespace spoolflow::recording {
namespace {

using Bytes = std::vector<std::uint8_t>;
using numerics::put_little_endian;

// Types of elements.
constexpr std::uint32_t int8 = 1, int32 = 5, uint32 = 6, float64 = 9, matrix = 14, utf8 = 16;

void put_tag(Bytes& out, std::uint32_t type, std::uint64_t bytes) {
  put_little_endian(out, type);
  put_little_endian(out, static_cast<std::uint32_t>(bytes));
}

void pad(Bytes& out) {
  while (out.size() % 8 != 0) out.push_back(0);
}

/// Kind, sizes and name.
Bytes description(const std::string& name, MatClass kind, std::uint64_t rows, std::uint64_t columns) {
  Bytes out;
  put_tag(out, uint32, 8);
  put_little_endian(out, static_cast<std::uint64_t>(kind));
  put_tag(out, int32, 8);
  put_little_endian(out, static_cast<std::uint32_t>(rows));
  put_little_endian(out, static_cast<std::uint32_t>(columns));
  put_tag(out, int8, name.size());
  out.insert(out.end(), name.begin(), name.end());
  pad(out);
  return out;
}

Bytes whole(const Bytes& content) {
  Bytes out;
  put_tag(out, matrix, content.size());
  out.insert(out.end(), content.begin(), content.end());
  return out;
}

}  // namespace

Bytes mat_vector_head(const std::string& name, MatClass kind, std::uint64_t rows) {
  const std::uint64_t bytes = rows * (kind == MatClass::word ? 4 : 8);
  const Bytes about = description(name, kind, rows, 1);
  Bytes out;
  put_tag(out, matrix, about.size() + 8 + (bytes + 7) / 8 * 8);
  out.insert(out.end(), about.begin(), about.end());
  put_tag(out, kind == MatClass::word ? uint32 : float64, bytes);
  return out;
}

Bytes mat_text(const std::string& name, const std::vector<std::string>& lines) {
  std::size_t longest = 0;
  for (const std::string& line : lines) longest = std::max(longest, line.size());
  Bytes out = description(name, MatClass::text, lines.size(), longest);
  put_tag(out, utf8, lines.size() * longest);
  for (std::size_t column = 0; column < longest; ++column) {
    for (const std::string& line : lines)
      out.push_back(static_cast<std::uint8_t>(column < line.size() ? line[column] : ' '));
  }
  pad(out);
  return whole(out);
}

Bytes mat_structure(const std::string& name, const std::vector<std::pair<std::string, Bytes>>& fields) {
  constexpr std::uint32_t name_bytes = 32;
  Bytes out = description(name, MatClass::structure, 1, 1);
  put_little_endian(out, std::uint32_t{4} << 16U | int32);  // a short element: its size and type in one word
  put_little_endian(out, name_bytes);
  put_tag(out, int8, fields.size() * name_bytes);
  for (const auto& [field, content] : fields) {
    out.insert(out.end(), field.begin(), field.end());
    out.resize(out.size() + name_bytes - field.size());
  }
  for (const auto& [field, content] : fields) out.insert(out.end(), content.begin(), content.end());
  return whole(out);
}

}  // namespace spoolflow::recording
