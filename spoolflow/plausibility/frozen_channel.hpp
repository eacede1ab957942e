#pragma once
/// Channels that repeat one value to the last digit where a measured one changes.
#include <string>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// A channel that repeats one value for two fifths of a recording, and hardly ever repeats one in the rest: position,
/// current, voltage, force, pressure or flow. What drives it goes on meanwhile, and by three tenths of its range where
/// the value is the lowest or highest, at which an amplifier clips. A pressure and the current of one of two coils are
/// not named at zero, where pump or coil is off, and no channel whose resolution is coarse, which repeats values at
/// rest. `means` in blocks, as RunMeans and block_means() make them. Empty: none.
[[nodiscard]] std::string frozen_channel(const recording::Recording& means);

/// A channel of a run that stands still all along while what moves it does not: a coil's voltage while its current
/// changes or its current while its voltage does, the reference flow while the spool moves. Empty: none.
[[nodiscard]] std::string standing_channel(const recording::Recording& run, double stroke_m);

/// An oil temperature that repeats one value all along, of `means` of a recording of 30 s and more. Empty: not so.
[[nodiscard]] std::string frozen_oil_temperature(const recording::Recording& means);

/// The same of a recording that has no other one beside it: a value of whole or half degrees may be typed in or come
/// from a thermometer of that resolution, and is named only where it stands for three minutes.
[[nodiscard]] std::string frozen_oil_temperature_alone(const recording::Recording& means);

/// Changes of the oil temperature in a second, from one block of a recording to the next; 0 where there are none.
[[nodiscard]] double oil_temperature_changes_per_s(const recording::Recording& means);

}  // namespace spoolflow::plausibility
