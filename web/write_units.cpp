/// Writes web/src/units.ts: the units in which the page's plots draw and read out, from the table that `--units` and
/// the pages use. `ninja -C build/release web_units` puts it in its place; a test proves it fresh.
#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "spoolflow/units/reader_unit.hpp"

namespace {

using spoolflow::units::ReaderQuantity;

std::string lines_of(const ReaderQuantity& quantity) {
  std::string out = fmt::format("  {}: [\n", quantity.name);
  for (std::size_t k = 0; k < quantity.count(); ++k) {
    const spoolflow::units::ReaderUnit& unit = quantity.units[k];
    out += fmt::format("    {{ name: '{}', factor: {}, offset: {}, decimals: {} }},\n",
                       unit.full_name.empty() ? unit.shown : unit.full_name, unit.factor, unit.offset, unit.decimals);
  }
  return out + "  ],\n";
}

}  // namespace

int main() {
  std::string names;
  std::string lists;
  for (const ReaderQuantity& quantity : spoolflow::units::reader_quantities()) {
    if (!quantity.plotted) continue;
    names += fmt::format("{}'{}'", names.empty() ? "" : " | ", quantity.name);
    lists += lines_of(quantity);
  }
  const std::string page = fmt::format(
      "// Written by web/write_units.cpp from the table in spoolflow/units/reader_unit.cpp: change it there, then run\n"
      "// ninja -C build/release web_units\n"
      "/** A unit in which plots draw and read out: shown value = factor * value of the data + offset. */\n"
      "export interface Unit {{\n  name: string;\n  factor: number;\n  offset: number;\n  decimals: number;\n}}\n\n"
      "export type Quantity = {};\n\n"
      "/** Data come in the first unit of each quantity. */\n"
      "export const units: Record<Quantity, Unit[]> = {{\n{}}};\n",
      names, lists);
  return std::fwrite(page.data(), 1, page.size(), stdout) == page.size() ? 0 : 1;
}
