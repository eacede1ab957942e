#include "addons/live/sources/rival_senders.hpp"

#include <arpa/inet.h>
#include <cstring>
#include <netinet/in.h>
#include <string>

#include <gtest/gtest.h>

namespace spoolflow::live {
namespace {

class RivalSendersTest : public ::testing::Test {
 protected:
  bool refused(std::uint32_t session, double at_s) {
    sockaddr_in from{};
    from.sin_family = AF_INET;
    from.sin_port = htons(static_cast<std::uint16_t>(5000 + session));
    from.sin_addr.s_addr = htonl(0x0A000000U + session);
    SessionArrival arrival{session, {}, static_cast<std::int64_t>(1e9 * at_s)};
    std::memcpy(&arrival.peer, &from, sizeof from);
    return rivals.refuses(arrival, intake);
  }
  /// Two senders alternate, 100 datagrams a second each; returns how many of the first are refused.
  int alternate(std::uint32_t first, std::uint32_t second, double from_s, int count) {
    int out = 0;
    for (int k = 0; k < count; ++k) {
      out += refused(first, from_s + 0.01 * k) ? 1 : 0;
      EXPECT_FALSE(refused(second, from_s + 0.01 * k + 0.005)) << k;
    }
    return out;
  }
  Intake intake{[] {}};
  RivalSenders rivals{1.0};
};

TEST_F(RivalSendersTest, OfTwoThatAlternateOneIsTakenAndBothAreNamed) {
  EXPECT_FALSE(refused(7, 0));
  EXPECT_FALSE(refused(8, 0.005));
  EXPECT_EQ(alternate(7, 8, 0.01, 100), 100);
  EXPECT_EQ(intake.trouble(),
            "two senders use this id: samples of 10.0.0.8:5008 (session 8) are taken, those of 10.0.0.7:5007 (session "
            "7) are refused");
}

TEST_F(RivalSendersTest, ASenderThatIsStartedAgainIsTakenAtOnceThoughDatagramsOfBeforeComeLate) {
  for (std::uint32_t session = 1; session < 20; ++session) {
    EXPECT_FALSE(refused(session, 0.2 * session));
    EXPECT_FALSE(refused(session, 0.2 * session + 0.1));
    EXPECT_EQ(refused(session - 1, 0.2 * session + 0.11), session > 1);
    EXPECT_EQ(intake.trouble(), "") << session;
  }
}

TEST_F(RivalSendersTest, TheOtherIsTakenOnceTheRunningOneIsSilent) {
  EXPECT_FALSE(refused(7, 0));
  EXPECT_FALSE(refused(8, 0.005));
  EXPECT_EQ(alternate(7, 8, 0.01, 20), 20);
  EXPECT_TRUE(refused(7, 1.2));
  EXPECT_FALSE(refused(7, 1.21));  // 1 s after the last of session 8
  EXPECT_EQ(intake.trouble(), "");
  EXPECT_EQ(alternate(8, 7, 1.22, 20), 20);
  EXPECT_NE(intake.trouble().find("of 10.0.0.7:5007 (session 7) are taken"), std::string::npos);
}

TEST_F(RivalSendersTest, ItIsOverTenSecondsAfterTheOtherHasLeft) {
  EXPECT_FALSE(refused(7, 0));
  EXPECT_FALSE(refused(8, 0.005));
  EXPECT_EQ(alternate(7, 8, 0.01, 20), 20);
  for (int k = 3; k <= 101; ++k) EXPECT_FALSE(refused(8, 0.1 * k));
  EXPECT_NE(intake.trouble(), "");
  EXPECT_FALSE(refused(8, 10.3));
  EXPECT_EQ(intake.trouble(), "");
}

TEST_F(RivalSendersTest, OfThreeOneIsTaken) {
  for (const std::uint32_t session : {7U, 8U, 9U}) EXPECT_FALSE(refused(session, 0.001 * session));
  for (int k = 1; k < 50; ++k) {
    EXPECT_TRUE(refused(7, 0.01 * k + 0.001));
    EXPECT_TRUE(refused(8, 0.01 * k + 0.002));
    EXPECT_FALSE(refused(9, 0.01 * k + 0.003));
  }
}

}  // namespace
}  // namespace spoolflow::live
