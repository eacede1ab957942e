#pragma once
/// A flow answer as CAN frames: J1939 / ISO 11783-7 "auxiliary valve estimated flow", and the process data of a CANopen
/// device after CiA 408. For firmware and `spoolflow live` alike: no heap, no clock, no bus. Layout: docs/fieldbus.md.
///
///     const auto answer = flow_answer(estimate, rated_flow_m3_per_s);
///     send(estimated_flow_frame(answer, {.valve = 0, .source_address = 0x80}));  // every 100 ms
///     send(process_data_frame(answer, 17));
#include <array>
#include <cstdint>

#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/basis/status.hpp"

namespace spoolflow::sensor {

struct CanFrame {
  std::uint32_t id = 0;   ///< 29 bits where extended, else 11
  bool extended = false;  ///< J1939: always; CANopen: never
  std::uint8_t size = 0;  ///< bytes of data, 0 to 8
  std::array<std::uint8_t, 8> data{};
};

/// What a frame says of a valve.
struct FlowAnswer {
  float flow_m3_per_s = 0;  ///< signed: > 0 P to B. NaN: not known
  float flow_lower_m3_per_s = 0;
  float flow_upper_m3_per_s = 0;
  float full_flow_m3_per_s = 0;  ///< that is 100 %, > 0
  Status status = Status::none;
  bool is_known = false;  ///< false: no sample yet, or none any more
};

inline FlowAnswer flow_answer(const Estimate<float>& estimate, float full_flow_m3_per_s) {
  return {estimate.flow_m3_per_s,
          estimate.flow_lower_m3_per_s,
          estimate.flow_upper_m3_per_s,
          full_flow_m3_per_s,
          estimate.status,
          true};
}

/// Whether an input is at fault, so that a receiver that sees no band must not go by the flow. A monitor's doubt is not
/// meant: it widens the band and leaves the flow as it is.
inline bool is_faulty(const FlowAnswer& answer) {
  const std::uint32_t faults = fault_bits & ~static_cast<std::uint32_t>(Status::model_doubt);
  return (static_cast<std::uint32_t>(answer.status) & faults) != 0;
}

/// Flow over full flow times `scale`, rounded, held to -limit to limit. False where it is not known.
inline bool scaled_flow(float flow_m3_per_s, const FlowAnswer& answer, float scale, std::int32_t limit,
                        std::int32_t& out) {
  const float share = flow_m3_per_s / answer.full_flow_m3_per_s * scale;
  const float most = static_cast<float>(limit);
  if (!answer.is_known || !(answer.full_flow_m3_per_s > 0.0F) || !(share >= share)) return false;
  const float held = share > most ? most : (share < -most ? -most : share);
  out = static_cast<std::int32_t>(held < 0.0F ? held - 0.5F : held + 0.5F);
  return true;
}

/// J1939's words for a byte that holds no number.
inline constexpr std::uint8_t j1939_error = 0xFE, j1939_not_available = 0xFF;

struct AuxiliaryValve {
  std::uint8_t valve = 0;           ///< n, 0 to 15: as the tractor's valves are labelled
  std::uint8_t source_address = 0;  ///< 0 to 253
};

inline constexpr std::uint32_t estimated_flow_pgn = 65040;
inline constexpr std::uint32_t estimated_flow_period_ms = 100;

/// PGN 65040 + n, priority 3. ISO 11783-7, A.21: a percentage is 1 %/bit with an offset of -125 %. The port that oil
/// flows out of has the flow, P to B being the extend port; what comes back by the other is of the load, and not
/// available. So are fail safe mode and limit status, which no sensor knows.
inline CanFrame estimated_flow_frame(const FlowAnswer& answer, const AuxiliaryValve& at) {
  constexpr std::uint32_t priority = 3;
  constexpr std::uint8_t blocked = 0, extending = 1, retracting = 2, error_state = 14, unknown_state = 15;
  CanFrame out;
  out.extended = true;
  out.id = priority << 26U | (estimated_flow_pgn + (at.valve & 0x0FU)) << 8U | at.source_address;
  out.size = 8;
  out.data.fill(j1939_not_available);
  std::uint8_t state = unknown_state;
  std::int32_t percent = 0;
  if (answer.is_known && is_faulty(answer)) {
    out.data[0] = out.data[1] = j1939_error;
    state = error_state;
  } else if (scaled_flow(answer.flow_m3_per_s, answer, 100.0F, 125, percent)) {
    const bool extends = percent >= 0;
    out.data[extends ? 0 : 1] = static_cast<std::uint8_t>((extends ? percent : -percent) + 125);
    state = has(answer.status, Status::closed) ? blocked : (extends ? extending : retracting);
    if (state == blocked && extends) out.data[1] = 125;
    if (state == blocked && !extends) out.data[0] = 125;
  }
  out.data[2] = static_cast<std::uint8_t>(0xF0U | state);
  return out;
}

/// A J1939 NAME (64 bits) announced as the owner of an address: PGN 60928 to all, priority 6. Source address 254: it
/// could get none.
inline CanFrame address_claimed_frame(std::uint64_t name, std::uint8_t source_address) {
  CanFrame out;
  out.extended = true;
  out.id = 6U << 26U | 0xEEFFU << 8U | source_address;
  out.size = 8;
  for (unsigned k = 0; k < 8; ++k) out.data[k] = static_cast<std::uint8_t>(name >> (8U * k));
  return out;
}

/// 100 % of full flow in CiA 408's INTEGER16 values, and what stands for a flow that is not known.
inline constexpr std::int32_t canopen_full_scale = 16384;
inline constexpr std::int16_t canopen_not_known = -32768;

inline std::int16_t canopen_flow(float flow_m3_per_s, const FlowAnswer& answer) {
  std::int32_t out = 0;
  if (!scaled_flow(flow_m3_per_s, answer, static_cast<float>(canopen_full_scale), 32767, out)) return canopen_not_known;
  return static_cast<std::int16_t>(out);
}

/// CiA 408's status word (6041h): disabled, hold, device mode active, ready are bits 0 to 3, and together name a state
/// of the profile's device. ACTIVE where the answer is known, is a number, and without fault, else FAULT HOLD. The
/// words as in Moog's firmware manuals B99224-DV007 and B99224-DV018, the bits also as in Beckhoff's
/// ST_CoE408_StatusWord.
inline constexpr std::uint16_t canopen_active = 0x000F, canopen_fault_hold = 0x0003;

inline std::uint16_t canopen_status_word(const FlowAnswer& answer) {
  const bool is_known = canopen_flow(answer.flow_m3_per_s, answer) != canopen_not_known;
  return is_known && !is_faulty(answer) ? canopen_active : canopen_fault_hold;
}

/// The identifier of a frame for a node that CANopen does not have: reserved, and of the lowest priority.
inline constexpr std::uint32_t canopen_no_node_id = 0x7FFU;

/// TPDO 1 of a node (1 to 127), 180h + node: status word, flow, lower and upper end of its band, little endian. Any
/// other node would be another message's identifier: its frame is empty, and has `canopen_no_node_id`.
inline CanFrame process_data_frame(const FlowAnswer& answer, std::uint8_t node) {
  CanFrame out;
  if (node < 1U || node > 127U) {
    out.id = canopen_no_node_id;
    return out;
  }
  out.id = 0x180U + node;
  out.size = 8;
  const std::array<std::uint16_t, 4> words{
      canopen_status_word(answer), static_cast<std::uint16_t>(canopen_flow(answer.flow_m3_per_s, answer)),
      static_cast<std::uint16_t>(canopen_flow(answer.flow_lower_m3_per_s, answer)),
      static_cast<std::uint16_t>(canopen_flow(answer.flow_upper_m3_per_s, answer))};
  for (unsigned k = 0; k < 4; ++k) {
    out.data[2 * k] = static_cast<std::uint8_t>(words[k]);
    out.data[2 * k + 1] = static_cast<std::uint8_t>(words[k] >> 8U);
  }
  return out;
}

}  // namespace spoolflow::sensor
