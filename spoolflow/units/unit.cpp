#include "spoolflow/units/unit.hpp"

#include <array>
#include <string>
#include <utility>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::units {
namespace {

// Factors of the SI brochure; psi, degF, inch, lbf, kgf and US gallons by NIST SP 811, appendix B.8.
constexpr std::array<Unit, 42> table{{
    {"1", "1", Dimension::ratio, 1.0},
    {"percent", "percent", Dimension::ratio, 0.01},
    {"s", "s", Dimension::time, 1.0},
    {"ms", "ms", Dimension::time, 1e-3},
    {"us", "us", Dimension::time, 1e-6},
    {"ns", "ns", Dimension::time, 1e-9},
    {"min", "min", Dimension::time, 60.0},
    {"h", "h", Dimension::time, 3600.0},
    {"A", "A", Dimension::current, 1.0},
    {"mA", "mA", Dimension::current, 1e-3},
    {"V", "V", Dimension::voltage, 1.0},
    {"mV", "mV", Dimension::voltage, 1e-3},
    {"mm", "mm", Dimension::length, 1e-3},
    {"um", "um", Dimension::length, 1e-6},
    {"m", "m", Dimension::length, 1.0},
    {"in", "in", Dimension::length, 0.0254},
    {"mil", "mil", Dimension::length, 2.54e-5},
    {"N", "N", Dimension::force, 1.0},
    {"kN", "kN", Dimension::force, 1e3},
    {"kgf", "kgf", Dimension::force, 9.80665},
    {"lbf", "lbf", Dimension::force, 4.4482216152605},
    {"bar", "bar", Dimension::pressure, pascal_per_bar},
    {"mbar", "mbar", Dimension::pressure, 100.0},
    {"Pa", "Pa", Dimension::pressure, 1.0},
    {"kPa", "kPa", Dimension::pressure, 1e3},
    {"MPa", "MPa", Dimension::pressure, 1e6},
    {"psi", "psi", Dimension::pressure, 6894.757293168361},
    {"kgf/cm2", "kgf_cm2", Dimension::pressure, 98066.5},
    {"C", "C", Dimension::temperature, 1.0, kelvin_at_0_degC},
    {"K", "K", Dimension::temperature, 1.0},
    {"degF", "degF", Dimension::temperature, 5.0 / 9.0, kelvin_at_0_degC - 32.0 * 5.0 / 9.0},
    {"L/min", "L_min", Dimension::volume_flow, 1.0 / litre_per_minute_per_m3_per_s},
    {"L/s", "L_s", Dimension::volume_flow, 1e-3},
    {"m3/s", "m3_s", Dimension::volume_flow, 1.0},
    {"m3/h", "m3_h", Dimension::volume_flow, 1.0 / 3600.0},
    {"L/h", "L_h", Dimension::volume_flow, 1e-3 / 3600.0},
    {"mL/min", "mL_min", Dimension::volume_flow, 1e-6 / 60.0},
    {"gal/min", "gal_min", Dimension::volume_flow, 3.785411784e-3 / 60.0},
    {"mm2/s", "mm2_s", Dimension::kinematic_viscosity, m2_per_s_per_mm2_per_s},
    {"m2/s", "m2_s", Dimension::kinematic_viscosity, 1.0},
    {"kg/m3", "kg_m3", Dimension::density, 1.0},
    {"g/cm3", "g_cm3", Dimension::density, 1e3},
}};

// Other spellings, in small letters, after plain() has brought them to ASCII.
constexpr std::array<std::pair<std::string_view, std::string_view>, 101> spellings{{
    {"-", "1"},
    {"%", "percent"},
    {"pct", "percent"},
    {"sec", "s"},
    {"second", "s"},
    {"seconds", "s"},
    {"msec", "ms"},
    {"milliseconds", "ms"},
    {"microseconds", "us"},
    {"nsec", "ns"},
    {"minute", "min"},
    {"minutes", "min"},
    {"hour", "h"},
    {"hours", "h"},
    {"nanoseconds", "ns"},
    {"amp", "A"},
    {"ampere", "A"},
    {"volt", "V"},
    {"volts", "V"},
    {"micron", "um"},
    {"microns", "um"},
    {"inch", "in"},
    {"inches", "in"},
    {"\"", "in"},
    {"thou", "mil"},
    {"mils", "mil"},
    {"newton", "N"},
    {"lb", "lbf"},
    {"lbs", "lbf"},
    {"kp", "kgf"},
    {"kg/cm2", "kgf/cm2"},
    {"kgf/cm^2", "kgf/cm2"},
    {"gpm", "gal/min"},
    {"usgpm", "gal/min"},
    {"us gpm", "gal/min"},
    {"us gal/min", "gal/min"},
    {"l/hr", "L/h"},
    {"lph", "L/h"},
    {"cm3/min", "mL/min"},
    {"ccm/min", "mL/min"},
    {"cc/min", "mL/min"},
    {"pascal", "Pa"},
    {"degc", "C"},
    {"deg c", "C"},
    {"deg_c", "C"},
    {"celsius", "C"},
    {"kelvin", "K"},
    {"degk", "K"},
    {"f", "degF"},
    {"deg f", "degF"},
    {"fahrenheit", "degF"},
    {"lpm", "L/min"},
    {"lmin", "L/min"},
    {"ltr/min", "L/min"},
    {"dm3/min", "L/min"},
    {"l_per_min", "L/min"},
    {"dm3/s", "L/s"},
    {"l_per_s", "L/s"},
    {"m3_per_s", "m3/s"},
    {"m3_per_h", "m3/h"},
    {"cst", "mm2/s"},
    {"mm2_per_s", "mm2/s"},
    {"m2_per_s", "m2/s"},
    {"kg_per_m3", "kg/m3"},
    {"g_per_cm3", "g/cm3"},
    {"amps", "A"},
    {"amperes", "A"},
    {"milliampere", "mA"},
    {"milliamps", "mA"},
    {"millivolt", "mV"},
    {"millimeter", "mm"},
    {"millimetre", "mm"},
    {"millimeters", "mm"},
    {"micrometer", "um"},
    {"meter", "m"},
    {"metre", "m"},
    {"newtons", "N"},
    {"pascals", "Pa"},
    {"sek", "s"},
    {"sekunden", "s"},
    {"s.", "s"},
    {"sec.", "s"},
    {"millisekunden", "ms"},
    {"msek", "ms"},
    {"mikrosekunden", "us"},
    {"usec", "us"},
    {"deg. c", "C"},
    {"grad c", "C"},
    {"grad celsius", "C"},
    {"degrees c", "C"},
    {"degree celsius", "C"},
    {"degrees celsius", "C"},
    {"deg celsius", "C"},
    {"prozent", "percent"},
    {"percents", "percent"},
    {"liter/min", "L/min"},
    {"litre/min", "L/min"},
    {"liters/min", "L/min"},
    {"l/minute", "L/min"},
    {"l/sec", "L/s"},
    {"bars", "bar"},
}};

/// ASCII for the signs that units are written with: degree, micro, powers of two and three; spaces at the ends dropped.
std::string plain(std::string_view written) {
  while (!written.empty() && (written.front() == ' ' || written.front() == '\t')) written.remove_prefix(1);
  while (!written.empty() && (written.back() == ' ' || written.back() == '\t')) written.remove_suffix(1);
  constexpr std::array<std::pair<std::string_view, std::string_view>, 11> signs{{
      {"\xC2\xB0", "deg"},  // degree sign, UTF-8
      {"\xC2\xBA", "deg"},  // masculine ordinal, often typed for a degree sign
      {"\xC2\xB5", "u"},    // micro sign
      {"\xCE\xBC", "u"},    // Greek mu
      {"\xC2\xB2", "2"},    // superscript two
      {"\xC2\xB3", "3"},    // superscript three
      {"\xB0", "deg"},      // the same in Latin-1
      {"\xB5", "u"},
      {"\xB2", "2"},
      {"\xB3", "3"},
      {"^", ""},
  }};
  std::string out;
  for (std::size_t at = 0; at < written.size();) {
    bool replaced = false;
    for (const auto& [sign, letters] : signs) {
      if (written.substr(at).starts_with(sign)) {
        out += letters;
        at += sign.size();
        replaced = true;
        break;
      }
    }
    if (!replaced) out += written[at++];
  }
  return out;
}

std::string in_small_letters(std::string_view text) {
  std::string out;
  for (const char c : text) out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

}  // namespace

std::string_view name(Dimension dimension) {
  constexpr std::array<std::string_view, 11> names{
      "ratio",  "time",     "current",     "voltage",     "length",
      "force",  "pressure", "temperature", "volume flow", "kinematic viscosity",
      "density"};
  return names[static_cast<std::size_t>(dimension)];
}

std::span<const Unit> all_units() {
  return table;
}

std::optional<Unit> unit_named(std::string_view written) {
  const std::string text = plain(written);
  for (const Unit& unit : table) {
    if (text == unit.name || text == unit.header) return unit;
  }
  std::string small = in_small_letters(text);
  for (const auto& [other, usual] : spellings) {
    if (small == other) small = in_small_letters(usual);
  }
  for (const Unit& unit : table) {
    if (small == in_small_letters(unit.name) || small == in_small_letters(unit.header)) return unit;
  }
  return std::nullopt;
}

}  // namespace spoolflow::units
