#pragma once
/// What an FMU shows of itself: each variable is described once, for modelDescription.xml and for the running instance.
#ifndef __cpp_concepts
#error "the sources of this FMU are C++20: compile them with -std=c++20; in CMake -DCMAKE_CXX_STANDARD=20"
#endif
#include <limits>
#include <string>

namespace spoolflow::exports::fmu {

enum class Causality { independent, parameter, input, output };
enum class Variability { fixed, tunable, discrete, continuous };
enum class Type { real, integer, boolean };

inline constexpr double no_limit = std::numeric_limits<double>::quiet_NaN();

/// The place in the list is the value reference; every value is kept as a double.
struct Variable {
  std::string name;
  std::string description;
  Causality causality = Causality::input;
  Variability variability = Variability::continuous;
  Type type = Type::real;
  std::string unit{};          ///< a name of known_units; empty: none
  std::string display_unit{};  ///< a display unit of that unit; empty: none
  double start = 0;            ///< of parameters and inputs
  double lowest = no_limit;
  double highest = no_limit;
  double nominal = no_limit;  ///< the size that the value usually has
  int derivative_of = -1;     ///< in time, of the variable at that place; -1: of none
};

/// A real input; `start` and `nominal` in the unit.
inline Variable input(const char* name, const char* description, const char* unit, const char* display_unit,
                      double start, double nominal) {
  return {.name = name,
          .description = description,
          .causality = Causality::input,
          .variability = Variability::continuous,
          .unit = unit,
          .display_unit = display_unit,
          .start = start,
          .nominal = nominal};
}

/// A real output; `nominal` in the unit.
inline Variable output(const char* name, const char* description, const char* unit, const char* display_unit,
                       double nominal) {
  return {.name = name,
          .description = description,
          .causality = Causality::output,
          .variability = Variability::continuous,
          .unit = unit,
          .display_unit = display_unit,
          .nominal = nominal};
}

}  // namespace spoolflow::exports::fmu
