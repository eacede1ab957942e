#pragma once
/// Named conversions between the SI units that every computation uses and the units that people read.

namespace spoolflow::units {

inline constexpr double pascal_per_bar = 1e5;
inline constexpr double litre_per_minute_per_m3_per_s = 60000.0;
inline constexpr double millimetre_per_metre = 1e3;
inline constexpr double kelvin_at_0_degC = 273.15;
inline constexpr double m2_per_s_per_mm2_per_s = 1e-6;

constexpr double Pa_from_bar(double pressure_bar) {
  return pressure_bar * pascal_per_bar;
}
constexpr double bar_from_Pa(double pressure_Pa) {
  return pressure_Pa / pascal_per_bar;
}
constexpr double m3_per_s_from_L_per_min(double flow_L_per_min) {
  return flow_L_per_min / litre_per_minute_per_m3_per_s;
}
constexpr double L_per_min_from_m3_per_s(double flow_m3_per_s) {
  return flow_m3_per_s * litre_per_minute_per_m3_per_s;
}
constexpr double m_from_mm(double length_mm) {
  return length_mm / millimetre_per_metre;
}
constexpr double mm_from_m(double length_m) {
  return length_m * millimetre_per_metre;
}
constexpr double K_from_degC(double temperature_C) {
  return temperature_C + kelvin_at_0_degC;
}
constexpr double degC_from_K(double temperature_K) {
  return temperature_K - kelvin_at_0_degC;
}
constexpr double m2_per_s_from_mm2_per_s(double viscosity_mm2_per_s) {
  return viscosity_mm2_per_s * m2_per_s_per_mm2_per_s;
}

}  // namespace spoolflow::units
