#include "spoolflow/report/text/reader_units.hpp"

#include <fmt/format.h>

namespace spoolflow::report {
namespace {

using units::Kind;
using units::ReaderQuantity;
using units::ReaderUnit;

/// All names that can be asked for.
std::string names_of_units(std::string_view between_units, std::string_view between_quantities) {
  std::string out;
  for (const ReaderQuantity& quantity : units::reader_quantities()) {
    bool first = true;
    for (const ReaderUnit& unit : quantity.units) {
      if (unit.asked.empty()) continue;
      if (!out.empty()) out += first ? between_quantities : between_units;
      out += unit.asked;
      first = false;
    }
  }
  return out;
}

}  // namespace

ReaderUnits::ReaderUnits(const std::vector<std::string>& asked) {
  std::array<std::string_view, units::kind_count> given{};
  for (const std::string& name : asked) {
    bool known = false;
    for (const ReaderQuantity& quantity : units::reader_quantities()) {
      const auto q = static_cast<std::size_t>(quantity.kind);
      for (std::size_t k = 0; k < quantity.units.size(); ++k) {
        if (name.empty() || quantity.units[k].asked != name) continue;
        if (!given[q].empty()) {
          throw UnknownUnit(
              fmt::format("--units: both {} and {} are units of {}; give one", given[q], name, quantity.name));
        }
        known = true;
        given[q] = name;
        chosen_[q] = k;
      }
    }
    if (!known) throw UnknownUnit(fmt::format("--units: '{}' is none of {}", name, names_of_units(", ", ", ")));
  }
  chosen_[static_cast<std::size_t>(Kind::temperature_difference)] =
      chosen_[static_cast<std::size_t>(Kind::temperature)];
}

const ReaderUnit& ReaderUnits::unit(Kind kind) const {
  return units::reader_quantity(kind).units[chosen_[static_cast<std::size_t>(kind)]];
}

double ReaderUnits::value(units::Quantity quantity) const {
  const ReaderUnit& shown = unit(quantity.kind);
  return shown.factor * units::usual(quantity) + shown.offset;
}

std::string ReaderUnits::attributes() const {
  std::string out;
  for (const ReaderQuantity& quantity : units::reader_quantities()) {
    const std::size_t chosen = chosen_[static_cast<std::size_t>(quantity.kind)];
    const bool own = !quantity.units.front().asked.empty();  // that of temperature differences is the temperatures'
    if (own && chosen != 0) out += fmt::format(" data-{}-unit=\"{}\"", quantity.name, chosen);
  }
  return out;
}

std::string choice_of_units() {
  return names_of_units("|", ", ");
}

}  // namespace spoolflow::report
