#pragma once
/// The solenoid's iron: field over flux density with memory, by one of two models of hysteresis. Both take the flux
/// density as input, leave out rates (solenoid.hpp has them) and share nothing with the sensor's stop operators.
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/plant/jiles_atherton.hpp"
#include "spoolflow/rig/plant/magnetic_material.hpp"
#include "spoolflow/rig/plant/preisach.hpp"

namespace spoolflow::rig {

enum class HysteresisKind {
  jiles_atherton,  ///< walls lag behind the anhysteretic curve of magnetic_material.hpp; minor loops creep
  preisach         ///< relays, whose interaction fields make the curve; minor loops close
};

template <class Scalar>
struct MagneticHysteresisOf {
  HysteresisKind kind = HysteresisKind::preisach;
  Scalar coercive_field_A_per_m = 110.0;
  JilesAthertonOf<Scalar> jiles_atherton{};
  PreisachOf<Scalar> preisach{};

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"coercive_field_A_per_m", "A/m", 0, 600, "annealed low-carbon steel 60 to 200; 0 is lossless iron"},
          self.coercive_field_A_per_m);
    visit("jiles_atherton", self.jiles_atherton);
    visit("preisach", self.preisach);
  }
};
using MagneticHysteresis = MagneticHysteresisOf<double>;

/// The constants of the model that the solenoid has; the other's are not looked at.
template <class Scalar>
struct IronOf {
  HysteresisKind kind;
  JilesAthertonIronOf<Scalar> jiles_atherton;
  PreisachIronOf<Scalar> preisach;
};
using Iron = IronOf<double>;

template <class Scalar>
inline IronOf<Scalar> iron_of(const MagneticMaterialOf<Scalar>& material,
                              const MagneticHysteresisOf<Scalar>& hysteresis) {
  return {.kind = hysteresis.kind,
          .jiles_atherton = jiles_atherton_iron(material, hysteresis.jiles_atherton, hysteresis.coercive_field_A_per_m),
          .preisach = preisach_iron(material, hysteresis.preisach, hysteresis.coercive_field_A_per_m)};
}

/// What the iron remembers; {} is demagnetised.
template <class Scalar>
struct IronMemoryOf {
  Scalar flux_density_T = 0.0;
  Scalar field_A_per_m = 0.0;
  JilesAthertonMemoryOf<Scalar> jiles_atherton;
  PreisachMemoryOf<Scalar> preisach;
};
using IronMemory = IronMemoryOf<double>;

/// The field at a flux density reached monotonely, and its slope.
template <class Scalar>
inline FieldPointOf<Scalar> iron_field(const IronOf<Scalar>& iron, const IronMemoryOf<Scalar>& memory,
                                       Scalar flux_density_T) {
  if (iron.kind == HysteresisKind::preisach) return field_at(iron.preisach, memory.preisach, flux_density_T);
  return field_at(iron.jiles_atherton, memory.jiles_atherton, flux_density_T);
}

/// Moves the memory to a flux density reached monotonely; returns the work [J/m3] done on the iron, H dB. Over a cycle
/// it is what hysteresis loses; in between, part of it is stored. Of several valves, those that take it.
template <class Scalar>
inline Scalar magnetise(const IronOf<Scalar>& iron, IronMemoryOf<Scalar>& memory, Scalar flux_density_T,
                        const Given<Mask<Scalar>>& taken = true) {
  const Scalar change_T = flux_density_T - memory.flux_density_T;
  const Scalar before_A_per_m = memory.field_A_per_m;
  const Scalar field_A_per_m = iron.kind == HysteresisKind::preisach
                                   ? magnetise(iron.preisach, memory.preisach, flux_density_T, taken)
                                   : magnetise(iron.jiles_atherton, memory.jiles_atherton, flux_density_T, taken);
  take(taken, memory.flux_density_T, flux_density_T);
  take(taken, memory.field_A_per_m, field_A_per_m);
  return 0.5 * (before_A_per_m + field_A_per_m) * change_T;
}

}  // namespace spoolflow::rig
