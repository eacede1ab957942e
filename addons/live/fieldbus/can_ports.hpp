#pragma once
/// Where CAN frames go: SocketCAN, log files, python-can's UDP multicast. None ever waits for a peer.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "addons/live/fieldbus_settings.hpp"
#include "spoolflow/sensor/fieldbus/can_answer.hpp"

namespace spoolflow::live {

class CanPort {
 public:
  CanPort() = default;
  virtual ~CanPort() = default;
  CanPort(const CanPort&) = delete;
  CanPort& operator=(const CanPort&) = delete;

  /// False where it found no room, or the port is not to be had at present: trouble() says why.
  virtual bool send(const sensor::CanFrame& frame, double time_s) = 0;
  /// The next frame of others; nothing where none has come.
  virtual std::optional<sensor::CanFrame> receive() { return std::nullopt; }
  /// Once a second: writes what it holds back, opens again what was lost. True where a bus that was lost is back.
  virtual bool look_after() { return false; }
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 protected:
  std::string trouble_;
};

/// Throws SiteError where one cannot be had.
[[nodiscard]] std::vector<std::unique_ptr<CanPort>> open_can_ports(const CanSettings& settings);

}  // namespace spoolflow::live
