/// The units of pages against the units of recordings, which are tabled apart.
#include "spoolflow/units/reader_unit.hpp"

#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "spoolflow/units/unit.hpp"

namespace spoolflow::units {
namespace {

/// The same unit as recordings write it; to SI by exact definitions where they know none.
double to_SI(Kind kind, const ReaderUnit& unit, double value) {
  constexpr double litre_m3 = 1e-3, minute_s = 60, inch_m = 0.0254;
  if (unit.asked == "gal/min") return value * 231 * inch_m * inch_m * inch_m / minute_s;
  if (unit.asked == "in") return value * inch_m;
  if (unit.asked == "lbf") return value * 0.45359237 * 9.80665;
  if (unit.asked == "L/min") return value * litre_m3 / minute_s;
  if (kind == Kind::temperature_difference) return unit.factor == 1 ? value : value / 1.8;
  return unit_named(unit.shown)->to_SI(value);
}

TEST(ReaderUnit, LeadsToSiAndBackInEveryUnitOfEveryQuantity) {
  for (const ReaderQuantity& quantity : reader_quantities()) {
    ASSERT_GE(quantity.count(), 1U);
    for (std::size_t k = 0; k < quantity.count(); ++k) {
      const ReaderUnit& unit = quantity.units[k];
      for (const double shown : {-7.5, 0.0, 123.25}) {
        const double back = unit.factor * usual({quantity.kind, to_SI(quantity.kind, unit, shown)}) + unit.offset;
        EXPECT_NEAR(back, shown, 2e-7 * std::abs(shown) + 1e-9) << quantity.name << " in " << unit.shown;
      }
    }
  }
}

TEST(ReaderUnit, OfEveryKindComesFirstAsTheUsualOne) {
  for (std::size_t k = 0; k < kind_count; ++k) {
    const auto kind = static_cast<Kind>(k);
    EXPECT_EQ(reader_quantity(kind).kind, kind);
    EXPECT_EQ(reader_quantity(kind).units.front().factor, 1);
    EXPECT_EQ(reader_quantity(kind).units.front().offset, 0);
  }
}

TEST(ReaderUnit, IsAskedForByANameOfItsOwn) {
  std::map<std::string_view, int> asked;
  for (const ReaderQuantity& quantity : reader_quantities()) {
    for (const ReaderUnit& unit : quantity.units) ++asked[unit.asked];
  }
  asked.erase("");
  for (const auto& [name, times] : asked) EXPECT_EQ(times, 1) << name;
}

TEST(ReaderUnit, IsFoundByTheUnitsOfModels) {
  EXPECT_EQ(kind_in("m3/s"), Kind::flow);
  EXPECT_EQ(kind_in("L/min"), Kind::flow);
  EXPECT_EQ(kind_in("Pa"), Kind::pressure);
  EXPECT_EQ(kind_in("N"), Kind::force);
  EXPECT_EQ(kind_in("K"), Kind::temperature_difference);
  for (const char* other : {"%", "um", "mA", ""}) EXPECT_FALSE(kind_in(other).has_value()) << other;
}

}  // namespace
}  // namespace spoolflow::units
