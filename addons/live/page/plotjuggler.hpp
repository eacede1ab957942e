#pragma once
/// The plots of all valves as JSON over UDP, as PlotJuggler's "UDP Server" with message protocol "json" reads them.
/// Format: docs/live.md.
#include <cstdint>
#include <memory>
#include <string>

#include "addons/live/engine.hpp"

namespace spoolflow::live {

/// One datagram: {"timestamp": .., ID: {"time_s": .., "flow_min_L_min": .., ..}}; what is not known is left out.
[[nodiscard]] std::string plotjuggler_message(const std::string& valve, const PlotPoint& point,
                                              monitor::Ne107 condition, double timestamp_s);

/// Sends from a thread of its own until it is destroyed; nobody need listen. The engine must outlive it.
class PlotJuggler {
 public:
  /// Throws SiteError where nothing can be sent to that address.
  PlotJuggler(const Engine& engine, const Address& to);
  ~PlotJuggler();
  PlotJuggler(const PlotJuggler&) = delete;
  PlotJuggler& operator=(const PlotJuggler&) = delete;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spoolflow::live
