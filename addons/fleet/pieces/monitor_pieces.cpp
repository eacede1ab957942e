#include "addons/fleet/pieces/monitor_pieces.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "addons/fleet/jobs/contents.hpp"
#include "addons/fleet/pieces/fleet_work.hpp"
#include "addons/fleet/pieces/piece_kinds.hpp"
#include "addons/fleet/pieces/watch_text.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"

namespace spoolflow::apps {
namespace {

class MonitorByFleet {
 public:
  explicit MonitorByFleet(const MonitorArguments& arguments)
      : arguments_(arguments), fleet_(arguments.fleet, tool_version(), say_line) {
    if (std::ranges::count(arguments.recordings, "-") > 0)
      throw std::invalid_argument("--fleet sends whole recordings; name a file instead of -");
  }
  /// The next recording; what is known behind it.
  Watched next(const std::string& recording) {
    SentPiece piece{{.kind = "monitor"}};
    fleet_.add(piece, arguments_.model);
    fleet_.add(piece, recording);
    if (!arguments_.channels.empty()) fleet_.add(piece, arguments_.channels);
    if (!arguments_.baseline.empty()) fleet_.add(piece, arguments_.baseline);
    if (state_) FleetWork::add_kept(piece, "watched", *state_);
    piece.piece.arguments = fmt::format("{} {:d} {:d} {:d}", arguments_.false_alarms_per_year,
                                        !arguments_.channels.empty(), !arguments_.baseline.empty(), state_.has_value());
    fleet_.ask(std::move(piece));
    Watched out;
    fleet_.wait([&](std::size_t, const fleet::Outcome& outcome) {
      throw_failure(outcome);
      state_ = outcome.files.at(0);
      out = read_watched(fleet_.content(*state_));
    });
    return out;
  }

 private:
  const MonitorArguments& arguments_;
  FleetWork fleet_;
  std::optional<fleet::PieceFile> state_;
};

}  // namespace

std::function<Watched(const std::string&)> monitor_by_fleet(const MonitorArguments& arguments) {
  const auto fleet = std::make_shared<MonitorByFleet>(arguments);
  return [fleet](const std::string& recording) { return fleet->next(recording); };
}

fleet::Outcome do_monitor_piece(const fleet::Piece& piece) {
  std::istringstream arguments(piece.arguments);
  double false_alarms_per_year = 1;
  bool has_channels = false, has_baseline = false, goes_on = false;
  arguments >> false_alarms_per_year >> has_channels >> has_baseline >> goes_on;
  const model::Model model = model::read_model(path_of(piece, 0));
  std::size_t next = 2;
  recording::ChannelMap channels;
  if (has_channels) channels = recording::read_channel_map(path_of(piece, next++));
  const std::string baseline = has_baseline ? path_of(piece, next++) : std::string();
  monitor::Monitor watch(model, {false_alarms_per_year}, read_baseline(baseline));
  Watched watched;
  if (goes_on) {
    watched = read_watched(fleet::whole_file(path_of(piece, next)));
    if (!watch.set_state(watched.state)) throw fleet::PieceError("the state of a watch is of another version");
  }
  BandWatch band(watched.band);
  monitor_recording(model, path_of(piece, 1), channels, watch, watched.trend, band, [](std::optional<double>) {});
  watched.state = watch.state();
  watched.band = band.figures();
  constexpr const char* output = "watched";
  write_piece_file(output, bytes_of(watched));
  return {.files = {{output}}};
}

}  // namespace spoolflow::apps
