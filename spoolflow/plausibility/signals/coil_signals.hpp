#pragma once
/// Current and voltage of a coil that no coil has: a scale that leaps, a zero that is off, a voltage that is another
/// one's.
#include <string>
#include <vector>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// A sentence for each coil whose voltage over current leaps by 3 % and more between two stretches of 12 s with
/// current: copper changes by 0.4 % a kelvin, and a coil warms by less than that in a second. `means` in blocks, as
/// RunMeans and block_means() make them; of blocks of more than 1.5 s nothing is said.
[[nodiscard]] std::vector<std::string> resistance_leaps(const recording::Recording& means);

/// A sentence for each coil whose current settles beyond 0.6 % of its largest value where it has had no voltage for
/// 0.3 s, for half a second together at least, and no such voltage drives that current.
[[nodiscard]] std::vector<std::string> currents_without_voltage(const recording::Recording& means);

/// One sentence where a coil's voltage keeps within 5 % while its current goes by a factor of 1.5 and more: the
/// supply's. Empty: none.
[[nodiscard]] std::string supply_voltage(const recording::Recording& means);

}  // namespace spoolflow::plausibility
