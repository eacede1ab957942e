#pragma once
/// Pages of the library as text.
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "spoolflow/report/text/reader_units.hpp"

namespace spoolflow::python {

/// What is wanted of a page, and in which units.
using PageUnits = std::optional<std::vector<std::string>>;

/// What `write` writes.
template <class Write>
std::string text_of(const Write& write) {
  std::ostringstream out;
  write(out);
  return std::move(out).str();
}

/// The page where it is wanted.
template <class Write>
std::optional<std::string> page_of(const PageUnits& units, const Write& write) {
  if (!units) return std::nullopt;
  const report::ReaderUnits in(*units);
  return text_of([&](std::ostream& out) { write(out, in); });
}

}  // namespace spoolflow::python
