#pragma once
/// Oil over temperature and pressure; HLP46 by default.
///
///     rho(T, p) = rho15 (1 - beta (T - 15 C)) (1 + p/K)
///     lg lg(nu + 0.7) = a - b lg T_K                          (Walther, ASTM D341; nu in mm2/s, two points give a, b)
///     mu(T, p) = rho nu exp(alpha p)                          (Barus)
///     1/K_eff = 1/(K20 + K_T (T - 20 C) + K_p p) + air p0/(p + p0)^2       (p gauge, p0 = 1.013 bar)
///
/// Valid -20 to 120 C, 0 to 400 bar.
#include <algorithm>

#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct OilOf {
  Scalar density_15C_kg_per_m3 = 876.0;
  Scalar thermal_expansion_per_K = 7.0e-4;
  Scalar viscosity_40C_m2_per_s = 46.0e-6;
  Scalar viscosity_100C_m2_per_s = 6.8e-6;
  Scalar pressure_viscosity_per_Pa = 1.8e-8;
  Scalar bulk_modulus_20C_Pa = 1.75e9;
  Scalar bulk_modulus_per_K_Pa = -7.5e6;
  Scalar bulk_modulus_per_pressure = 9.0;
  Scalar entrained_air = 0.005;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"density_15C_kg_per_m3", "kg/m3", 750, 1250, "mineral oil HLP46 870 to 885; esters up to 940"},
          self.density_15C_kg_per_m3);
    visit(Parameter{"thermal_expansion_per_K", "1/K", 5e-4, 9e-4, "mineral oil 6.5e-4 to 7.5e-4: 3 % over 50 K"},
          self.thermal_expansion_per_K);
    visit(Parameter{"viscosity_40C_m2_per_s", "m2/s", 9e-6, 200e-6, "ISO VG by definition, within 10 %"},
          self.viscosity_40C_m2_per_s);
    visit(Parameter{"viscosity_100C_m2_per_s", "m2/s", 2e-6, 8.9e-6, "viscosity index about 100 for HLP"},
          self.viscosity_100C_m2_per_s);
    visit(Parameter{"pressure_viscosity_per_Pa", "1/Pa", 0, 3e-8, "paraffinic mineral oil 1.5e-8 to 2.2e-8"},
          self.pressure_viscosity_per_Pa);
    visit(Parameter{"bulk_modulus_20C_Pa", "Pa", 1.0e9, 2.5e9, "adiabatic tangent, mineral oil 1.6e9 to 1.9e9"},
          self.bulk_modulus_20C_Pa);
    visit(Parameter{"bulk_modulus_per_K_Pa", "Pa/K", -9e6, 0, "mineral oil loses about 0.4 % per kelvin"},
          self.bulk_modulus_per_K_Pa);
    visit(Parameter{"bulk_modulus_per_pressure", "1", 0, 15, "mineral oil 8 to 11"}, self.bulk_modulus_per_pressure);
    visit(Parameter{"entrained_air", "1", 0, 0.05, "volume share at ambient pressure; a settled tank 0.3 to 1 %"},
          self.entrained_air);
  }
};
using Oil = OilOf<double>;

/// The oil at one temperature and ambient pressure; kept so that the logarithms are taken once a temperature.
template <class Scalar>
struct OilStateOf {
  Scalar temperature_C = 50.0;
  Scalar density_kg_per_m3 = 0.0;
  Scalar viscosity_m2_per_s = 0.0;
  Scalar bulk_modulus_Pa = 0.0;  ///< without air
};
using OilState = OilStateOf<double>;

/// Near the pour point Walther's line climbs without bound; the rig's oil gets no stiffer than this.
inline constexpr double stiffest_oil_m2_per_s = 0.05;

inline OilState oil_at(const Oil& oil, double temperature_C) {
  const auto walther = [](double viscosity_m2_per_s) {
    return decimal_logarithm(decimal_logarithm(viscosity_m2_per_s * 1e6 + 0.7));
  };
  const double lg_40 = decimal_logarithm(units::K_from_degC(40.0));
  const double lg_100 = decimal_logarithm(units::K_from_degC(100.0));
  const double w_40 = walther(oil.viscosity_40C_m2_per_s);
  const double b = (w_40 - walther(oil.viscosity_100C_m2_per_s)) / (lg_100 - lg_40);
  const double stiff = walther(stiffest_oil_m2_per_s);
  const double w = std::min(w_40 - b * (decimal_logarithm(units::K_from_degC(temperature_C)) - lg_40), stiff);
  return {.temperature_C = temperature_C,
          .density_kg_per_m3 = oil.density_15C_kg_per_m3 * (1.0 - oil.thermal_expansion_per_K * (temperature_C - 15.0)),
          .viscosity_m2_per_s = (power(10.0, power(10.0, w)) - 0.7) * 1e-6,
          .bulk_modulus_Pa = oil.bulk_modulus_20C_Pa + oil.bulk_modulus_per_K_Pa * (temperature_C - 20.0)};
}

template <class Scalar>
inline Scalar density_kg_per_m3(const OilOf<Scalar>& oil, const OilStateOf<Scalar>& state, Scalar pressure_Pa) {
  return state.density_kg_per_m3 *
         (1.0 + pressure_Pa / (state.bulk_modulus_Pa + oil.bulk_modulus_per_pressure * pressure_Pa));
}

template <class Scalar>
inline Scalar viscosity_m2_per_s(const OilOf<Scalar>& oil, const OilStateOf<Scalar>& state, Scalar pressure_Pa) {
  return state.viscosity_m2_per_s * exponential(oil.pressure_viscosity_per_Pa * pressure_Pa);
}

inline constexpr double ambient_pressure_Pa = 1.013e5;
/// Least gauge pressure a volume holds before it cavitates.
inline constexpr double cavitation_pressure_Pa = -0.95 * ambient_pressure_Pa;

/// 1/K_eff [1/Pa] of oil with entrained air at a gauge pressure.
template <class Scalar>
inline Scalar compressibility_per_Pa(const OilOf<Scalar>& oil, const OilStateOf<Scalar>& state, Scalar pressure_Pa) {
  const Scalar absolute = larger(pressure_Pa, Scalar(cavitation_pressure_Pa)) + ambient_pressure_Pa;
  const Scalar bulk_modulus_Pa =
      state.bulk_modulus_Pa + oil.bulk_modulus_per_pressure * larger(pressure_Pa, Scalar(0.0));
  const Scalar square = absolute * absolute;
  return (square + oil.entrained_air * ambient_pressure_Pa * bulk_modulus_Pa) / (bulk_modulus_Pa * square);
}

}  // namespace spoolflow::rig
