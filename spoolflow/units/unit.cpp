#include "spoolflow/units/unit.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::units {
namespace {

struct Entry {
  const char* name;
  Dimension dimension;
  double scale;
  double offset;
  std::array<const char*, 6> spellings;  ///< in lower case
};

constexpr double per_minute = 1.0 / litre_per_minute_per_m3_per_s;

/// Spellings are compared in lower case: nobody writes oil pressures in millipascal or currents in megaampere.
const std::array<Entry, 23> entries{{
    {"s", Dimension::time, 1, 0, {"s", "sec", "second", "seconds"}},
    {"ms", Dimension::time, 1e-3, 0, {"ms", "millisecond", "milliseconds"}},
    {"us", Dimension::time, 1e-6, 0, {"us", "\xc2\xb5s", "\xce\xbcs", "\xb5s", "microseconds"}},
    {"A", Dimension::current, 1, 0, {"a", "amp", "ampere"}},
    {"mA", Dimension::current, 1e-3, 0, {"ma"}},
    {"V", Dimension::voltage, 1, 0, {"v", "volt", "volts"}},
    {"mV", Dimension::voltage, 1e-3, 0, {"mv"}},
    {"m", Dimension::length, 1, 0, {"m"}},
    {"mm", Dimension::length, 1e-3, 0, {"mm"}},
    {"um", Dimension::length, 1e-6, 0, {"um", "\xc2\xb5m", "\xce\xbcm", "\xb5m", "micron", "microns"}},
    {"percent", Dimension::ratio, 1e-2, 0, {"percent", "%", "pct"}},
    {"1", Dimension::ratio, 1, 0, {"1", "-"}},
    {"N", Dimension::force, 1, 0, {"n", "newton"}},
    {"kN", Dimension::force, 1e3, 0, {"kn"}},
    {"Pa", Dimension::pressure, 1, 0, {"pa", "pascal"}},
    {"kPa", Dimension::pressure, 1e3, 0, {"kpa"}},
    {"MPa", Dimension::pressure, 1e6, 0, {"mpa"}},
    {"bar", Dimension::pressure, pascal_per_bar, 0, {"bar"}},
    {"C",
     Dimension::temperature,
     1,
     kelvin_at_0_degC,
     {"c", "degc", "deg_c",
      "\xc2\xb0"
      "c",
      "\xb0"
      "c",
      "celsius"}},
    {"K", Dimension::temperature, 1, 0, {"k", "kelvin"}},
    {"L_min", Dimension::flow, per_minute, 0, {"l_min", "l/min", "lpm", "lmin", "ltr/min"}},
    {"L_s", Dimension::flow, 1e-3, 0, {"l_s", "l/s"}},
    {"m3_s", Dimension::flow, 1, 0, {"m3_s", "m3/s", "m^3/s", "m\xc2\xb3/s"}},
}};

bool spelt(const Entry& entry, const std::string& lower) {
  return std::any_of(entry.spellings.begin(), entry.spellings.end(),
                     [&](const char* spelling) { return spelling != nullptr && lower == spelling; });
}

}  // namespace

std::optional<Unit> unit_named(std::string_view spelling) {
  std::string lower;
  for (const char c : spelling) {
    if (c != ' ') lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return spelt(entry, lower); });
  if (found != entries.end()) return Unit{found->name, found->dimension, found->scale, found->offset};
  return std::nullopt;
}

std::string units_of(Dimension dimension) {
  std::string out;
  for (const Entry& entry : entries) {
    if (entry.dimension == dimension) out += (out.empty() ? "" : ", ") + std::string(entry.name);
  }
  return out;
}

std::string_view name(Dimension dimension) {
  switch (dimension) {
    case Dimension::time:
      return "time";
    case Dimension::current:
      return "current";
    case Dimension::voltage:
      return "voltage";
    case Dimension::length:
      return "length";
    case Dimension::ratio:
      return "ratio";
    case Dimension::force:
      return "force";
    case Dimension::pressure:
      return "pressure";
    case Dimension::temperature:
      return "temperature";
    case Dimension::flow:
      return "flow rate";
    case Dimension::none:
      break;
  }
  return "number";
}

}  // namespace spoolflow::units
