/// What `inspect` says of channel maps.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"
#include "tests/recording/tdms/tdms_file.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Inspect : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("rig.csv", "t;cur;x;remark\n0;1;1.0;5\n0.001;1;1.1;5\n0.002;1.1;1.2;5\n");
  }
};

TEST_F(Inspect, ProposesAMapWhereNoneWasGiven) {
  EXPECT_THAT(run("inspect rig.csv").output, HasSubstr("Proposed channel map"));
}

TEST_F(Inspect, WithAMapTellsWhatItLeavesOutInsteadOfProposingOne) {
  write("map.toml",
        "[channels]\ntime = { column = \"t\", unit = \"s\" }\ncurrent = { column = \"cur\", unit = \"A\" }\n"
        "position = { column = \"x\", unit = \"mm\" }\n");
  const Answer answer = run("inspect rig.csv --channels map.toml");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output, HasSubstr("Read with map.toml; columns that it does not name: remark\n"));
  EXPECT_THAT(answer.output, Not(HasSubstr("Proposed channel map")));
}

TEST_F(Inspect, NamesWhatIsNotRead) {
  using recording::TdmsMetadata;
  TdmsMetadata metadata;
  for (const char* channel : {"/'g'/'time_s'", "/'g'/'current_A'", "/'g'/'position_mm'"})
    metadata.channel(channel, TdmsMetadata::f64, 2);
  metadata.channel("/'g'/'oil'", TdmsMetadata::f64, 2).property("NI_Scale[0]_Scale_Type", "Thermocouple");
  write("rig.tdms",
        recording::tdms_segment(metadata.content(), recording::tdms_samples<double>({0, 0.001, 1, 1, 0, 1, 7, 7})));
  constexpr const char* words = "channel 'g/oil' holds a scale 'Thermocouple', which is not read";
  EXPECT_THAT(run("inspect rig.tdms").output, HasSubstr(std::string("Not read: ") + words));
  EXPECT_THAT(run("inspect --json rig.tdms").output, HasSubstr(std::string("\"unread\": [\"") + words));
}

/// Names that say nothing: time, position 12 ms after the current, voltage, oil temperature, current, a spare input.
std::string nameless_run() {
  std::string out = "n;A1;A2;A3;A4;A5\n";
  const auto current_A = [](int k) { return 1.2 + 0.5 * std::sin(0.004 * k) + 0.2 * std::sin(0.031 * k); };
  for (int k = 0; k < 3000; ++k) {
    out += fmt::format("{:.3f};{:.4f};{:.3f};{:.2f};{:.4f};7\n", 1e-3 * k, 0.9 * current_A(k - 12),
                       3.4 * current_A(k) + 0.3 * std::cos(0.031 * k), 45 + 0.001 * k, current_A(k));
  }
  return out;
}

TEST_F(Inspect, GuessesFromTheNumbersWhereNamesSayNothing) {
  write("lab.csv", nameless_run());
  const std::string output = run("inspect lab.csv").output;
  EXPECT_THAT(output, HasSubstr("time = { column = \"n\", unit = \"?\" }  # a guess, check it: it rises with every"));
  EXPECT_THAT(output,
              HasSubstr("current = { column = \"A4\", unit = \"?\" }  # a guess, check it: it rises 12 samples"));
  EXPECT_THAT(output, HasSubstr("position = { column = \"A1\""));
  EXPECT_THAT(output, HasSubstr("voltage = { column = \"A2\""));
  EXPECT_THAT(output, HasSubstr("oil_temperature = { column = \"A3\""));
  EXPECT_THAT(output, HasSubstr("Columns that are not used: A5"));
}

TEST_F(Inspect, OfAPipeSaysWhatItSaysOfTheFile) {
  write("lab.csv", nameless_run());
  const std::string of_file = run("inspect lab.csv").output;
  const Answer piped = run("inspect - -q < /dev/null");
  EXPECT_EQ(piped.status, 2);
  std::string of_pipe;
  {
    const Answer answer = run("--version > /dev/null; cat lab.csv | '" SPOOLFLOW_COMMAND "' inspect -");
    EXPECT_EQ(answer.status, 0) << answer.message;
    of_pipe = answer.output;
  }
  EXPECT_EQ(of_pipe.substr(of_pipe.find(':')), of_file.substr(of_file.find(':')));
}

TEST_F(Inspect, NamesWhatEverySensorNeedsAndTheFileLacks) {
  write("rig.csv", "t [s];I [A];p9 [bar]\n0;1;60\n0.001;1.1;60\n0.002;1.2;61\n");
  const std::string output = run("inspect rig.csv").output;
  EXPECT_THAT(output, HasSubstr("Needed and not found: position\n"));
  EXPECT_THAT(output,
              HasSubstr("# position = { column = \"?\", unit = \"mm\" }  # needed, and not found in the file\n"));
  EXPECT_THAT(output, HasSubstr("Columns that are not used: p9 [bar]\n"));
}

TEST_F(Inspect, TakesACapitalTForATemperatureAndASmallOneForTime) {
  write("rig.csv", "log/T;log/t_us;log/I;log/x\n50;0;1;1\n50;1000;1;1\n50;2000;1;1\n");
  const std::string output = run("inspect rig.csv").output;
  EXPECT_THAT(output, HasSubstr("time = { column = \"log/t_us\", unit = \"us\" }"));
  EXPECT_THAT(output, HasSubstr("oil_temperature = { column = \"log/T\""));
}

}  // namespace
}  // namespace spoolflow::apps
