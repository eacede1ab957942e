#include "addons/live/sources/datagram.hpp"

#include <cmath>
#include <cstring>
#include <random>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/sources/udp_receiver.hpp"

namespace spoolflow::live {
namespace {

using Bytes = std::vector<std::uint8_t>;

estimation::TimedSample datagram_sample(float current_A) {
  constexpr double none = estimation::not_measured;
  return {0, current_A, 4.5, 1e-3, 323.15, none, none, {none, none, none, none}};
}

Bytes datagram_of(std::uint64_t sequence, int samples, std::uint32_t session = 7) {
  std::vector<estimation::TimedSample> block;
  for (int k = 0; k < samples; ++k) block.push_back(datagram_sample(static_cast<float>(k)));
  return write_datagram({.valve = "press_1",
                         .session = session,
                         .sequence = sequence,
                         .time_ns = -1'000'000'000,
                         .period_ns = 500'000,
                         .channels = 0x000F},
                        block);
}

NoDatagram refusal_of(const Bytes& bytes) {
  const auto read = read_datagram(bytes);
  EXPECT_TRUE(std::holds_alternative<NoDatagram>(read));
  return std::holds_alternative<NoDatagram>(read) ? std::get<NoDatagram>(read) : NoDatagram{};
}

TEST(Datagram, ComesBackAsItWasSent) {
  const auto read = read_datagram(datagram_of(42, 3));
  ASSERT_TRUE(std::holds_alternative<Datagram>(read));
  const Datagram& datagram = std::get<Datagram>(read);
  EXPECT_EQ(datagram.valve, "press_1");
  EXPECT_EQ(datagram.session, 7U);
  EXPECT_EQ(datagram.sequence, 42U);
  ASSERT_EQ(datagram.samples.size(), 3U);
  EXPECT_DOUBLE_EQ(datagram.samples[2].time_s, -1.0 + 2 * 0.0005);
  EXPECT_EQ(datagram.samples[2].current_A, 2.0);
  EXPECT_EQ(datagram.samples[0].position_m, double{1e-3F});
  EXPECT_TRUE(std::isnan(datagram.samples[0].current_a_A));
}

TEST(Datagram, AnyOtherByteIsNoticed) {
  const Bytes whole = datagram_of(42, 3);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    Bytes damaged = whole;
    damaged[at] ^= 0x10;
    EXPECT_TRUE(std::holds_alternative<NoDatagram>(read_datagram(damaged))) << at;
  }
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_TRUE(std::holds_alternative<NoDatagram>(read_datagram({whole.data(), length}))) << length;
  }
}

TEST(Datagram, RubbishIsNone) {
  std::mt19937 random(1);
  Bytes bytes(500);
  for (int round = 0; round < 2000; ++round) {
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    if (round % 2 == 0) std::memcpy(bytes.data(), "SFLW\1", 5);
    EXPECT_TRUE(std::holds_alternative<NoDatagram>(read_datagram({bytes.data(), random() % bytes.size()})));
  }
}

TEST(Datagram, SaysWhyItIsNone) {
  EXPECT_EQ(refusal_of({}), NoDatagram::too_short);
  EXPECT_EQ(refusal_of(datagram_of(0, 0)), NoDatagram::no_sense);
  Bytes other = datagram_of(0, 1);
  other[4] = 2;
  EXPECT_EQ(refusal_of(other), NoDatagram::other_version);
  other = datagram_of(0, 1);
  other.push_back(0);
  EXPECT_EQ(refusal_of(other), NoDatagram::wrong_length);
  EXPECT_EQ(name(NoDatagram::wrong_checksum), "damaged: its checksum is another");
}

TEST(Datagram, ANumberThatIsNotFiniteWasNotMeasured) {
  const std::vector<estimation::TimedSample> block{datagram_sample(INFINITY)};
  const auto read = read_datagram(write_datagram({"v", 1, 0, 0, 1000, 0x000F}, block));
  ASSERT_TRUE(std::holds_alternative<Datagram>(read));
  EXPECT_TRUE(std::isnan(std::get<Datagram>(read).samples[0].current_A));
}

TEST(Datagram, WithoutAChannelItIsNoneHoweverManySamplesItClaims) {
  const std::vector<estimation::TimedSample> block(65535, datagram_sample(1));
  const auto bytes = write_datagram({"v", 1, 0, 0, 1000, 0}, block);
  ASSERT_EQ(bytes.size(), datagram_header_bytes + datagram_checksum_bytes);
  EXPECT_EQ(refusal_of(bytes), NoDatagram::no_sense);
}

class DatagramOrderTest : public ::testing::Test {
 protected:
  SampleBlock take(std::uint64_t sequence, int samples, std::uint32_t session = 7) {
    return order.next(std::get<Datagram>(read_datagram(datagram_of(sequence, samples, session))), intake);
  }
  Intake intake{[] {}};
  DatagramOrder order;
};

TEST_F(DatagramOrderTest, CountsWhatWasLostAndLeavesOutWhatCameBefore) {
  EXPECT_EQ(take(100, 10).lost_before, 0U);  // in the middle of a session: nothing is known of what was before
  EXPECT_EQ(take(110, 10).samples.size(), 10U);
  const SampleBlock after_gap = take(150, 10);
  EXPECT_EQ(after_gap.lost_before, 30U);
  EXPECT_EQ(after_gap.after.next, 160U);
  EXPECT_TRUE(take(150, 10).samples.empty());
  const SampleBlock half_known = take(155, 10);
  EXPECT_EQ(half_known.samples.size(), 5U);
  EXPECT_EQ(half_known.samples.front().current_A, 5.0);
  EXPECT_EQ(intake.counters().repeated, 15U);
  EXPECT_EQ(intake.counters().connections, 1U);
}

TEST_F(DatagramOrderTest, ANewSessionStartsAgain) {
  (void)take(100, 10);
  const SampleBlock first = take(0, 10, 8);
  EXPECT_EQ(first.samples.size(), 10U);
  EXPECT_EQ(first.lost_before, 0U);
  EXPECT_EQ(first.after.session, 8U);
  EXPECT_EQ(intake.counters().connections, 2U);
}

TEST_F(DatagramOrderTest, GoesOnWhereItWas) {
  order = DatagramOrder({7, 120});
  EXPECT_EQ(take(130, 10).lost_before, 10U);
  EXPECT_TRUE(take(110, 10).samples.empty());
}

TEST_F(DatagramOrderTest, OneDatagramWithAHugeNumberMutesNobody) {
  (void)take(100, 10);
  EXPECT_TRUE(take(~std::uint64_t{0} - 100, 10).samples.empty());
  const SampleBlock next = take(110, 10);
  EXPECT_EQ(next.samples.size(), 10U);
  EXPECT_EQ(next.lost_before, 0U);
  EXPECT_EQ(next.after.next, 120U);
  EXPECT_EQ(intake.counters().unreadable, 1U);
}

TEST_F(DatagramOrderTest, ASenderThatUsesItsSessionAgainAfterPowerUpIsHeardAfterEightDatagrams) {
  order = DatagramOrder({7, 5'000'000});
  for (std::uint64_t k = 0; k < 7; ++k) EXPECT_TRUE(take(10 * k, 10).samples.empty());
  const SampleBlock heard = take(70, 10);
  EXPECT_EQ(heard.samples.size(), 10U);
  EXPECT_EQ(heard.lost_before, 0U);
  EXPECT_EQ(heard.after.next, 80U);
  EXPECT_EQ(take(80, 10).samples.size(), 10U);
  EXPECT_EQ(intake.counters().repeated, 70U);
  EXPECT_EQ(intake.counters().connections, 1U);
}

TEST_F(DatagramOrderTest, WhatALongOutageLostIsCountedOnceItsEndIsConfirmed) {
  (void)take(0, 10);
  for (std::uint64_t k = 0; k < 7; ++k) EXPECT_TRUE(take(1'000'000 + 10 * k, 10).samples.empty());
  const SampleBlock heard = take(1'000'070, 10);
  EXPECT_EQ(heard.samples.size(), 10U);
  EXPECT_EQ(heard.lost_before, 1'000'060U);
  EXPECT_EQ(intake.counters().connections, 1U);
}

TEST_F(DatagramOrderTest, DatagramsThatComeTwiceBeginNothing) {
  for (std::uint64_t k = 0; k < 40; ++k) {
    EXPECT_EQ(take(10 * k, 10).samples.size(), 10U);
    EXPECT_TRUE(take(10 * k, 10).samples.empty());
  }
  EXPECT_EQ(intake.counters().repeated, 400U);
  EXPECT_EQ(intake.counters().connections, 1U);
}

}  // namespace
}  // namespace spoolflow::live
