#include "spoolflow/report/text/quantity_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

std::string in_usual_unit(const QuantityText& text) {
  const double value = units::usual(text.quantity);
  switch (text.digits) {
    case Digits::fixed:
      return fixed(value, text.decimals);
    case Digits::signed_fixed:
      return signed_fixed(value, text.decimals);
    case Digits::two:
      return two_digits(value);
    case Digits::three:
      return three_digits(value);
    case Digits::general:
      break;
  }
  return fmt::format("{:g}", value);
}

/// Of a number as written; nothing has none.
int decimals_of(const std::string& number) {
  const std::size_t point = number.find('.');
  return point == std::string::npos ? 0 : static_cast<int>(number.size() - point - 1);
}

std::string number_of(const QuantityText& text, const ReaderUnits& reader) {
  std::string usual = in_usual_unit(text);
  const units::ReaderUnit& unit = reader.unit(text.quantity.kind);
  if (unit.factor == 1 && unit.offset == 0) return usual;
  const double value = reader.value(text.quantity);
  if (usual.find('e') != std::string::npos) return fmt::format("{:.2e}", value);
  const int shift = static_cast<int>(std::lround(std::log10(unit.factor)));
  const int decimals = std::clamp(decimals_of(usual) - shift, 0, 9);
  return text.digits == Digits::signed_fixed ? signed_fixed(value, decimals) : fixed(value, decimals);
}

}  // namespace

std::string QuantityText::in(const ReaderUnits& units) const {
  std::string out = number_of(*this, units);
  if (with_unit) out.append(" ").append(units.unit(quantity.kind).shown);
  return out;
}

}  // namespace spoolflow::report
