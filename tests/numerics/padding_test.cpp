#include "spoolflow/numerics/padding.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

namespace spoolflow::numerics {
namespace {

enum class Kind : std::uint8_t { one = 1, two };

struct Point {
  double x, y, z;
};

/// With an array of structures in front of other members, which GCC's own way cannot count.
struct Memory {
  bool started = true;
  double time_s = 1.5;
  std::array<Point, 5> points{{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, {13, 14, 15}}};
  std::array<Kind, 3> kinds{Kind::one, Kind::two, Kind::one};
  std::uint32_t count = 7;
  std::array<std::array<float, 2>, 2> pairs{{{1, 2}, {3, 4}}};
  Kind last = Kind::two;
  bool holds = true;
  double sum = 2.5;
};

/// On memory that was full of `filling`.
Memory on(unsigned char filling) {
  Memory out;
  std::memset(static_cast<void*>(&out), filling, sizeof out);
  out.started = true;
  out.time_s = 1.5;
  out.points = Memory{}.points;
  out.kinds = Memory{}.kinds;
  out.count = 7;
  out.pairs = Memory{}.pairs;
  out.last = Kind::two;
  out.holds = true;
  out.sum = 2.5;
  return out;
}

TEST(Padding, EqualObjectsHaveEqualBytesOnceItIsCleared) {
  Memory one = on(0xFF), other = on(0x55);
  clear_padding(one);
  clear_padding(other);
  EXPECT_EQ(std::memcmp(&one, &other, sizeof one), 0);
}

TEST(Padding, ClearedItTakesNothingFromTheMembers) {
  Memory memory = on(0xFF);
  clear_padding(memory);
  EXPECT_TRUE(memory.started);
  EXPECT_EQ(memory.time_s, 1.5);
  for (std::size_t k = 0; k < memory.points.size(); ++k) {
    const double first = 3.0 * static_cast<double>(k) + 1;
    EXPECT_EQ(memory.points[k].x, first);
    EXPECT_EQ(memory.points[k].y, first + 1);
    EXPECT_EQ(memory.points[k].z, first + 2);
  }
  EXPECT_EQ(memory.kinds, Memory{}.kinds);
  EXPECT_EQ(memory.count, 7U);
  EXPECT_EQ(memory.pairs, Memory{}.pairs);
  EXPECT_EQ(memory.last, Kind::two);
  EXPECT_TRUE(memory.holds);
  EXPECT_EQ(memory.sum, 2.5);
}

TEST(Padding, MembersAreVisitedInTheirOrder) {
  Point point{1, 2, 3};
  double before = 0;
  for_each_member(point, [&](double number) {
    EXPECT_EQ(number, before + 1);
    before = number;
  });
  EXPECT_EQ(before, 3);
}

}  // namespace
}  // namespace spoolflow::numerics
