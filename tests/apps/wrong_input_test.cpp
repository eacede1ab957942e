/// Input that cannot be used: each is refused with a message that says where, what and what to do, with exit status 2,
/// and with the output of an earlier run left as it was.
#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"
#include "tests/apps/matlab_file.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class WrongInput : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    fs::copy_file(SPOOLFLOW_EXAMPLE_MODEL, folder / "model.json");
    write("run.csv", table(header, rows()));
    write("out", "result of an earlier run");
    before_ = files();
  }

  /// Expects that `arguments` is refused for the reason given, leaving all files as they were.
  void expect_refused(const std::string& arguments, const std::vector<std::string>& reasons) const {
    const Answer answer = run(arguments);
    EXPECT_EQ(answer.status, 2) << arguments;
    EXPECT_THAT(answer.output, IsEmpty()) << arguments;
    EXPECT_THAT(answer.message, StartsWith("spoolflow " + arguments.substr(0, arguments.find(' ')) + ": "));
    for (const std::string& reason : reasons) EXPECT_THAT(answer.message, HasSubstr(reason)) << arguments;
    EXPECT_EQ(std::count(answer.message.begin(), answer.message.end(), '\n'), 1) << answer.message;
    EXPECT_EQ(content("out"), "result of an earlier run") << arguments;
  }

  /// What a stream does with it: a header that cannot be used ends it, what is no sample is held over.
  enum class InAStream { refused, answered };

  void expect_recording_refused(const std::string& text, const std::vector<std::string>& reasons,
                                InAStream streamed = InAStream::refused) const {
    write("bad.csv", text);
    expect_refused("estimate model.json bad.csv -o out", reasons);
    expect_refused("estimate model.json bad.csv --estimator condensed -o out", reasons);
    expect_refused("validate model.json bad.csv --report out --json metrics.json", {"bad.csv"});
    EXPECT_FALSE(fs::exists(folder / "metrics.json"));
    const Answer piped = run("estimate model.json - -o out < bad.csv");
    if (streamed == InAStream::refused) {
      EXPECT_EQ(piped.status, 2);
      EXPECT_EQ(content("out"), "result of an earlier run");
    } else {
      EXPECT_EQ(piped.status, 0) << piped.message;
      EXPECT_THAT(content("out"), StartsWith("time_s,flow_L_min,"));
      write("out", "result of an earlier run");
    }
    fs::remove(folder / "bad.csv");
    EXPECT_EQ(files(), before_);
  }

  void expect_model_refused(const std::string& text, const std::vector<std::string>& reasons) const {
    write("bad.json", text);
    expect_refused("estimate bad.json run.csv -o out", reasons);
    expect_refused("validate bad.json run.csv --report out --json metrics.json", reasons);
    fs::remove(folder / "bad.json");
    EXPECT_EQ(files(), before_);
  }

  [[nodiscard]] std::string changed_model(const std::function<void(nlohmann::json&)>& change) const {
    nlohmann::json model = nlohmann::json::parse(content("model.json"));
    change(model);
    return model.dump(1);
  }

  using Row = std::vector<std::string>;
  /// A slow opening at rising current, all values plausible.
  [[nodiscard]] static std::vector<Row> rows() {
    std::vector<Row> out;
    for (int k = 0; k < 50; ++k) {
      out.push_back({fmt::format("{:.3f}", 0.001 * k), fmt::format("{:.4f}", 0.5 + 0.001 * k),
                     fmt::format("{:.3f}", 3.0 + 0.004 * k), fmt::format("{:.4f}", 0.3 + 0.002 * k), "50.0"});
    }
    return out;
  }
  [[nodiscard]] static std::string table(const std::string& head, const std::vector<Row>& rows) {
    std::string text = head;
    for (const Row& row : rows) text += fmt::format("{}\n", fmt::join(row, ","));
    return text;
  }
  static constexpr const char* header = "time_s,current_A,voltage_V,position_mm,oil_temperature_C\n";

 private:
  std::vector<std::string> before_;
};

TEST_F(WrongInput, IsNotWhatTheUntouchedFilesAre) {
  const Answer answer = run("estimate model.json run.csv -o out");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(content("out"), StartsWith("time_s,flow_L_min,"));
}

TEST_F(WrongInput, EmptyFile) {
  expect_recording_refused("", {"bad.csv", "empty"});
}

TEST_F(WrongInput, HeaderWithoutSamples) {
  expect_recording_refused(header, {"bad.csv", "no samples"});
}

TEST_F(WrongInput, TextInANumberColumn) {
  auto lines = rows();
  lines[10][1] = "overload";
  expect_recording_refused(table(header, lines), {"bad.csv, line 12", "current_A", "overload"}, InAStream::answered);
}

TEST_F(WrongInput, InfinityWrittenOut) {
  for (const char* word : {"inf", "-Infinity", "1e999"}) {
    auto lines = rows();
    lines[10][3] = word;
    expect_recording_refused(table(header, lines), {"bad.csv, line 12", "position_mm", word}, InAStream::answered);
  }
}

TEST_F(WrongInput, MissingChannel) {
  expect_recording_refused(table("time_s,I,voltage_V,position_mm,oil_temperature_C\n", rows()),
                           {"bad.csv", "channel current is missing", "channel map"});
}

TEST_F(WrongInput, UnitThatDoesNotFit) {
  expect_recording_refused(table("time_s,current_bar,voltage_V,position_mm,oil_temperature_C\n", rows()),
                           {"bad.csv", "current_bar", "allowed: A, mA"});
  expect_recording_refused(table("time_s,current_A,voltage_V,position_m,oil_temperature_C\n", rows()),
                           {"bad.csv", "position", "is its unit mm instead"}, InAStream::answered);
  const auto with_position = [](double per_mm) {
    std::vector<Row> lines = rows();
    for (Row& row : lines) row[3] = fmt::format("{:.3f}", per_mm * std::stod(row[3]));
    return table(header, lines);
  };
  constexpr double um = 1000, percent_of_stroke = 100 / 2.4;
  expect_recording_refused(with_position(um), {"bad.csv, line 2", "is its unit um instead"}, InAStream::answered);
  expect_recording_refused(with_position(percent_of_stroke), {"bad.csv", "percent of the stroke instead"},
                           InAStream::answered);
}

TEST_F(WrongInput, TimeRunningBackwards) {
  auto lines = rows();
  std::swap(lines[20], lines[21]);
  expect_recording_refused(table(header, lines), {"bad.csv, line 23", "backwards"}, InAStream::answered);
}

TEST_F(WrongInput, RecordingThatIsNotThere) {
  expect_refused("estimate model.json nothere.csv -o out", {"nothere.csv", "No such file"});
}

TEST_F(WrongInput, TruncatedHdf5File) {
  const std::string whole = bytes_of(SPOOLFLOW_EXAMPLES "/valve_a/ramp_60bar.h5");
  write("whole.h5", whole);
  EXPECT_EQ(run("estimate model.json whole.h5 -o other").status, 0);
  for (const std::size_t kept : {whole.size() / 2, whole.size() - 1, std::size_t{100}}) {
    write("cut.h5", whole.substr(0, kept));
    expect_refused("estimate model.json cut.h5 -o out", {"cut.h5", "HDF5"});
  }
}

TEST_F(WrongInput, TruncatedMatFile) {
  std::vector<MatlabVariable> variables{{"time_s", {}}, {"current_A", {}}, {"position_mm", {}}};
  for (const Row& row : rows()) {
    variables[0].values.push_back(std::stod(row[0]));
    variables[1].values.push_back(std::stod(row[1]));
    variables[2].values.push_back(std::stod(row[3]));
  }
  const std::string whole = matlab_v5_file(variables);
  write("whole.mat", whole);
  const Answer read = run("estimate model.json whole.mat -o other");
  EXPECT_EQ(read.status, 0) << read.message;
  for (const std::size_t kept : {whole.size() / 2, whole.size() - 8, std::size_t{130}}) {
    write("cut.mat", whole.substr(0, kept));
    expect_refused("estimate model.json cut.mat -o out", {"cut.mat"});
  }
}

TEST_F(WrongInput, CampaignNamingAMissingFile) {
  write("campaign.toml", bytes_of(SPOOLFLOW_EXAMPLES "/valve_a/campaign.toml"));
  expect_refused("calibrate campaign.toml -o out", {"campaign.toml, line ", "spring.h5", "does not exist"});
  expect_refused("calibrate nothere.toml -o out", {"nothere.toml"});
}

TEST_F(WrongInput, ModelFileCutShort) {
  const std::string whole = content("model.json");
  expect_model_refused(whole.substr(0, whole.size() / 2), {"bad.json", "cut short"});
  expect_model_refused("", {"bad.json", "empty"});
  expect_refused("estimate run.csv run.csv -o out", {"run.csv", "not valid JSON"});
  expect_model_refused(std::string("SFLWPARM\0\0\1", 11),
                       {"bad.json", "is no text", "of a flash page or an FMU give the model"});
}

TEST_F(WrongInput, ModelFileOfAnotherVersion) {
  const std::string text = changed_model([](nlohmann::json& model) { model["version"] = 99; });
  expect_model_refused(text, {"bad.json", "/version", "99", "calibrate again"});
}

TEST_F(WrongInput, NaNInAModelTable) {
  const auto with = [&](const nlohmann::json& value) {
    return changed_model(
        [&](nlohmann::json& model) { model["condensed"]["magnetic_force_N"]["values"][3][4] = value; });
  };
  expect_model_refused(with(nullptr), {"bad.json", "/condensed/magnetic_force_N/values/3/4"});
  std::string text = with(123456789);
  text.replace(text.find("123456789"), 9, "NaN");
  expect_model_refused(text, {"bad.json", "NaN"});
}

TEST_F(WrongInput, ModelTableThatDoesNotIncrease) {
  const std::string text =
      changed_model([](nlohmann::json& model) { model["condensed"]["magnetic_force_N"]["current_A"][4] = 0.0; });
  expect_model_refused(text, {"bad.json", "/condensed/magnetic_force_N/current_A/4", "rise"});
}

TEST_F(WrongInput, ModelTableThatIsMissing) {
  const std::string text = changed_model([](nlohmann::json& model) { model["condensed"].erase("spring_force_N"); });
  expect_model_refused(text, {"bad.json", "/condensed", "spring_force_N"});
}

TEST_F(WrongInput, ScenarioThatIsNone) {
  write("bad.toml", "protocol, valve\n");
  expect_refused("simulate bad.toml -o out", {"bad.toml, line 1", "correct the TOML there"});
  write("bad.toml", "valve = \"size_6\"\n");
  expect_refused("simulate bad.toml -o out", {"bad.toml", "protocol is missing"});
  write("bad.toml", "protocol = \"rampes\"\n");
  expect_refused("simulate bad.toml -o out", {"bad.toml, line 1", "rampes"});
}

}  // namespace
}  // namespace spoolflow::apps
