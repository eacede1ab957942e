#include "addons/live/protocols/canopen_device.hpp"

#include <algorithm>

namespace spoolflow::fieldbus {
namespace {

using sensor::CanFrame;

/// CiA 301, 7.2.4.3.17.
enum class SdoAbort : std::uint32_t {
  unknown_command = 0x05040001,
  read_only = 0x06010002,
  no_object = 0x06020000,
  no_sub_index = 0x06090011,
};

constexpr double mL_per_min_per_m3_per_s = 6e7;

/// Rounded to 32 bits; the smallest number stands for what is not known.
std::uint32_t rounded_bits(double value) {
  constexpr double most = 2147483647.0;
  if (!std::isfinite(value)) return 0x80000000U;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(std::clamp(value, -most, most))));
}

std::uint32_t word(std::int16_t value) {
  return static_cast<std::uint16_t>(value);
}

CanFrame sdo_answer(std::uint8_t node, std::uint8_t command, const CanFrame& request, std::uint32_t value) {
  CanFrame out;
  out.id = 0x580U + node;
  out.size = 8;
  out.data = {command, request.data[1], request.data[2], request.data[3]};
  for (unsigned k = 0; k < 4; ++k) out.data[4 + k] = static_cast<std::uint8_t>(value >> (8U * k));
  return out;
}

CanFrame aborted(std::uint8_t node, const CanFrame& request, SdoAbort why) {
  return sdo_answer(node, 0x80, request, static_cast<std::uint32_t>(why));
}

/// Expedited uploads alone: no object has more than four bytes.
CanFrame answered(std::uint8_t node, const CanFrame& request, const std::vector<CanopenObject>& objects) {
  constexpr std::uint8_t upload = 0x40, expedited = 0x43;
  const unsigned specifier = request.data[0] & 0xE0U;
  const unsigned index = request.data[1] | static_cast<unsigned>(request.data[2]) << 8U;
  const auto same_index = [&](const CanopenObject& one) { return one.index == index; };
  const auto first = std::find_if(objects.begin(), objects.end(), same_index);
  if (specifier != upload && specifier != 0x20U) return aborted(node, request, SdoAbort::unknown_command);
  if (first == objects.end()) return aborted(node, request, SdoAbort::no_object);
  const auto found = std::find_if(
      first, objects.end(), [&](const CanopenObject& one) { return one.index == index && one.sub == request.data[3]; });
  if (found == objects.end()) return aborted(node, request, SdoAbort::no_sub_index);
  if (specifier != upload) return aborted(node, request, SdoAbort::read_only);
  const unsigned unused = 4 - size_of(found->type);
  return sdo_answer(node, static_cast<std::uint8_t>(expedited | unused << 2U), request, found->value);
}

}  // namespace

unsigned size_of(CanopenType type) {
  if (type == CanopenType::unsigned8) return 1;
  return type == CanopenType::unsigned16 || type == CanopenType::integer16 ? 2 : 4;
}

// long: a table of objects, one a line
std::vector<CanopenObject> canopen_objects(const PlantAnswer& answer, const CanopenSettings& settings) {
  using enum CanopenType;
  const sensor::FlowAnswer flow = flow_answer(answer);
  const double known = flow.is_known ? 1 : std::nan("");
  const auto mapping = [](std::uint32_t index, std::uint32_t sub) { return index << 16U | sub << 8U | 16U; };
  const auto mL = [&](double m3_per_s) { return rounded_bits(known * m3_per_s * mL_per_min_per_m3_per_s); };
  const auto share = [&](float m3_per_s) { return word(sensor::canopen_flow(m3_per_s, flow)); };
  const char* const identity = "Identity object";
  const char* const sending = "TPDO 1 communication parameter";
  const char* const mapped = "TPDO 1 mapping parameter";
  const char* const estimated = "Estimated flow";
  const bool is_active = sensor::canopen_status_word(flow) == sensor::canopen_active;
  return {
      {0x1000, 0, unsigned32, "Device type", "", 408},
      {0x1001, 0, unsigned8, "Error register", "", is_active ? 0U : 0x81U},
      {0x1017, 0, unsigned16, "Producer heartbeat time", "", heartbeat_ms},
      {0x1018, 0, unsigned8, identity, "Highest sub-index supported", 4},
      {0x1018, 1, unsigned32, identity, "Vendor-ID", 0},
      {0x1018, 2, unsigned32, identity, "Product code", 1},
      {0x1018, 3, unsigned32, identity, "Revision number", 0x00010000},
      {0x1018, 4, unsigned32, identity, "Serial number", 0},
      {0x1800, 0, unsigned8, sending, "Highest sub-index supported", 5},
      {0x1800, 1, unsigned32, sending, "COB-ID used by TPDO", 0x40000180U + settings.node},
      {0x1800, 2, unsigned8, sending, "Transmission type", 254},
      {0x1800, 5, unsigned16, sending, "Event timer", settings.period_ms},
      {0x1A00, 0, unsigned8, mapped, "Number of mapped objects", 4},
      {0x1A00, 1, unsigned32, mapped, "Object 1", mapping(0x6041, 0)},
      {0x1A00, 2, unsigned32, mapped, "Object 2", mapping(0x2000, 1)},
      {0x1A00, 3, unsigned32, mapped, "Object 3", mapping(0x2000, 2)},
      {0x1A00, 4, unsigned32, mapped, "Object 4", mapping(0x2000, 3)},
      {0x2000, 0, unsigned8, estimated, "Highest sub-index supported", 8},
      {0x2000, 1, integer16, estimated, "Flow", share(flow.flow_m3_per_s), true},
      {0x2000, 2, integer16, estimated, "Flow lower", share(flow.flow_lower_m3_per_s), true},
      {0x2000, 3, integer16, estimated, "Flow upper", share(flow.flow_upper_m3_per_s), true},
      {0x2000, 4, integer32, estimated, "Flow mL_min", mL(answer.flow_m3_per_s)},
      {0x2000, 5, integer32, estimated, "Flow lower mL_min", mL(answer.flow_lower_m3_per_s)},
      {0x2000, 6, integer32, estimated, "Flow upper mL_min", mL(answer.flow_upper_m3_per_s)},
      {0x2000, 7, integer32, estimated, "Full flow mL_min",
       rounded_bits(answer.rated_flow_m3_per_s * mL_per_min_per_m3_per_s)},
      {0x2000, 8, integer32, estimated, "Pressure difference Pa", rounded_bits(known * answer.pressure_difference_Pa)},
      {0x2001, 0, unsigned32, "Sensor status bits", "", static_cast<std::uint32_t>(answer.status)},
      {0x2002, 0, unsigned8, "NE 107", "", answer.ne107},
      {0x2003, 0, unsigned32, "Samples", "", static_cast<std::uint32_t>(answer.samples)},
      {0x6041, 0, unsigned16, "Device status word", "", sensor::canopen_status_word(flow), true},
  };
}

std::optional<CanFrame> CanopenDevice::hear(const CanFrame& frame, const PlantAnswer& answer) {
  if (frame.extended) return std::nullopt;
  if (frame.id == 0 && frame.size == 2) {  // NMT; node 0: all
    if (frame.data[1] != 0 && frame.data[1] != settings_.node) return std::nullopt;
    switch (frame.data[0]) {
      case 1:
        state_ = NmtState::operational;
        break;
      case 2:
        state_ = NmtState::stopped;
        break;
      case 128:
        state_ = NmtState::pre_operational;
        break;
      case 129:
      case 130:
        state_ = NmtState::boot_up;
        return heartbeat();
      default:
        break;
    }
    return std::nullopt;
  }
  if (frame.id != 0x600U + settings_.node || frame.size != 8 || state_ == NmtState::stopped) return std::nullopt;
  if (frame.data[0] == 0x80) return std::nullopt;  // the other side gave up
  return answered(settings_.node, frame, canopen_objects(answer, settings_));
}

CanFrame CanopenDevice::heartbeat() {
  CanFrame out;
  out.id = 0x700U + settings_.node;
  out.size = 1;
  out.data[0] = static_cast<std::uint8_t>(state_);
  if (state_ == NmtState::boot_up) state_ = NmtState::operational;
  return out;
}

}  // namespace spoolflow::fieldbus
