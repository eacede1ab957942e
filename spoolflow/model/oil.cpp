#include "spoolflow/model/oil.hpp"

#include <cmath>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::model {

double viscosity_m2_per_s(const Fluid& fluid, double oil_temperature_K) {
  constexpr double of_hlp46_40C_m2_per_s = 46e-6, of_hlp46_100C_m2_per_s = 6.8e-6;
  const double at_40C = fluid.viscosity_40C_m2_per_s.value_or(0), at_100C = fluid.viscosity_100C_m2_per_s.value_or(0);
  const bool given = at_100C > 0 && at_40C > at_100C;
  const auto twice_log = [](double viscosity_m2_per_s) {
    return std::log10(std::log10(viscosity_m2_per_s / units::m2_per_s_per_mm2_per_s + 0.7));
  };
  const double warm = twice_log(given ? at_40C : of_hlp46_40C_m2_per_s),
               hot = twice_log(given ? at_100C : of_hlp46_100C_m2_per_s);
  const double warm_K = units::K_from_degC(40), hot_K = units::K_from_degC(100);
  const double twice = warm + (hot - warm) * std::log10(oil_temperature_K / warm_K) / std::log10(hot_K / warm_K);
  return units::m2_per_s_from_mm2_per_s(std::pow(10.0, std::pow(10.0, twice)) - 0.7);
}

}  // namespace spoolflow::model
