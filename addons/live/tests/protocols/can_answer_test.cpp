#include "spoolflow/sensor/fieldbus/can_answer.hpp"

#include <array>
#include <cmath>

#include <gmock/gmock.h>

namespace spoolflow::sensor {
namespace {

using testing::ElementsAre;

FlowAnswer answer(float share, Status status = Status::none) {
  constexpr float full_m3_per_s = 1e-3F;
  return {share * full_m3_per_s,
          (share - 0.1F) * full_m3_per_s,
          (share + 0.1F) * full_m3_per_s,
          full_m3_per_s,
          status,
          true};
}

TEST(EstimatedFlow, OfValve3StandsInItsOwnGroupAtOnePercentABit) {
  const CanFrame frame = estimated_flow_frame(answer(0.4F), {3, 0x80});
  EXPECT_TRUE(frame.extended);
  EXPECT_EQ(frame.id, 0x0CFE1380U);  // priority 3, PGN 65043, source 128
  EXPECT_EQ(frame.size, 8);
  EXPECT_THAT(frame.data, ElementsAre(165, 0xFF, 0xF1, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF));  // 40 % + 125
}

TEST(EstimatedFlow, BackwardsLeavesByTheRetractPort) {
  const CanFrame frame = estimated_flow_frame(answer(-0.4F), {0, 1});
  EXPECT_EQ(frame.data[0], 0xFF);
  EXPECT_EQ(frame.data[1], 165);
  EXPECT_EQ(frame.data[2], 0xF2);
}

TEST(EstimatedFlow, OfAClosedValveIsBlockedAtZero) {
  const CanFrame frame = estimated_flow_frame(answer(0.0F, Status::closed), {0, 1});
  EXPECT_EQ(frame.data[0], 125);
  EXPECT_EQ(frame.data[1], 125);
  EXPECT_EQ(frame.data[2], 0xF0);
}

TEST(EstimatedFlow, AboveTheRangeStaysAtItsEnd) {
  EXPECT_EQ(estimated_flow_frame(answer(9.0F), {0, 1}).data[0], 250);
}

TEST(EstimatedFlow, AtFaultIsAnErrorAndNotAFlow) {
  const CanFrame frame = estimated_flow_frame(answer(0.4F, Status::coil_fault), {0, 1});
  EXPECT_EQ(frame.data[0], j1939_error);
  EXPECT_EQ(frame.data[2], 0xFE);
  EXPECT_EQ(estimated_flow_frame(answer(0.4F, Status::model_doubt), {0, 1}).data[0], 165);
}

TEST(EstimatedFlow, ThatNobodyKnowsIsNotAvailable) {
  FlowAnswer unknown = answer(0.4F);
  unknown.is_known = false;
  EXPECT_EQ(estimated_flow_frame(unknown, {0, 1}).data[0], j1939_not_available);
  EXPECT_EQ(estimated_flow_frame(answer(std::nanf("")), {0, 1}).data[0], j1939_not_available);
}

TEST(ProcessData, Has16384ForFullFlowLittleEndian) {
  const CanFrame frame = process_data_frame(answer(1.0F), 17);
  EXPECT_FALSE(frame.extended);
  EXPECT_EQ(frame.id, 0x191U);
  // 90 % is 14746, 110 % is 18022
  EXPECT_THAT(frame.data, ElementsAre(0x0F, 0x00, 0x00, 0x40, 0x9A, 0x39, 0x66, 0x46));
}

TEST(ProcessData, IsHeldAtFaultAndSendsNoFlowThatIsNotKnown) {
  // ready, active, hold, disabled from bit 3 down: FAULT HOLD is 0011, and 0111 would be FAULT REACTION, which passes
  EXPECT_EQ(process_data_frame(answer(0.5F, Status::sample_missing), 1).data[0], 0x03);
  EXPECT_EQ(process_data_frame(answer(0.5F, Status::model_doubt), 1).data[0], 0x0F);
  FlowAnswer unknown = answer(0.5F);
  unknown.is_known = false;
  EXPECT_THAT(process_data_frame(unknown, 1).data, ElementsAre(0x03, 0, 0, 0x80, 0, 0x80, 0, 0x80));
}

TEST(ProcessData, OfANodeThatCanopenDoesNotHaveIsAnEmptyFrameOfNoOtherMessage) {
  for (const std::uint8_t node : std::array<std::uint8_t, 3>{0, 128, 255}) {
    const CanFrame frame = process_data_frame(answer(0.5F), node);
    EXPECT_EQ(frame.id, canopen_no_node_id) << int{node};
    EXPECT_EQ(frame.size, 0) << int{node};
  }
  EXPECT_EQ(process_data_frame(answer(0.5F), 127).id, 0x1FFU);
}

}  // namespace
}  // namespace spoolflow::sensor
