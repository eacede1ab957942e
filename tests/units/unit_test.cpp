#include "spoolflow/units/unit.hpp"

#include <gtest/gtest.h>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::units {
namespace {

TEST(Unit, ConvertsToSiAsTheNamedConversionsDo) {
  EXPECT_DOUBLE_EQ(unit_named("bar")->to_SI(60.0), Pa_from_bar(60.0));
  EXPECT_DOUBLE_EQ(unit_named("L/min")->to_SI(80.0), m3_per_s_from_L_per_min(80.0));
  EXPECT_DOUBLE_EQ(unit_named("mm")->to_SI(2.4), m_from_mm(2.4));
  EXPECT_DOUBLE_EQ(unit_named("C")->to_SI(50.0), K_from_degC(50.0));
  EXPECT_DOUBLE_EQ(unit_named("mm2/s")->to_SI(46.0), m2_per_s_from_mm2_per_s(46.0));
  EXPECT_DOUBLE_EQ(unit_named("degF")->to_SI(212.0), K_from_degC(100.0));
  EXPECT_DOUBLE_EQ(unit_named("psi")->to_SI(1000.0), 6894757.293168361);
}

TEST(Unit, LeadsToSiAndBack) {
  for (const Unit& unit : all_units()) EXPECT_NEAR(unit.from_SI(unit.to_SI(12.5)), 12.5, 1e-9) << unit.name;
}

TEST(Unit, IsKnownByItsUsualSpellings) {
  const auto same = [](std::string_view written, std::string_view usual) {
    const auto unit = unit_named(written);
    ASSERT_TRUE(unit.has_value()) << written;
    EXPECT_EQ(unit->name, usual) << written;
  };
  for (const char* written : {"C", "degC", "°C",
                              "\xB0"
                              "C",
                              "deg C", "Celsius"})
    same(written, "C");
  for (const char* written : {"L/min", "l/min", "L_min", "l_min", "lpm", "L_per_min"}) same(written, "L/min");
  for (const char* written : {"um", "µm", "μm", "\xB5m"}) same(written, "um");
  for (const char* written : {"mm2/s", "mm^2/s", "mm²/s", "mm2_s", "cSt"}) same(written, "mm2/s");
  for (const char* written : {"m3/s", "m^3/s", "m³/s", "m3_s"}) same(written, "m3/s");
  for (const char* written : {"%", "percent"}) same(written, "percent");
  for (const char* written : {"us", "µs", " us "}) same(written, "us");
}

TEST(Unit, IsKnownAsMeasuringProgramsWriteIt) {
  const auto same = [](std::string_view written, std::string_view usual) {
    ASSERT_TRUE(unit_named(written).has_value()) << written;
    EXPECT_EQ(unit_named(written)->name, usual) << written;
  };
  same("Amps", "A"), same("Volts", "V"), same("Bar", "bar"), same("l/min", "L/min"), same("Liter/min", "L/min");
  same("Deg C", "C"), same("deg. C", "C"), same("Grad C", "C"), same("\u00b0C", "C"),
      same(
          "\xB0"
          "C",
          "C");
  same("Millimeter", "mm"), same("\u00b5m", "um"), same("Sek", "s"), same("%", "percent");
}

TEST(Unit, TakesCaseLightlyAndRefusesTheUnknown) {
  for (const char* written : {"MPa", "mpa", "MPA"}) EXPECT_DOUBLE_EQ(unit_named(written)->factor, 1e6) << written;
  for (const char* written : {"mA", "MA"}) EXPECT_DOUBLE_EQ(unit_named(written)->factor, 1e-3) << written;
  EXPECT_FALSE(unit_named("furlong").has_value());
  EXPECT_FALSE(unit_named("").has_value());
}

TEST(Unit, HasANameAndAHeaderThatNoOtherUnitHas) {
  for (const Unit& unit : all_units()) {
    EXPECT_EQ(unit_named(unit.name)->name, unit.name);
    EXPECT_EQ(unit_named(unit.header)->name, unit.name);
  }
}

}  // namespace
}  // namespace spoolflow::units
