/// References of the machine, taken in the valve: what they cost on an emulated core, and what they come to.
#include "spoolflow/sensor/machine_reference.hpp"

#include <gtest/gtest.h>

#include "spoolflow/export/cpp/exported_text.hpp"
#include "spoolflow/export/parameters/parameter_image.hpp"
#include "tests/cortex_m/workshop.hpp"

namespace spoolflow::cortex_m {
namespace {

/// The same by the C interface; the example that is exported changes over to the page it has written.
void expect_in_c(Workshop& workshop, const Core& core) {
  workshop.write("example_references.c", exports::exported_text("example_references.c.in"));
  const std::string alone = " -DVALVE_SENSOR_NO_MODEL ";
  const std::string objects = compiler(core) + alone + "-c valve_sensor.cpp " SPOOLFLOW_FIRMWARE "/board.cpp " +
                              SPOOLFLOW_FIRMWARE "/c_board.cpp && " + c_compiler(core) + alone +
                              "-Wno-unused-function -c " SPOOLFLOW_FIRMWARE "/c_references.c";
  const std::string linked = "arm-none-eabi-gcc valve_sensor.o board.o c_board.o c_references.o -o in_c.elf " +
                             options(core) + link() + "-lgcc";
  const Figures figures = figures_of(workshop.run(objects + " && " + linked + " && " + emulator(core, "in_c.elf")));
  EXPECT_EQ(figures.at("refusal"), 0U);
  EXPECT_EQ(figures.at("taken"), 22U);
  EXPECT_EQ(figures.at("apart"), 1U);
  EXPECT_EQ(figures.at("verdict"), static_cast<std::uint32_t>(sensor::MachineVerdict::moves));
  EXPECT_EQ(figures.at("changed_over"), 1U);
  EXPECT_GT(figures.at("end"), 50U);
  EXPECT_LT(figures.at("end"), 1000U);
  EXPECT_LT(figures.at("find"), 2000U);
  EXPECT_LT(figures.at("slice"), 2500U);
  EXPECT_LE(figures.at("bytes"), 512U);
  for (const char* figure : {"end", "find", "slice", "bytes"})
    ::testing::Test::RecordProperty(std::string("in_c_") + figure, static_cast<int>(figures.at(figure)));
}

TEST(MachineReferenceOnCortexM, AReferenceCostsLessThanAStepAndThePageIsMovedInSlices) {
  const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  Workshop workshop(model);
  workshop.write("valve.bin", exports::parameter_image(model, {"test", 1700000000U, false, true}));
  workshop.run("mv valve_model.hpp away.hpp");
  const Core& core = cores.front();
  const Figures figures = figures_of(workshop.run(compiler(core) +
                                                  " " SPOOLFLOW_FIRMWARE "/board.cpp " SPOOLFLOW_FIRMWARE
                                                  "/machine_reference.cpp -o reference.elf" +
                                                  link() + "-lgcc && " + emulator(core, "reference.elf")));
  EXPECT_EQ(figures.at("refusal"), 0U);
  EXPECT_EQ(figures.at("taken"), 22U);
  EXPECT_EQ(figures.at("apart"), 1U);
  EXPECT_EQ(figures.at("verdict"), static_cast<std::uint32_t>(sensor::MachineVerdict::moves));
  EXPECT_NEAR(figures.at("width_ppm"), 160000, 40000);
  EXPECT_EQ(figures.at("begin_refusal") + figures.at("spare_refusal"), 0U);
  EXPECT_EQ(figures.at("finished"), 1U);
  EXPECT_GT(figures.at("update"), 50U);
  EXPECT_LT(figures.at("update"), 1000U);
  EXPECT_LT(figures.at("finding"), 1000U);
  EXPECT_LT(figures.at("slice"), 2000U);
  EXPECT_LE(figures.at("state_bytes") + figures.at("move_bytes"), 512U);
  EXPECT_LT(figures.at("stack_bytes"), 512U);
  for (const char* figure : {"update", "finding", "slice", "state_bytes", "move_bytes", "stack_bytes"})
    RecordProperty(figure, static_cast<int>(figures.at(figure)));
  expect_in_c(workshop, core);
}

}  // namespace
}  // namespace spoolflow::cortex_m
