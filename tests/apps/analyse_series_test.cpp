/// `spoolflow analyse --series` as its user meets it.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/type/type_model.hpp"
#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string model_of_valve = SPOOLFLOW_EXAMPLE_MODEL;

class AnalyseSeries : public CommandLine {
 protected:
  Answer refused(const std::string& command) {
    Answer answer = run(command);
    EXPECT_EQ(answer.status, 2) << command;
    EXPECT_THAT(files(), Not(Contains("o.json"))) << "an output was left behind";
    return answer;
  }
};

TEST_F(AnalyseSeries, IsOfATypeAndOfAVirtualValveOfItsSize) {
  std::ofstream type(folder / "type.json");
  model::write_model(type,
                     calibration::type_model(model::read_model(model_of_valve), calibration::tolerances_from({})));
  type.close();
  write("s.toml", "[study]\nvalve = \"size_10\"\n");
  EXPECT_THAT(refused("analyse " + model_of_valve + " --series 2 --json o.json").message, HasSubstr("--as-type"));
  EXPECT_THAT(refused("analyse type.json --scenario s.toml --series 2 --json o.json").message,
              HasSubstr("name the type's valve by study.valve"));
  EXPECT_THAT(refused("analyse type.json --series 0 --json o.json").message, HasSubstr("--series"));
  EXPECT_THAT(refused("analyse type.json --series 2 --dither --json o.json").message, HasSubstr("excludes"));
}

}  // namespace
}  // namespace spoolflow::apps
