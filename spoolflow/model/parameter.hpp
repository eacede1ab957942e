#pragma once
/// How a number of a valve is described: once, with everything that JSON, FMU, C++ export, load check and documentation
/// need to know of it. To add one, give it a member in a structure of spoolflow/sensor and one call in
/// describe_observer.hpp or describe_condensed.hpp; `otherwise` lets files without it be read. What runs show of a
/// number, or of a constant of the sensor, stands in tuning_evidence.csv, which `bench/tuning_evidence.py --update`
/// writes. Then `ci/parameters_page.sh` writes docs/formats/parameters.md again.
#include <limits>
#include <optional>
#include <string>

namespace spoolflow::model {

/// Both belong to what is allowed.
struct Limits {
  double lowest;
  double highest;
};

/// What holds beside the limits, because an equation relies on it.
struct Relation {
  enum class Kind {
    none,
    rises,            ///< of a list: each entry lies above the one before
    rises_over_rows,  ///< of a map: each row lies above the one before, by no less than `least` of the largest entry
    never_falls,      ///< of a map: nowhere does it fall along a row
    alike,            ///< of a curve: no entry is more than `least` times its neighbour
    not_above,        ///< of a number: not larger than `other`
    sum_not_negative  ///< of a list: with the entry of `other` added, not below zero
  };
  Kind kind = Kind::none;
  const char* other = "";
  double least = 0;
};

inline constexpr Relation rises{Relation::Kind::rises};
inline constexpr Relation never_falls{Relation::Kind::never_falls};
constexpr Relation rises_over_rows(double least) {
  return {Relation::Kind::rises_over_rows, "", least};
}
constexpr Relation alike(double most) {
  return {Relation::Kind::alike, "", most};
}
constexpr Relation not_above(const char* other) {
  return {Relation::Kind::not_above, other};
}
constexpr Relation sum_not_negative(const char* other) {
  return {Relation::Kind::sum_not_negative, other};
}

/// A number, or each number of a list.
struct Parameter {
  const char* key;  ///< as in the model file, unit included
  const char* unit;
  Limits limits;
  const char* meaning;
  Relation relation{};
  std::optional<double> otherwise{};  ///< what a file that does not give it is read with
};

/// An axis of a table: its points rise in equal steps and end above zero.
struct AxisParameter {
  const char* key;
  const char* unit;
  Limits limits;
  double least_step = 0;  ///< between its points; no slope of a table is steeper than its limits over this
};

/// A curve, a map or a volume.
struct TableParameter {
  const char* key;
  const char* unit;
  Limits limits;
  const char* meaning;
  AxisParameter rows{"", "", {0, 0}, 0};     ///< of a map; a curve has no rows, a volume's axes stand beside it
  AxisParameter columns{"", "", {0, 0}, 0};  ///< of a map or curve
  Relation relation{};
};

}  // namespace spoolflow::model
