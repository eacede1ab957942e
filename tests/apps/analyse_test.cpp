/// `spoolflow analyse` as its user meets it.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::HasSubstr;

const std::string analysed_model = SPOOLFLOW_EXAMPLE_MODEL;

/// Little of everything, so that it takes a second.
constexpr const char* small = R"(
[points]
positions_percent = [50]
pressure_differences_bar = [40]
[monte_carlo]
trials = 200
[map]
positions = 3
pressure_differences = 2
)";

class Analyse : public CommandLine {};

TEST_F(Analyse, ReproducesTheKnownIndicesOfIshigami) {
  const Answer answer = run("analyse --self-check ishigami --json -");
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.output, HasSubstr("\"passed\": true"));
}

TEST_F(Analyse, GivesTheSameBytesWithAnyNumberOfThreads) {
  write("s.toml", std::string(small) + "[study]\nskip = true\n");
  ASSERT_EQ(run("analyse " + analysed_model + " --scenario s.toml --json one.json --report one.html --jobs 1").status,
            0);
  ASSERT_EQ(
      run("analyse " + analysed_model + " --scenario s.toml --json three.json --report three.html --jobs 3").status, 0);
  EXPECT_EQ(content("one.json"), content("three.json"));
  EXPECT_EQ(content("one.html"), content("three.html"));
  EXPECT_THAT(content("one.html"), HasSubstr("Improve the "));
  ASSERT_EQ(run("analyse " + analysed_model + " --scenario s.toml --json other.json --seed 2").status, 0);
  EXPECT_NE(content("one.json"), content("other.json"));
}

TEST_F(Analyse, TakesTheScenarioThatItPrints) {
  const Answer printed = run("analyse --print-scenario");
  ASSERT_EQ(printed.status, 0);
  write("s.toml", printed.output);
  const Answer refused = run("analyse no_model.json --scenario s.toml");
  EXPECT_THAT(refused.message, HasSubstr("no_model.json"));
  std::string changed = printed.output;
  changed.replace(changed.find("skip = false"), 12, "skip = true ");
  changed.replace(changed.find("trials = 10000"), 14, "trials = 100  ");
  changed.replace(changed.find("positions = 20"), 14, "positions = 2 ");
  changed.replace(changed.find("pressure_differences = 12"), 25, "pressure_differences = 2 ");
  write("s.toml", changed);
  EXPECT_EQ(run("analyse " + analysed_model + " --scenario s.toml --json o.json").status, 0);
}

TEST_F(Analyse, RefusesAWrongScenarioInOneLineThatNamesTheRemedy) {
  const auto refused = [&](const std::string& text) {
    write("s.toml", text);
    const Answer answer = run("analyse " + analysed_model + " --scenario s.toml --json o.json");
    EXPECT_EQ(answer.status, 2) << text;
    EXPECT_EQ(std::count(answer.message.begin(), answer.message.end(), '\n'), 1) << answer.message;
    EXPECT_EQ(files(), (std::vector<std::string>{"s.toml"})) << "an output was left behind";
    return answer.message;
  };
  EXPECT_THAT(refused("[points]\nposition_percent = [50]\n"), HasSubstr("positions_percent"));
  EXPECT_THAT(refused("[points]\npositions_percent = [150]\n"), HasSubstr("1 to 100"));
  EXPECT_THAT(refused("[points]\npositions_percent = []\n"), HasSubstr("at least one number"));
  EXPECT_THAT(refused("[points]\npairs = true\npressure_differences_bar = [10]\n"), HasSubstr("pairs"));
  EXPECT_THAT(refused("[study]\nvalve = \"size_7\"\n"), HasSubstr("size_6"));
  EXPECT_THAT(refused("[study.spread]\noil_coldest_C = 80\n"), HasSubstr("oil_warmest_C"));
  EXPECT_THAT(refused("seed = \n"), HasSubstr("s.toml"));
}

TEST_F(Analyse, RefusesToOverwriteItsInputs) {
  write("s.toml", small);
  const Answer answer = run("analyse " + analysed_model + " --scenario s.toml --json s.toml");
  EXPECT_EQ(answer.status, 2);
  EXPECT_EQ(content("s.toml"), small);
}

TEST_F(Analyse, WritesItsPageInTheUnitsAskedForAndRefusesOthers) {
  write("s.toml",
        "[points]\npositions_percent = [50]\npressure_differences_bar = [40]\n[monte_carlo]\ntrials = 100\n"
        "[map]\npositions = 2\npressure_differences = 2\n[study]\nskip = true\n");
  const std::string command = "analyse " + analysed_model + " --scenario s.toml --report r.html --json o.json --units ";
  EXPECT_EQ(run(command + "psi,gal/min").status, 0);
  EXPECT_THAT(content("r.html"), HasSubstr("580 psi"));
  EXPECT_EQ(content("r.html").find("40 bar"), std::string::npos);
  EXPECT_THAT(content("o.json"), HasSubstr("\"pressure_difference_bar\": 40.0")) << "files keep their units";
  const Answer refused = run(command + "psi,furlong");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.message, HasSubstr("'furlong' is none of L/min, m3/h, gal/min, bar"));
}

TEST_F(Analyse, SaysWhereNoPointLiesInsideTheMaps) {
  write("s.toml",
        "[points]\npressure_differences_bar = [300]\n[map]\npositions = 2\npressure_differences = 2\n"
        "[study]\nskip = true\n");
  const Answer answer = run("analyse " + analysed_model + " --scenario s.toml --json o.json --report r.html");
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.output, HasSubstr("No point of the scenario lies inside the calibrated maps"));
  EXPECT_TRUE(content("o.json").find("\"inside_maps\": true") == std::string::npos);
}

TEST_F(Analyse, RecommendsADither) {
  write("s.toml", "[points]\npositions_percent = [50]\npressure_differences_bar = [40]\n");
  const std::string command = "analyse " + analysed_model + " --scenario s.toml --dither ";
  const Answer answer = run(command + "--json o.json --report r.html --units psi");
  ASSERT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output, HasSubstr("Dither at "));
  EXPECT_THAT(content("o.json"), HasSubstr("\"format\": \"spoolflow dither\""));
  EXPECT_THAT(content("r.html"), HasSubstr("How to dither"));
  EXPECT_THAT(content("r.html"), HasSubstr("580"));
  const Answer strict = run(command + "--ripple-limit 0.001");
  EXPECT_EQ(strict.status, 0);
  EXPECT_THAT(strict.output, HasSubstr("No dither"));
}

TEST_F(Analyse, RefusesAWrongQuestionAboutDither) {
  const auto refused = [&](const std::string& arguments) {
    const Answer answer = run("analyse " + analysed_model + " " + arguments);
    EXPECT_EQ(answer.status, 2) << arguments;
    EXPECT_EQ(std::count(answer.message.begin(), answer.message.end(), '\n'), 1) << answer.message;
    EXPECT_EQ(files(), (std::vector<std::string>{"s.toml"})) << "an output was left behind";
    return answer.message;
  };
  write("s.toml", "[points]\npressure_differences_bar = [340]\n");
  EXPECT_THAT(refused("--dither --scenario s.toml --json o.json"), HasSubstr("none of the working points"));
  EXPECT_THAT(refused("--dither --ripple-limit 0"), HasSubstr("--ripple-limit"));
  EXPECT_THAT(refused("--dither --dither-shape round"), HasSubstr("sine"));
  EXPECT_THAT(refused("--ripple-limit 1"), HasSubstr("--dither"));
  EXPECT_THAT(refused("--dither --samples 8"), HasSubstr("--samples"));
}

}  // namespace
}  // namespace spoolflow::apps
