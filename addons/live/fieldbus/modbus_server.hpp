#pragma once
/// Modbus TCP: the registers of docs/fieldbus.md for any client; nothing can be written.
#include <memory>

#include "addons/live/engine.hpp"

namespace spoolflow::live {

/// Whether this build has it.
[[nodiscard]] bool has_modbus();

/// Answers from a thread of its own until it is destroyed. The engine must outlive it.
class ModbusServer {
 public:
  /// Throws SiteError where it cannot listen there, or has_modbus() is false.
  ModbusServer(Engine& engine, const ModbusSettings& settings);
  ~ModbusServer();
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;
  [[nodiscard]] std::uint16_t port() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spoolflow::live
