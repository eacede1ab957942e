#include "addons/live/protocols/can_text.hpp"

#include <gtest/gtest.h>

namespace spoolflow::fieldbus {
namespace {

using sensor::CanFrame;

CanFrame flow() {
  return {0x0CFE1080, true, 8, {165, 0xFF, 0xF1, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}};
}

TEST(CanText, IsALineOfCandump) {
  EXPECT_EQ(candump_line(flow(), 1700000000.25, "can0"), "(1700000000.250000) can0 0CFE1080#A5FFF1FFFFFFFFFF\n");
  EXPECT_EQ(candump_line({0x711, false, 1, {5}}, 0.5, "can0"), "(0.500000) can0 711#05\n");
}

TEST(CanText, IsALineOfAscWithTimesSinceItsStart) {
  EXPECT_EQ(asc_line(flow(), 1.5), " 1.500000 1  CFE1080x        Tx   d 8 A5 FF F1 FF FF FF FF FF\n");
  EXPECT_TRUE(asc_beginning(1700000000.25).starts_with("date Tue Nov 14 10:13:20.250 PM 2023\nbase hex"));
}

TEST(CanText, ComesBackFromADatagram) {
  const auto back = read_can_datagram(can_datagram(flow(), 1.0));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->id, flow().id);
  EXPECT_TRUE(back->extended);
  EXPECT_EQ(back->data, flow().data);
}

TEST(CanText, MakesNothingOfACutDatagram) {
  const std::string whole = can_datagram(flow(), 1.0);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(read_can_datagram(whole.substr(0, size))) << size;
  }
}

}  // namespace
}  // namespace spoolflow::fieldbus
