#pragma once
/// The work of the commands `estimate`, `calibrate`, `monitor` and `analyse` as pieces on a fleet's workers.

namespace spoolflow::apps {

/// From now on `--fleet` of each command sends its pieces to the fleet, and this program does pieces of each kind.
void give_work_to_fleets();

}  // namespace spoolflow::apps
