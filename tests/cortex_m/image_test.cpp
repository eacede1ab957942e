/// Parameters out of a flash page on an emulated core: firmware in which no model is linked.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "spoolflow/export/parameters/parameter_image.hpp"
#include "spoolflow/sensor/parameter_image/image_refusal.hpp"
#include "tests/cortex_m/packed_run.hpp"
#include "tests/cortex_m/workshop.hpp"

namespace spoolflow::cortex_m {
namespace {

using estimation::Estimator;

/// What one firmware printed, built from the exported model (`table`) or with nothing but pages.
struct Replays {
  Figures table;
  Figures page;
};

/// The firmware's folder: the recording, a page, a newer one of the same valve, and one in which a bit has fallen.
void furnish(const Workshop& workshop, const model::Model& model, Estimator estimator) {
  exports::ImageContents contents{"test", 1700000000U};
  contents.condensed = estimator == Estimator::condensed;
  contents.observer = estimator == Estimator::observer;
  const std::string image = exports::parameter_image(model, contents);
  ++contents.created_s;
  std::string worn = image;
  worn[worn.size() / 2] = static_cast<char>(worn[worn.size() / 2] ^ 1);
  workshop.write("run.bin", packed_run(model, estimator, SPOOLFLOW_EXAMPLES "/valve_a/duty_cycle_1.h5"));
  workshop.write("valve.bin", image);
  workshop.write("newer.bin", exports::parameter_image(model, contents));
  workshop.write("worn.bin", worn);
}

const Core& cortex_m4f = cores.front();

/// The compiler joins products and sums into one instruction where it likes, which differs with what it knows of the
/// numbers: without that all firmware has the same bits.
constexpr const char* bit_for_bit = " -ffp-contract=off ";

/// `which`: -DREPLAY_…, or nothing.
Replays cpp_replays(Workshop& workshop, const model::Model& model, const std::string& which) {
  const std::string build =
      fmt::format("{}{}{} -DRATED_FLOW_M3_PER_S={:.9e}F {}/board.cpp {}/image_replay.cpp -o replay.elf{}-lgcc",
                  compiler(cortex_m4f), bit_for_bit, which, model.valve.rated_flow_m3_per_s, SPOOLFLOW_FIRMWARE,
                  SPOOLFLOW_FIRMWARE, link());
  const auto figures = [&](const std::string& more) {
    return figures_of(workshop.run(build + more + " && " + emulator(cortex_m4f, "replay.elf")));
  };
  Replays out;
  out.table = figures(" -DEXPORTED_MODEL");
  workshop.run("mv valve_model.hpp away.hpp");  // nothing of a model can be linked from here on
  out.page = figures("");
  workshop.run("mv away.hpp valve_model.hpp");
  return out;
}

Replays c_replays(Workshop& workshop) {
  const auto figures = [&](const std::string& more) {
    const std::string objects =
        compiler(cortex_m4f) + bit_for_bit + more + " -c valve_sensor.cpp " SPOOLFLOW_FIRMWARE "/board.cpp " +
        SPOOLFLOW_FIRMWARE "/c_board.cpp && " + c_compiler(cortex_m4f) + more + " -c " SPOOLFLOW_FIRMWARE "/c_replay.c";
    const std::string linked = "arm-none-eabi-gcc valve_sensor.o board.o c_board.o c_replay.o -o replay.elf " +
                               options(cortex_m4f) + link() + "-lgcc";
    return figures_of(workshop.run(objects + " && " + linked + " && " + emulator(cortex_m4f, "replay.elf")));
  };
  Replays out;
  out.table = figures("");
  workshop.run("mv valve_model.hpp away.hpp");
  out.page = figures(" -DVALVE_SENSOR_NO_MODEL");
  return out;
}

void expect_alike(const Replays& replays, std::uint32_t page_bytes) {
  const Figures& page = replays.page;
  EXPECT_EQ(page.at("refusal"), 0U);
  EXPECT_EQ(page.at("worn_refusal"), static_cast<std::uint32_t>(sensor::ImageRefusal::damaged));
  EXPECT_GT(page.at("points"), 60000U);
  EXPECT_EQ(page.at("answers_sum"), replays.table.at("answers_sum"));
  EXPECT_LT(page.at("error_ppm"), 1100U);  // of the rated flow, from double precision on the host
#ifdef SPOOLFLOW_ARM_GCC_12  // other compilers than the page's make more or less of constants that they know
  EXPECT_LE(100U * page.at("largest"), 113U * replays.table.at("largest"));
#endif
  EXPECT_EQ(page.at("parameter_bytes"), 20U);
  EXPECT_LT(page.at("check_stack_bytes"), 256U);
  EXPECT_LT(page.at("page_bytes"), page_bytes);
  EXPECT_LT(page.at("check"), 16U * page.at("page_bytes"));
  EXPECT_GT(page.at("slice"), 64U);
  EXPECT_LT(page.at("slice"), 4500U);
  for (const char* figure : {"page_bytes", "check", "check_stack_bytes", "slice", "mean", "largest"})
    ::testing::Test::RecordProperty(figure, static_cast<int>(page.at(figure)));
  for (const char* figure : {"mean", "largest"})
    ::testing::Test::RecordProperty(std::string("exported_") + figure, static_cast<int>(replays.table.at(figure)));
}

void expect_in_c_as(const Replays& c, const Replays& cpp) {
  for (const Figures& figures : {c.table, c.page}) {
    EXPECT_EQ(figures.at("refusal"), 0U);
    EXPECT_EQ(figures.at("points"), cpp.page.at("points"));
    EXPECT_EQ(figures.at("answers_sum"), cpp.page.at("answers_sum"));
    EXPECT_LT(figures.at("state_bytes"), 1536U);
  }
  EXPECT_EQ(c.page.at("worn_refusal"), static_cast<std::uint32_t>(sensor::ImageRefusal::damaged));
  EXPECT_EQ(c.page.at("switches"), 1U);
  EXPECT_LE(c.table.at("largest"), cpp.table.at("largest") + 100U);
  ::testing::Test::RecordProperty("in_c_largest", static_cast<int>(c.table.at("largest")));
  ::testing::Test::RecordProperty("in_c_switch", static_cast<int>(c.page.at("largest")));
}

class ImageOnCortexM : public ::testing::Test {
 protected:
  const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
};

TEST_F(ImageOnCortexM, ObserverOutOfAFlashPageAnswersBitForBitAsTheExportedOneAndInCAsInCpp) {
  Workshop workshop(model);
  furnish(workshop, model, Estimator::observer);
  const Replays replays = cpp_replays(workshop, model, "");
  expect_alike(replays, 32768);
  expect_in_c_as(c_replays(workshop), replays);
}

TEST_F(ImageOnCortexM, CondensedSensorOutOfAFlashPageAnswersBitForBitAsTheExportedOne) {
  Workshop workshop(model);
  furnish(workshop, model, Estimator::condensed);
  expect_alike(cpp_replays(workshop, model, "-DREPLAY_CONDENSED"), 65536);
}

TEST_F(ImageOnCortexM, WholeValveOutOfAFlashPageAnswersBitForBitAsTheExportedOneAndInCAsInCpp) {
  model::Model whole = model;
  whole.p_to_a = model::Direction{model.condensed, model.observer, model.evidence};
  whole.valve.direction = "both";
  Workshop workshop(whole);
  furnish(workshop, whole, Estimator::observer);
  const Replays replays = cpp_replays(workshop, whole, "-DREPLAY_WHOLE");
  expect_alike(replays, 65536);
  expect_in_c_as(c_replays(workshop), replays);
}

}  // namespace
}  // namespace spoolflow::cortex_m
