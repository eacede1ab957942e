#pragma once
/// A quantity as it is to be read, its unit still open. Digits are given for the usual unit; in another there are about
/// as many, never fewer.
#include <string>

#include "spoolflow/report/text/reader_units.hpp"
#include "spoolflow/units/quantity.hpp"

namespace spoolflow::report {

/// See number_text.hpp; `general`: up to six digits, as people write a limit ("15", "0.5").
enum class Digits { fixed, signed_fixed, two, three, general };

struct QuantityText {
  units::Quantity quantity;
  Digits digits;
  int decimals = 0;       ///< of the fixed ones
  bool with_unit = true;  ///< else the number alone

  [[nodiscard]] std::string in(const ReaderUnits& units) const;
};

[[nodiscard]] constexpr QuantityText fixed(units::Quantity quantity, int decimals) {
  return {quantity, Digits::fixed, decimals};
}
[[nodiscard]] constexpr QuantityText signed_fixed(units::Quantity quantity, int decimals) {
  return {quantity, Digits::signed_fixed, decimals};
}
[[nodiscard]] constexpr QuantityText two_digits(units::Quantity quantity) {
  return {quantity, Digits::two};
}
[[nodiscard]] constexpr QuantityText three_digits(units::Quantity quantity) {
  return {quantity, Digits::three};
}
[[nodiscard]] constexpr QuantityText general(units::Quantity quantity) {
  return {quantity, Digits::general};
}
/// The number alone, where the unit stands elsewhere: "5 to 70 bar".
[[nodiscard]] constexpr QuantityText bare(QuantityText text) {
  text.with_unit = false;
  return text;
}

}  // namespace spoolflow::report
