#include "tests/cortex_m/longest_way.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cortex_m/followed_steps.hpp"
#include "tests/cortex_m/workshop.hpp"

namespace spoolflow::cortex_m {
namespace {

class LongestWay : public ::testing::Test {
 protected:
  /// Of `one_step` in assembly.
  StepCode code(const std::string& assembly) {
    workshop_.write("steps.s", ".syntax unified\n.cpu cortex-m4\n.fpu fpv4-sp-d16\n.thumb\n" + assembly);
    workshop_.run("arm-none-eabi-as steps.s -o steps.o && arm-none-eabi-ld -Ttext 0x100 -e one_step steps.o -o steps");
    return step_code(workshop_.run("arm-none-eabi-objdump -d -z steps"), "one_step");
  }
  std::size_t longest(const std::string& assembly, std::optional<std::uint32_t> rounds = {}) {
    return longest_way(code(assembly), [&](std::uint32_t) { return rounds; }).size();
  }
  std::string refusal(const std::string& assembly) {
    try {
      longest(assembly);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing was refused";
  }

 private:
  Workshop workshop_{model::read_model(SPOOLFLOW_EXAMPLE_MODEL)};
};

const std::string one_step = ".global one_step\n.type one_step, %function\n.thumb_func\none_step:\n";
const std::string called = ".type called, %function\n.thumb_func\ncalled:\n";

TEST_F(LongestWay, TakesTheLongerSideOfABranchAndWhatAConditionSkips) {
  EXPECT_EQ(longest(one_step + "cbz r0, 1f\nnop\nnop\n1: ldr r1, =0x12345678\nbx lr\n.ltorg\n"), 5U);
  EXPECT_EQ(longest(one_step + "cmp r0, #0\nite eq\nmoveq r0, #1\nmovne r0, #2\nbx lr\n"), 5U);
  EXPECT_EQ(longest(one_step + "push {r4, lr}\ncmp r0, #0\nit eq\npopeq {r4, pc}\nnop\npop {r4, pc}\n"), 6U);
}

TEST_F(LongestWay, GoesIntoCallsAndOnWhereAFunctionEndsInAnother) {
  EXPECT_EQ(longest(one_step + "push {lr}\nbl called\nldr pc, [sp], #4\n" + called + "nop\nbx lr\n"), 5U);
  EXPECT_EQ(longest(one_step + "nop\nb.w called\n" + called + "nop\nbx lr\n"), 4U);
}

TEST_F(LongestWay, ReadsTheTableOfAJumpWhoseIndexIsCompared) {
  const std::string cases = "2: nop\nnop\nnop\n3: bx lr\n1: bx lr\n";
  const std::string byte_table = "tbb [pc, r0]\n0: .byte (3f-0b)/2, (2f-0b)/2\n.balign 2\n";
  const std::string table = "tbh [pc, r0, lsl #1]\n0: .short (3f-0b)/2, (2f-0b)/2\n";
  EXPECT_EQ(longest(one_step + "cmp r0, #1\nbhi 1f\n" + byte_table + cases), 7U);
  EXPECT_EQ(longest(one_step + "cmp r0, #1\nbhi 1f\n" + table + cases), 7U);
  EXPECT_NE(refusal(one_step + "nop\nnop\n" + table + cases + "nop\n").find("index is not compared"),
            std::string::npos);
}

TEST_F(LongestWay, TakesALoopAsOftenAsItsBoundSays) {
  const std::string loop = one_step + "movs r0, #3\n1: nop\nsubs r0, #1\nbne 1b\nbx lr\n";
  EXPECT_EQ(longest(loop, 3), 2U + 4U * 3U);
  EXPECT_EQ(refusal(loop), "one_step: 0x102: a loop whose bound is not known");
  const std::string nested = one_step + "1: nop\n2: subs r0, #1\nbne 2b\nsubs r1, #1\nbne 1b\nbx lr\n";
  EXPECT_EQ(longest(nested, 1), 2U * (1U + 2U * 2U + 2U) + 1U);
}

TEST_F(LongestWay, RefusesWhatTheCodeAloneDoesNotTell) {
  EXPECT_EQ(refusal(one_step + "blx r3\nbx lr\n"), "one_step: 0x100: blx r3: where it leads is not in the code");
  EXPECT_NE(refusal(one_step + "ldr.w pc, [r0]\n").find("where it leads is not in the code"), std::string::npos);
  EXPECT_NE(refusal(one_step + "push {lr}\nbl one_step\npop {pc}\n").find("calls itself"), std::string::npos);
  const std::string two_ends = "cbz r0, 2f\n1: nop\n2: cbz r1, 3f\nb 1b\n3: bx lr\n";
  EXPECT_NE(refusal(one_step + two_ends).find("entered at two places"), std::string::npos);
}

TEST_F(LongestWay, FollowsStepsAlongTheEdgesOfTheGraphAlone) {
  const StepCode graph = code(one_step + "cbz r0, 1f\nnop\nnop\n1: bx lr\n");  // 0x100, 102, 104, 106
  const auto follow = [&](const std::vector<std::uint32_t>& blocks) {
    FollowedSteps steps(graph);
    for (const std::uint32_t block : blocks) steps.read(fmt::format("Trace 0: 0x7f [00000000/{:08x}/0/0] ", block));
    steps.end();
    return std::pair(steps.steps(), steps.largest().size());
  };
  EXPECT_EQ(follow({0x100, 0x106, 0x100, 0x102}), std::pair(2U, std::size_t{4}));
  EXPECT_EQ(follow({0x100, 0x102, 0x104}), std::pair(1U, std::size_t{4}));  // the emulator ended a block early
  EXPECT_THROW(follow({0x100, 0x104}), std::runtime_error);
  EXPECT_THROW(follow({0x100, 0x106, 0x102}), std::runtime_error);
}

}  // namespace
}  // namespace spoolflow::cortex_m
