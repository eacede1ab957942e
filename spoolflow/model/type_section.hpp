#pragma once
/// What a model says of the type that its valve is one unit of.
#include <string>
#include <vector>

namespace spoolflow::model {

/// How units differ in one direction of physics, and where this one lies.
struct UnitDeviation {
  std::string name;    ///< "spring_rate", …
  std::string unit;    ///< "1" for shares, "m", or "ln" of a natural logarithm
  double tolerance;    ///< one standard deviation between units, > 0
  double value;        ///< of this unit against the type; 0 in a type's model
  double uncertainty;  ///< one standard deviation of it; the tolerance in a type's model
};

/// Entries of the environment, and of friction its breakaway_share, as they are of a unit that is known altogether; the
/// units' spread is added to them.
struct EnvironmentWithoutSpread {
  double force_N;
  double friction_share;
  double flow_share;
  double breakaway_share;  ///< 0 where the file states none
};

struct TypeSection {
  std::string name;   ///< of the type
  bool unit = false;  ///< the model is of one unit, calibrated from its own recordings; else of any of the type
  std::vector<UnitDeviation> deviations;
  std::vector<double> correlation;  ///< of what is known, row after row
  EnvironmentWithoutSpread environment{};
};

}  // namespace spoolflow::model
