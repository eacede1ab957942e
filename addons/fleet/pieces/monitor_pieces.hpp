#pragma once
/// `monitor`: a piece a recording, each from the state that the one before has left.
#include <functional>
#include <string>

#include "addons/fleet/jobs/piece.hpp"
#include "spoolflow/apps/elsewhere.hpp"

namespace spoolflow::apps {

/// For Elsewhere::monitor. Keeps a reference to the arguments.
[[nodiscard]] std::function<Watched(const std::string&)> monitor_by_fleet(const MonitorArguments& arguments);
/// The piece of kind "monitor".
[[nodiscard]] fleet::Outcome do_monitor_piece(const fleet::Piece& piece);

}  // namespace spoolflow::apps
