#include "addons/live/protocols/canopen_device.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

namespace spoolflow::fieldbus {
namespace {

using sensor::CanFrame;

PlantAnswer valve() {
  PlantAnswer out;
  out.id = "press_1";
  out.flow_m3_per_s = 20.0 / 60000;
  out.flow_lower_m3_per_s = 18.0 / 60000;
  out.flow_upper_m3_per_s = 22.0 / 60000;
  out.pressure_difference_Pa = 35e5;
  out.rated_flow_m3_per_s = 40.0 / 60000;
  out.stalled = false;
  return out;
}

CanFrame request(std::uint8_t command, std::uint16_t index, std::uint8_t sub) {
  CanFrame out;
  out.id = 0x611;
  out.size = 8;
  out.data = {command, static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8U), sub};
  return out;
}

TEST(CanopenDevice, BootsStartsByItselfAndReportsItsState) {
  CanopenDevice device({.node = 17});
  EXPECT_EQ(device.heartbeat().data[0], 0);
  EXPECT_EQ(device.heartbeat().data[0], 5);
  EXPECT_EQ(device.heartbeat().id, 0x711U);
}

TEST(CanopenDevice, HeedsTheMasterOfTheNetwork) {
  CanopenDevice device({.node = 17});
  (void)device.heartbeat();
  CanFrame nmt;
  nmt.size = 2;
  nmt.data = {128, 17};
  EXPECT_FALSE(device.hear(nmt, valve()));
  EXPECT_EQ(device.state(), NmtState::pre_operational);
  nmt.data = {1, 18};  // another node
  (void)device.hear(nmt, valve());
  EXPECT_EQ(device.state(), NmtState::pre_operational);
  nmt.data = {1, 0};  // all
  (void)device.hear(nmt, valve());
  EXPECT_EQ(device.state(), NmtState::operational);
  nmt.data = {129, 17};  // reset
  EXPECT_EQ(device.hear(nmt, valve())->data[0], 0);
}

TEST(CanopenDevice, AnswersWhatAMasterReads) {
  CanopenDevice device({.node = 17});
  const auto flow = device.hear(request(0x40, 0x2000, 4), valve());
  ASSERT_TRUE(flow);
  EXPECT_EQ(flow->id, 0x591U);
  EXPECT_THAT(flow->data, testing::ElementsAre(0x43, 0x00, 0x20, 4, 0x20, 0x4E, 0, 0));  // 20000 mL/min
  const auto share = device.hear(request(0x40, 0x2000, 1), valve());
  EXPECT_THAT(share->data, testing::ElementsAre(0x4B, 0x00, 0x20, 1, 0x00, 0x20, 0, 0));  // half of 16384
  const auto number = device.hear(request(0x40, 0x1018, 0), valve());
  EXPECT_EQ(number->data[0], 0x4F);
}

TEST(CanopenDevice, RefusesWritesAndWhatItHasNot) {
  CanopenDevice device({.node = 17});
  EXPECT_THAT(device.hear(request(0x2B, 0x2000, 1), valve())->data,
              testing::ElementsAre(0x80, 0x00, 0x20, 1, 0x02, 0x00, 0x01, 0x06));
  EXPECT_THAT(device.hear(request(0x40, 0x3000, 0), valve())->data,
              testing::ElementsAre(0x80, 0x00, 0x30, 0, 0x00, 0x00, 0x02, 0x06));
  EXPECT_THAT(device.hear(request(0x40, 0x2000, 77), valve())->data,
              testing::ElementsAre(0x80, 0x00, 0x20, 77, 0x11, 0x00, 0x09, 0x06));
  CanFrame for_another = request(0x40, 0x2000, 1);
  for_another.id = 0x612;
  EXPECT_FALSE(device.hear(for_another, valve()));
}

TEST(CanopenDevice, MarksAsUnknownWhatAStalledValveHad) {
  CanopenDevice device({.node = 17});
  PlantAnswer stalled = valve();
  stalled.stalled = true;
  EXPECT_THAT(device.hear(request(0x40, 0x2000, 4), stalled)->data,
              testing::ElementsAre(0x43, 0x00, 0x20, 4, 0, 0, 0, 0x80));
}

TEST(CanopenDevice, HasAnErrorInItsRegisterWhereItsStateIsAFault) {
  CanopenDevice device({.node = 17});
  const auto value_of = [&](std::uint16_t index, const PlantAnswer& answer) {
    return device.hear(request(0x40, index, 0), answer)->data[4];
  };
  PlantAnswer faulty = valve(), silent = valve();
  faulty.status = sensor::Status::coil_fault;
  silent.stalled = true;
  EXPECT_EQ(value_of(0x6041, valve()), 0x0F);
  EXPECT_EQ(value_of(0x1001, valve()), 0);
  for (const PlantAnswer& held : {faulty, silent}) {
    EXPECT_EQ(value_of(0x6041, held), 0x03);
    EXPECT_EQ(value_of(0x1001, held), 0x81);
  }
}

/// SPOOLFLOW_WRITE_EDS=1 writes it again.
TEST(CanopenDevice, HasTheElectronicDataSheetOfTheDocuments) {
  if (std::getenv("SPOOLFLOW_WRITE_EDS") != nullptr) std::ofstream(SPOOLFLOW_EDS) << eds_text();
  std::ostringstream kept;
  kept << std::ifstream(SPOOLFLOW_EDS).rdbuf();
  EXPECT_EQ(kept.str(), eds_text());
}

}  // namespace
}  // namespace spoolflow::fieldbus
