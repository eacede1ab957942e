#include "addons/live/protocols/j1939_address.hpp"

#include <gtest/gtest.h>

namespace spoolflow::fieldbus {
namespace {

using sensor::CanFrame;

TEST(J1939Address, IsClaimedWithItsNameAndAgainWhenAsked) {
  J1939Address address(0x80);
  EXPECT_EQ(address.claim().id, 0x18EEFF80U);
  CanFrame request;
  request.extended = true;
  request.id = 0x18EAFF10;
  request.size = 3;
  request.data = {0x00, 0xEE, 0x00};
  ASSERT_TRUE(address.hear(request));
  request.data = {0xEB, 0xFE, 0x00};  // another group
  EXPECT_FALSE(address.hear(request));
}

TEST(J1939Address, IsDefendedAgainstAGreaterNameAndLostToALesser) {
  J1939Address address(0x80);
  const auto greater = address.hear(sensor::address_claimed_frame(j1939_name(0x80) + 1, 0x80));
  ASSERT_TRUE(greater);
  EXPECT_EQ(greater->id, 0x18EEFF80U);
  EXPECT_FALSE(address.is_lost());
  const auto lesser = address.hear(sensor::address_claimed_frame(1, 0x80));
  ASSERT_TRUE(lesser);
  EXPECT_EQ(lesser->id, 0x18EEFFFEU);  // cannot claim
  EXPECT_TRUE(address.is_lost());
}

TEST(J1939Address, OfOthersIsTheirs) {
  J1939Address address(0x80);
  EXPECT_FALSE(address.hear(sensor::address_claimed_frame(1, 0x81)));
  EXPECT_FALSE(address.is_lost());
}

}  // namespace
}  // namespace spoolflow::fieldbus
