#pragma once
/// The valves of a site on a CAN bus: J1939 each 100 ms, CiA 408 in its period, answers to masters. Format:
/// docs/fieldbus.md.
#include <memory>

#include "addons/live/engine.hpp"

namespace spoolflow::live {

/// Sends from a thread of its own until it is destroyed. The engine must outlive it.
class CanSender {
 public:
  /// Throws SiteError where a port cannot be had.
  CanSender(Engine& engine, const CanSettings& settings);
  ~CanSender();
  CanSender(const CanSender&) = delete;
  CanSender& operator=(const CanSender&) = delete;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spoolflow::live
