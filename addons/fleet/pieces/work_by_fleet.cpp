#include "addons/fleet/pieces/work_by_fleet.hpp"

#include <memory>
#include <string>

#include "addons/fleet/pieces/calibrate_pieces.hpp"
#include "addons/fleet/pieces/estimate_pieces.hpp"
#include "addons/fleet/pieces/monitor_pieces.hpp"
#include "addons/fleet/pieces/piece_kinds.hpp"
#include "addons/fleet/pieces/study_pieces.hpp"
#include "spoolflow/apps/elsewhere.hpp"
#include "spoolflow/apps/tool_version.hpp"

namespace spoolflow::apps {

void give_work_to_fleets() {
  elsewhere() = {estimate_by_fleet, calibrate_by_fleet, study_by_fleet, monitor_by_fleet};
  add_piece_kind("estimate", do_estimate_piece);
  add_piece_kind("calibrate", do_calibrate_piece);
  add_piece_kind("monitor", do_monitor_piece);
  add_piece_kind("study", [](const fleet::Piece& piece) { return do_study_piece(piece, std::string(tool_version())); });
}

}  // namespace spoolflow::apps
