#include "spoolflow/units/reader_unit.hpp"

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::units {
namespace {

// NIST SP 811, appendix B.8: gallon (US) 3.785411784 L, psi 6894.757 Pa, inch 25.4 mm, pound-force 4.448222 N.
constexpr std::array<ReaderQuantity, kind_count> quantities{{
    {Kind::flow,
     "flow",
     "m3/s",
     true,
     {{{.asked = "L/min", .shown = "L/min", .decimals = 2},
       {.asked = "m3/h", .shown = "m\u00b3/h", .factor = 0.06, .decimals = 3},
       {.asked = "gal/min",
        .shown = "gal/min",
        .factor = 1 / 3.785411784,
        .decimals = 3,
        .full_name = "gal/min (US)"}}}},
    {Kind::pressure,
     "pressure",
     "Pa",
     true,
     {{{.asked = "bar", .shown = "bar", .decimals = 1},
       {.asked = "MPa", .shown = "MPa", .factor = 0.1, .decimals = 2},
       {.asked = "psi", .shown = "psi", .factor = 14.503773773, .decimals = 0}}}},
    {Kind::length,
     "position",
     "m",
     true,
     {{{.asked = "mm", .shown = "mm", .decimals = 3},
       {.asked = "um", .shown = "\u00b5m", .factor = 1000, .decimals = 0},
       {.asked = "in", .shown = "in", .factor = 1 / 25.4, .decimals = 4}}}},
    {Kind::force,
     "force",
     "N",
     true,
     {{{.asked = "N", .shown = "N", .decimals = 2},
       {.asked = "lbf", .shown = "lbf", .factor = 0.224808943, .decimals = 3},
       {}}}},
    {Kind::temperature,
     "temperature",
     {},  // K is that of differences
     true,
     {{{.asked = "C", .shown = "\u00b0C", .decimals = 1},
       {.asked = "F", .shown = "\u00b0F", .factor = 1.8, .offset = 32, .decimals = 1},
       {}}}},
    {Kind::temperature_difference,
     "temperature",  // as temperatures are asked for
     "K",
     false,
     {{{.shown = "K"}, {.shown = "\u00b0F", .factor = 1.8}, {}}}},
    {Kind::current, "current", "A", true, {{{.shown = "A", .decimals = 3}, {}, {}}}},
    {Kind::time, "time", "s", false, {{{.shown = "s"}, {}, {}}}},
    {Kind::voltage, "voltage", "V", true, {{{.shown = "V", .decimals = 2}, {}, {}}}},
}};

}  // namespace

std::span<const ReaderQuantity> reader_quantities() {
  return quantities;
}

const ReaderQuantity& reader_quantity(Kind kind) {
  return quantities[static_cast<std::size_t>(kind)];
}

double usual(Quantity quantity) {
  switch (quantity.kind) {
    case Kind::flow:
      return L_per_min_from_m3_per_s(quantity.value_SI);
    case Kind::pressure:
      return bar_from_Pa(quantity.value_SI);
    case Kind::length:
      return mm_from_m(quantity.value_SI);
    case Kind::temperature:
      return degC_from_K(quantity.value_SI);
    case Kind::force:
    case Kind::temperature_difference:
    case Kind::current:
    case Kind::time:
    case Kind::voltage:
      break;
  }
  return quantity.value_SI;
}

std::optional<Kind> kind_in(std::string_view unit) {
  if (unit.empty()) return std::nullopt;
  for (const ReaderQuantity& quantity : quantities) {
    if (unit == quantity.SI_unit || unit == quantity.units.front().shown) return quantity.kind;
  }
  return std::nullopt;
}

}  // namespace spoolflow::units
