#pragma once
/// A CANopen device after CiA 301 and CiA 408 that sends a valve's flow: object dictionary, SDO reads, heartbeat, NMT.
/// Objects: docs/fieldbus.md; for masters docs/fieldbus/spoolflow.eds, which eds_text() writes.
#include <optional>
#include <string>
#include <vector>

#include "addons/live/protocols/plant_answer.hpp"

namespace spoolflow::fieldbus {

enum class CanopenType : std::uint16_t { integer16 = 3, integer32 = 4, unsigned8 = 5, unsigned16 = 6, unsigned32 = 7 };
/// In bytes.
[[nodiscard]] unsigned size_of(CanopenType type);

/// One entry of the object dictionary; all are read-only, but what CiA 301 wants writable is const here.
struct CanopenObject {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  CanopenType type = CanopenType::unsigned8;
  const char* object = "";  ///< name of the record, or of the variable
  const char* name = "";    ///< of the entry in a record; empty: the object is a variable
  std::uint32_t value = 0;  ///< two's complement where signed
  bool may_be_mapped = false;
};
struct CanopenSettings {
  std::uint8_t node = 1;          ///< 1 to 127
  std::uint16_t period_ms = 100;  ///< of TPDO 1
};
inline constexpr std::uint16_t heartbeat_ms = 1000;

/// Ascending by index and sub-index.
[[nodiscard]] std::vector<CanopenObject> canopen_objects(const PlantAnswer& answer, const CanopenSettings& settings);
/// The electronic data sheet (CiA 306).
[[nodiscard]] std::string eds_text();

/// NMT states, as the heartbeat sends them.
enum class NmtState : std::uint8_t { boot_up = 0, stopped = 4, operational = 5, pre_operational = 127 };

/// The device's side of a conversation. It starts by itself: no master is needed.
class CanopenDevice {
 public:
  explicit CanopenDevice(CanopenSettings settings) : settings_(settings) {}

  /// What is to be answered to a frame of the bus; nothing where it is for others.
  [[nodiscard]] std::optional<sensor::CanFrame> hear(const sensor::CanFrame& frame, const PlantAnswer& answer);
  /// Boot-up first, then the state.
  [[nodiscard]] sensor::CanFrame heartbeat();
  [[nodiscard]] NmtState state() const { return state_; }
  [[nodiscard]] std::uint8_t node() const { return settings_.node; }

 private:
  CanopenSettings settings_;
  NmtState state_ = NmtState::boot_up;
};

}  // namespace spoolflow::fieldbus
