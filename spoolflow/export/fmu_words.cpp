#include "spoolflow/export/fmu_words.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "spoolflow/export/fmu/number_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::exports {

namespace {

/// A display value is factor * value + offset.
struct DisplayUnit {
  std::string_view name;
  double factor;
  double offset = 0;
};

struct KnownUnit {
  std::string_view name;
  std::string_view base;  ///< attributes of BaseUnit; "none" where the exponents are no integers
  std::array<DisplayUnit, 2> display{};
};

const std::array<KnownUnit, 15> known_units{{
    {"s", R"( s="1")", {{{"ms", 1e3}}}},
    {"Hz", R"( s="-1")"},
    {"A", R"( A="1")"},
    {"V", R"( kg="1" m="2" s="-3" A="-1")"},
    {"m", R"( m="1")", {{{"mm", 1e3}, {"um", 1e6}}}},
    {"K", R"( K="1")", {{{"degC", 1, -units::K_from_degC(0)}}}},
    {"m3/s", R"( m="3" s="-1")", {{{"L/min", units::litre_per_minute_per_m3_per_s}}}},
    {"Pa", R"( kg="1" m="-1" s="-2")", {{{"bar", 1 / units::pascal_per_bar}}}},
    {"N", R"( kg="1" m="1" s="-2")"},
    {"m/K", R"( m="1" K="-1")", {{{"um/K", 1e6}}}},
    {"m/s", R"( m="1" s="-1")"},
    {"m/s2", R"( m="1" s="-2")"},
    {"Pa/s(1/2)", "none", {{{"bar/s(1/2)", 1 / units::pascal_per_bar}}}},
    {"Ohm/s(1/2)", "none"},
    {"1", ""},
}};

const KnownUnit& known_unit(std::string_view name) {
  const auto unit = std::ranges::find_if(known_units, [&](const KnownUnit& each) { return each.name == name; });
  if (unit == known_units.end()) throw std::logic_error("no definition of the unit " + std::string(name));
  return *unit;
}

}  // namespace

std::string_view base_unit(std::string_view unit) {
  return known_unit(unit).base;
}

std::string unit_definitions(const std::vector<fmu::Variable>& variables) {
  std::set<std::string_view> used;
  for (const fmu::Variable& variable : variables) {
    if (variable.unit.empty()) continue;
    const KnownUnit& unit = known_unit(variable.unit);
    if (!variable.display_unit.empty() && std::ranges::none_of(unit.display, [&](const DisplayUnit& each) {
          return each.name == variable.display_unit;
        })) {
      throw std::logic_error("no definition of the display unit " + variable.display_unit);
    }
    used.insert(unit.name);
  }
  std::string out = "  <UnitDefinitions>\n";
  for (const KnownUnit& unit : known_units) {
    if (!used.contains(unit.name)) continue;
    out += fmt::format("    <Unit name=\"{}\">\n", unit.name);
    if (unit.base != "none") out += fmt::format("      <BaseUnit{}/>\n", unit.base);
    for (const DisplayUnit& display : unit.display) {
      if (display.name.empty()) continue;
      const std::string offset = display.offset != 0 ? fmt::format(" offset=\"{}\"", display.offset) : "";
      out += fmt::format("      <DisplayUnit name=\"{}\" factor=\"{}\"{}/>\n", display.name, display.factor, offset);
    }
    out += "    </Unit>\n";
  }
  return out + "  </UnitDefinitions>\n";
}

using fmu::Causality;
using fmu::Variability;

const char* word(Causality causality) {
  static constexpr std::array words{"independent", "parameter", "input", "output"};
  return words.at(static_cast<std::size_t>(causality));
}

const char* word(Variability variability) {
  static constexpr std::array words{"fixed", "tunable", "discrete", "continuous"};
  return words.at(static_cast<std::size_t>(variability));
}

std::string initial(const fmu::Variable& variable) {
  if (variable.causality == Causality::parameter) return " initial=\"exact\"";
  if (variable.causality == Causality::output) return " initial=\"calculated\"";
  return {};
}

std::string limits(const fmu::Variable& variable) {
  std::string out;
  const auto add = [&](const char* name, double value) {
    if (value == value) out += fmt::format(" {}=\"{}\"", name, fmu::number_text(value));
  };
  add("min", variable.lowest);
  add("max", variable.highest);
  if (variable.type == fmu::Type::real) add("nominal", variable.nominal);
  return out;
}

std::string log_categories() {
  return "    <Category name=\"logStatusDiscard\" description=\"a step was refused, nothing has changed\"/>\n"
         "    <Category name=\"logStatusError\" description=\"a call could not be followed\"/>\n"
         "    <Category name=\"logStatusFatal\" description=\"the instance cannot be used any more\"/>\n";
}

}  // namespace spoolflow::exports
