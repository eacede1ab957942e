/// What `inspect` says of channel maps.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

TEST_F(Inspect, WithAMapListsWhatItLeavesOutInsteadOfProposingOne) {
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
  EXPECT_THAT(std::string(nlohmann::json::parse(run("inspect --json rig.tdms").output)["unread"][0]), HasSubstr(words));
}

TEST_F(Inspect, OfAFolderSaysWhatIsMissingForWhichModelInMinutes) {
  std::string dry = "time_s,position_mm,current_A,voltage_V,pressure_difference_bar\n";
  for (int k = 0; k <= 400; ++k)
    dry += fmt::format("{},{},{},3,0.1\n", 0.06 * k, 2.4 * (1 - std::abs(k / 200.0 - 1)), 0.6 + 0.001 * k);
  std::filesystem::create_directory(folder / "bench");
  write("bench/dry.csv", dry);
  write("bench/foreign.csv", "a;b\n1;2\n2;3\n");
  std::filesystem::create_symlink("no_such_drive/wet.csv", folder / "bench/wet.csv");
  const Answer answer = run("inspect bench");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output,
              HasSubstr("wet.csv                          serves no test: bench/wet.csv: cannot be opened"));
  EXPECT_THAT(answer.output, HasSubstr("unpressurised_strokes"));
  EXPECT_THAT(answer.output, HasSubstr("foreign.csv                      serves no test: "));
  EXPECT_THAT(answer.output, HasSubstr("Model from flow bench: missing, 4 min on the bench:\n  metering"));
  EXPECT_THAT(answer.output, HasSubstr("Model from unit of a type: everything needed is there"));
  const auto models = nlohmann::json::parse(run("inspect --json bench").output)["models"];
  EXPECT_TRUE(std::ranges::any_of(
      models, [](const auto& model) { return model["kind"] == "unit of a type" && model["complete"] == true; }));
  const Answer refused = run("inspect bench --protocol spring");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.message, HasSubstr("bench is a folder"));
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

TEST_F(Inspect, GuessesFromOneWordOfANameBeforeItDoesFromTheNumbers) {
  std::string lines = "Timestamp [us];PLC.rVoltage;PLC.rCurrent;PLC.rCurrentSet;PLC.rPosition;PositionLimit\n";
  for (int k = 0; k < 200; ++k)
    lines += fmt::format("{};{};{};{};{};7\n", 1000 * k, 5 + k % 9, 1 + k % 5, 1 + k % 4, k % 7);
  write("plc.csv", lines);
  const std::string output = run("inspect plc.csv").output;
  EXPECT_THAT(output,
              HasSubstr("current = { column = \"PLC.rCurrent\", unit = \"?\" }  # a guess, check it: its name holds "
                        "the word 'current'"));
  EXPECT_THAT(output, HasSubstr("voltage = { column = \"PLC.rVoltage\""));
  EXPECT_THAT(output, HasSubstr("position = { column = \"PLC.rPosition\""));
  write("logger.csv", "timestamp,current_A,position_mm\n1795860000000,1,1\n1795860000002,1,1\n");
  EXPECT_THAT(run("inspect logger.csv").output,
              HasSubstr("unit = \"ms\" }  # a guess, check it: in ms it counts from 1970"));
  write("can.csv", "Time[s];Current::MsgA[mA];Position::MsgB[%];Position::MsgC[%]\n0;1;1;2\n1;1;1;2\n");
  const std::string two = run("inspect can.csv").output;
  EXPECT_THAT(two, HasSubstr("current = { column = \"Current::MsgA[mA]\", unit = \"mA\" }"));
  EXPECT_THAT(two, HasSubstr("# position = { column = \"?\""));
}

TEST_F(Inspect, SaysThatTimesHaveTooFewDigits) {
  std::string lines = "time_s,current_A,position_mm\n";
  for (int k = 0; k < 1000; ++k) lines += fmt::format("{:.3f},1,1\n", 1e-4 * k + 1e-5);
  write("rounded.csv", lines);
  EXPECT_THAT(run("inspect rounded.csv").output,
              HasSubstr("samples repeat the time stamp before them (9.9 have the same time on average: write the times "
                        "with more digits)"));
}

TEST_F(Inspect, OfAScopeGuessesFromUnitsAndFromWhatFollowsTheCurrent) {
  std::string lines = "Time,Channel A,Channel B,Channel C\n(ms),(A),(V),(V)\n\n";
  const auto current_A = [](int k) { return 1.2 + 0.5 * std::sin(0.004 * k) + 0.2 * std::sin(0.031 * k); };
  for (int k = 0; k < 3000; ++k)
    lines += fmt::format("{},{:.4f},{:.3f},{:.4f}\n", k, current_A(k), 3.4 * current_A(k) + 0.3 * std::cos(0.031 * k),
                         5 * current_A(k - 12));
  write("scope.csv", lines);
  const std::string output = run("inspect scope.csv").output;
  EXPECT_THAT(output, HasSubstr("current = { column = \"Channel A\", unit = \"A\" }  # a guess, check it: no other"));
  EXPECT_THAT(output, HasSubstr("voltage = { column = \"Channel B\", unit = \"V\" }  # a guess"));
  EXPECT_THAT(output,
              HasSubstr("position = { column = \"Channel C\", unit = \"V\", scale = 1.0, offset = 0.0, to = \"?\" }"));
  write("hand.csv", "t [ms];A: Strom [A];B: Weg [mm]\n0;0;0\n1;1;1\n");
  EXPECT_THAT(run("inspect hand.csv").output, HasSubstr("position = { column = \"B: Weg [mm]\", unit = \"mm\" }\n"));
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

/// Three channels of one group, 0.3 s at 1 kHz, with their units beside their names; `more`: a fourth one.
std::string grouped_run(const std::string& more = "", double third = 0) {
  using recording::TdmsMetadata;
  constexpr std::size_t samples = 300;
  TdmsMetadata metadata;
  std::vector<double> values;
  const auto add = [&](const std::string& name, const std::string& unit, double (*value)(double)) {
    metadata.channel("/'Bench'/'" + name + "'", TdmsMetadata::f64, samples).property("unit_string", unit);
    for (std::size_t k = 0; k < samples; ++k) values.push_back(value(1e-3 * static_cast<double>(k)));
  };
  add("time_s", "s", [](double time_s) { return time_s; });
  add("current_A", "A", [](double time_s) { return 1 + time_s; });
  add("position_mm", "mm", [](double time_s) { return 0.5 + time_s; });
  if (!more.empty()) add(more, "", [](double time_s) { return 2 + time_s; });
  if (!more.empty()) values[3 * samples + 2] = third;
  return recording::tdms_segment(metadata.content(), recording::tdms_samples<double>(values));
}

TEST_F(Inspect, KnowsChannelsInAGroupWhoseUnitStandsBesideTheName) {
  write("rig.tdms", grouped_run());
  const std::string output = run("inspect rig.tdms").output;
  EXPECT_THAT(output, HasSubstr("current = { column = \"Bench/current_A\", unit = \"A\" }\n"));
  EXPECT_THAT(output, HasSubstr("position = { column = \"Bench/position_mm\", unit = \"mm\" }\n"));
  EXPECT_THAT(output, Not(HasSubstr("Needed and not found")));
  EXPECT_THAT(output, Not(HasSubstr("current_a")));
}

TEST_F(Inspect, TakesPressuresOfAllFourPortsForThoseAndOfTwoForBothSidesOfAnEdge) {
  write("ports.csv",
        "t [s];x [mm];iA [A];iB [A];pP [bar];pA [bar];pB [bar];pT [bar]\n0;0;0;1;90;9;60;2\n1;1;0;1;91;9;61;2\n");
  const std::string four = run("inspect ports.csv").output;
  EXPECT_THAT(four,
              HasSubstr("pressure_p = { column = \"pP [bar]\", unit = \"bar\" }  # of a bench that opens P to B"));
  EXPECT_THAT(four, HasSubstr("pressure_a = { column = \"pA [bar]\", unit = \"bar\" }\n"));
  EXPECT_THAT(four, HasSubstr("pressure_t = { column = \"pT [bar]\", unit = \"bar\" }\n"));
  write("edge.csv", "t [s];x [mm];i [A];pP [bar];pB [bar]\n0;0;1;90;60\n1;1;1;91;61\n");
  EXPECT_THAT(run("inspect edge.csv").output,
              HasSubstr("pressure_downstream = { column = \"pB [bar]\", unit = \"bar\" }\n"));
}

TEST_F(Inspect, KnowsTheLettersOfFormulasAndTheWordsOfGermanBenches) {
  write("bench.csv",
        "Zeit [s];spool_pos [mm];Ventilstrom [A];\xCE\x94p [bar];\xCF\x91_\xC3\x96l [\xC2\xB0"
        "C]\n0;0;1;60;50\n1;1;1;60;50\n");
  const std::string said = run("inspect bench.csv").output;
  for (const char* channel : {"position", "current", "pressure_difference", "oil_temperature"})
    EXPECT_THAT(said, HasSubstr(std::string("\n") + channel + " = { column = "));
}

TEST_F(Inspect, SaysWhichColumnCouldBeAChannelAsWell) {
  write("two.csv", "t [s];strom [A];i [A];x [mm]\n0;1;2;1\n0.001;1;2;1\n0.002;1;2;1\n");
  const std::string output = run("inspect two.csv").output;
  EXPECT_THAT(output, HasSubstr("current = { column = \"strom [A]\", unit = \"A\" }  # a guess, check it: it could be "
                                "'i [A]' as well"));
}

TEST_F(Inspect, OfTwoColumnsOfOneNameProposesAMapThatNamesOne) {
  write("rig.csv", "t [s];I [A];I [A];x [mm]\n0;1;2;1\n0.001;1;2;1\n0.002;1.1;2;1.1\n");
  const std::string output = run("inspect rig.csv").output;
  EXPECT_THAT(output, HasSubstr("current = { column = \"I [A] #1\", unit = \"A\" }  # a guess, check it: it could be "
                                "'I [A] #2' as well"));
  write("map.toml", output.substr(output.find("[channels]")));
  EXPECT_EQ(run("inspect rig.csv --channels map.toml").status, 0);
  write("map.toml", "[channels]\ntime = { column = \"t [s]\", unit = \"s\" }\ncurrent = { column = \"I [A]\" }\n");
  EXPECT_THAT(run("inspect rig.csv --channels map.toml").message, HasSubstr("choose 'I [A] #1', 'I [A] #2'"));
}

TEST_F(Inspect, OfTwoColumnsOfTimeProposesAMapThatNamesOne) {
  write("rig.csv", "time_s,time_s,current_A,position_mm\n0,0,1,1\n0.001,0.001,1,1\n0.002,0.002,1.1,1.1\n");
  const Answer answer = run("inspect rig.csv");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output,
              HasSubstr("time = { column = \"time_s #1\", unit = \"s\" }  # a guess, check it: it could be "
                        "'time_s #2' as well"));
  write("map.toml", answer.output.substr(answer.output.find("[channels]")));
  EXPECT_EQ(run("inspect rig.csv --channels map.toml").status, 0);
}

TEST_F(Inspect, ShowsAnExportOfTwinCatScopeOfWhichNoChannelIsKnown) {
  write("scope.csv",
        "Name\tScope\nFile\tx\nStarttime of "
        "export\t1\tMonday\n\nName\tvalve17\tName\tvalve18\nUnit\t(None)\tUnit\t(None)\n\n"
        "0\t1\t0\t2\n1\t1\t0.5\t2\n2\t1\t1\t3\n");
  const Answer answer = run("inspect scope.csv");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output, HasSubstr("4 columns: time of valve17, valve17, time of valve18, valve18"));
}

TEST_F(Inspect, RefusesFilesThatAreNoRecordingsWithStatus2) {
  write("list.json", "[{\"t\": 0}]\n");
  write("run.json", "{\"t\": [0]}\n");
  write("page.html", "<html>\n<body>1,2</body>\n");
  write("letter.txt", "Hello,\nthe valve sticks.\n");
  write("picture.png", "\x89PNG\r\n\x1A\nIHDR");
  for (const char* const file : {"list.json", "run.json", "page.html", "letter.txt", "picture.png"}) {
    const Answer answer = run(std::string("inspect ") + file);
    EXPECT_EQ(answer.status, 2) << file;
    EXPECT_THAT(answer.message, HasSubstr(file));
    EXPECT_EQ(answer.output, "") << file;
  }
}

TEST_F(Inspect, NamesAColumnWithAnInfiniteValueAndShowsTheOthers) {
  write("rig.tdms", grouped_run("gain", -INFINITY));
  write("rig.csv", "time_s,current_A,position_mm,gain\n0,1,1,3\n0.001,1,1,3\n0.002,1.1,1.1,-inf\n");
  for (const char* const file : {"rig.tdms", "rig.csv"}) {
    const Answer answer = run(std::string("inspect ") + file);
    EXPECT_EQ(answer.status, 0) << answer.message;
    EXPECT_THAT(answer.output, HasSubstr("gain' holds 1 infinite value, the first one (-inf) at sample 3"));
    EXPECT_THAT(answer.output, HasSubstr("current_A"));
  }
  const nlohmann::json gain{{"column", "gain"}, {"count", 1}, {"first_sample", 3}, {"negative", true}};
  EXPECT_EQ(nlohmann::json::parse(run("inspect --json rig.csv").output)["infinite"], nlohmann::json::array({gain}));
}

TEST_F(Inspect, NamesAnInfiniteValueOfAChannelThatAMapNames) {
  write("rig.csv", "t,cur,x\n0,1,1\n0.001,inf,1\n0.002,1.1,1.1\n");
  write("map.toml",
        "[channels]\ntime = { column = \"t\", unit = \"s\" }\ncurrent = { column = \"cur\", unit = \"A\" }\n");
  const Answer answer = run("inspect rig.csv --channels map.toml");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output, HasSubstr("'cur' holds 1 infinite value, the first one (inf) at sample 2"));
}

TEST_F(Inspect, SaysWhyAColumnHoldsNoNumbers) {
  write("rig.csv", "time_s,current_A,remark,spare,mixed\n0,1,a,,a\n0.001,1,b,,\n0.002,1.1,c,,inf\n");
  const std::string output = run("inspect rig.csv").output;
  EXPECT_THAT(output, HasSubstr("not used; no numbers: text in all 3 cells"));
  EXPECT_THAT(output, HasSubstr("not used; no numbers: all 3 samples are missing"));
  EXPECT_THAT(output, HasSubstr("not used; no numbers: of 3 samples 1 are missing, 1 text, 1 infinite"));
}

TEST_F(Inspect, ProposesNoColumnWithoutNumbersForAChannel) {
  write("rig.csv", "t [s],I,I2 [A],x [mm],Weg [mm]\n0,25.1m,1,off,1\n0.001,26m,1,off,1\n0.002,27m,1.1,off,1.1\n");
  const std::string output = run("inspect rig.csv").output;
  EXPECT_THAT(output, HasSubstr("not used; no numbers: text in all 3 cells, such as '25.1m' in line 2"));
  EXPECT_THAT(output, Not(HasSubstr("current = { column = \"I\"")));
  EXPECT_THAT(output, HasSubstr("position = { column = \"Weg [mm]\", unit = \"mm\" }\n"));
  write("rig.csv", "t [s],I,x [mm]\n0,25 mA,1\n0.001,26 mA,1\n0.002,0.027 A,1.1\n");
  EXPECT_THAT(run("inspect rig.csv").output, HasSubstr("current = { column = \"I\", unit = \"mA\" }\n"));
}

TEST_F(Inspect, SaysWhetherAFileServesAProtocol) {
  write("spring.csv", "time_s,position_mm,axial_force_N\n0,0,1\n0.01,0.1,2\n0.02,0.2,3\n");
  const Answer serves = run("inspect spring.csv --protocol spring");
  EXPECT_EQ(serves.status, 0) << serves.message;
  EXPECT_THAT(serves.output, HasSubstr("the file serves it"));
  const Answer lacks = run("inspect spring.csv --protocol solenoid_force_map");
  EXPECT_EQ(lacks.status, 1);
  EXPECT_THAT(lacks.output, HasSubstr("the file does not serve it"));
  EXPECT_THAT(lacks.output, HasSubstr("current                  needed         not found"));
  EXPECT_THAT(lacks.output, HasSubstr("Missing: spring.csv: channel force is missing"));
  EXPECT_THAT(run("inspect spring.csv --protocol operation").output, HasSubstr("has no flow of a reference meter"));
  const auto protocol = nlohmann::json::parse(run("inspect --json spring.csv --protocol spring").output)["protocol"];
  EXPECT_EQ(protocol["name"], "spring");
  EXPECT_EQ(protocol["serves"], true);
  EXPECT_EQ(run("inspect spring.csv --protocol springs").status, 2);
}

TEST_F(Inspect, JudgesAProtocolByTheProposedMapAndByWhatTheColumnsHold) {
  write("lab.csv", "t [s];weg [mm];Fax [N]\n0;0;1\n0.01;0.1;2\n0.02;0.2;3\n");
  EXPECT_EQ(run("inspect lab.csv --protocol spring").status, 0);
  write("lab.csv", "t [s];weg [mm];Fax\n0;0;1\n0.01;0.1;2\n0.02;0.2;3\n");
  EXPECT_THAT(run("inspect lab.csv --protocol spring").output,
              HasSubstr("column 'Fax' could be channel axial_force, whose unit the file does not state"));
  write("lab.csv", "time_s,position_mm,axial_force_N\n0,0,inf\n0.01,0.1,2\n0.02,0.2,3\n");
  EXPECT_THAT(run("inspect lab.csv --protocol spring").output,
              HasSubstr("column 'axial_force_N' holds 1 infinite values, the first at sample 1"));
}

}  // namespace
}  // namespace spoolflow::apps
