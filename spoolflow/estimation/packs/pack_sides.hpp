#pragma once
/// Whole valves side by side: each lane has a model of either direction, and of these the one on whose side its spool
/// stands is at work. The models of all lanes are put together anew only when a spool has changed sides.
#include "spoolflow/estimation/packs/pack_tables.hpp"
#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"

namespace spoolflow::estimation::packs {

/// Both directions of several valves; `Parameters` of one direction are made of packs. Not to be moved.
template <class Register, int Count, class Parameters>
struct PackSides {
  Parameters b;  ///< flow P to B
  Parameters a;
  Parameters open;  ///< of the side on which each valve's spool stands
  Parameters idle;
  PackMask<Register, Count> opens_a;  ///< as `open` and `idle` are put together

  /// To be called when b and a are there.
  void begin() {
    open = b;
    idle = a;
    opens_a = PackMask<Register, Count>(false);
  }
  void turn(const PackMask<Register, Count>& now) {
    if (!any((now && !opens_a) || (opens_a && !now))) return;
    begin();
    keep(now, a, open);
    keep(now, b, idle);
    opens_a = now;
  }
};

template <class Register, int Count>
using ObserverSides = PackSides<Register, Count, sensor::ObserverParameters<ValvePack<Register, Count>>>;
template <class Register, int Count>
using CondensedSides = PackSides<Register, Count, sensor::CondensedTables<ValvePack<Register, Count>>>;

}  // namespace spoolflow::estimation::packs

template <class Register, int Count>
struct spoolflow::sensor::WholeValveParameters<spoolflow::estimation::packs::ValvePack<Register, Count>> {
  using Parameters = ObserverParameters<spoolflow::estimation::packs::ValvePack<Register, Count>>;
  const Parameters* b;
  const Parameters* a;
  spoolflow::estimation::packs::ObserverSides<Register, Count>* sides;
};

template <class Register, int Count>
struct spoolflow::sensor::WholeCondensedTables<spoolflow::estimation::packs::ValvePack<Register, Count>> {
  spoolflow::estimation::packs::CondensedSides<Register, Count>* sides;
};

namespace spoolflow::estimation::packs {

/// What sensor::step of a whole valve asks for, found by its arguments.
template <class Register, int Count>
sensor::detail::Sides<ValvePack<Register, Count>> sides(
    const sensor::WholeValveParameters<ValvePack<Register, Count>>& valve, const PackMask<Register, Count>& opens_a) {
  valve.sides->turn(opens_a);
  return {valve.sides->open, valve.sides->idle};
}

template <class Register, int Count>
const sensor::CondensedTables<ValvePack<Register, Count>>& of_side(
    const sensor::WholeCondensedTables<ValvePack<Register, Count>>& valve, const PackMask<Register, Count>& opens_a) {
  valve.sides->turn(opens_a);
  return valve.sides->open;
}

}  // namespace spoolflow::estimation::packs
