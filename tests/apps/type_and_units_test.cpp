/// A type's units by the command: series page, updated type, plan, and what else takes their models.
#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/type/type_model.hpp"
#include "tests/apps/command_line.hpp"
#include "tests/calibration/type/virtual_unit.hpp"

namespace spoolflow::apps {
namespace {

using calibration::Variation;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class TypeAndUnits : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    model::Model valve = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
    valve.observer->parameters.position_sensor.drift_m_per_K = 0;  // the virtual units' positions have none
    type_ = calibration::type_model(std::move(valve), calibration::tolerances_from({}));
    std::ofstream out(folder / "type.json");
    model::write_model(out, type_);
  }
  /// units/NAME, one stroke with meter and pressure difference.
  void record(const std::string& name, const calibration::Deviations& deviations) const {
    const std::filesystem::path of_unit = folder / "units" / name;
    std::filesystem::create_directories(of_unit);
    std::ofstream(of_unit / "unit.toml") << fmt::format(
        "name = \"NG6 serial {}\"\n[[recording]]\nprotocol = \"operation\"\nfile = \"stroke.csv\"\n", name);
    constexpr double way_s = 2;
    calibration::write_strokes(of_unit / "stroke.csv",
                               calibration::unit_parameters(type_.observer->parameters, deviations), {40},
                               type_.valve.stroke_m, way_s);
  }
  void record_series() const {
    calibration::Deviations deviations{};
    for (const int serial : {11, 12, 13}) {
      deviations[at(Variation::spring_preload)] = 0.01 * (serial - 12);
      record(std::to_string(serial), deviations);
    }
    deviations[at(Variation::spring_rate)] = 0.25;
    record("14", deviations);
  }

  model::Model type_;
};

TEST_F(TypeAndUnits, ASeriesHasItsPageAndUpdatesItsType) {
  record_series();
  const Answer series =
      run("calibrate --type type.json units/11/unit.toml units/12/unit.toml units/13/unit.toml units/14/unit.toml "
          "-o models --report series.html --update-type next.json");
  EXPECT_EQ(series.status, 2);  // of the one that is refused
  EXPECT_THAT(series.message, AllOf(HasSubstr("the unit is not of the type"), HasSubstr("spring_rate +"),
                                    HasSubstr("4 units, 1 refused"), HasSubstr("Cpk from 25 units of the type on")));
  EXPECT_TRUE(std::filesystem::exists(folder / "models/13.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "models/14.json"));
  const std::string page = content("series.html");
  for (const char* text : {"3 of 4 units are of the type", "1 refused: no model was written", "spring preload",
                           "NG6 serial 14", "from 25 units on", "</html>"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_THAT(page, Not(HasSubstr("NG6 serial 12")));  // none of the outliers

  const Answer plan = run("plan next.json --seconds 14 -o plan.csv --scenario plan.toml");
  ASSERT_EQ(plan.status, 0) << plan.message;
  EXPECT_THAT(plan.message, HasSubstr("the sensor's band"));
  EXPECT_THAT(content("plan.csv"),
              HasSubstr("time_s,position_set_percent,pressure_difference_set_bar,dither_A\n0.00,"));
  EXPECT_THAT(run("plan next.json -o other.csv --scenario other.toml --valve size_7").message,
              HasSubstr("valve \"size_7\" is no preset; choose one of size_6"));
  EXPECT_FALSE(std::filesystem::exists(folder / "other.toml"));
  write("worn.toml", "preset = \"size_6\"\n");
  std::filesystem::create_directory(folder / "plans");
  ASSERT_EQ(run("plan next.json --seconds 14 -o other.csv --scenario plans/worn.toml --valve worn.toml -q").status, 0);
  EXPECT_THAT(content("plans/worn.toml"), HasSubstr("valve = \"../worn.toml\""));
  const Answer simulated = run("simulate plan.toml -o run.csv -q");
  ASSERT_EQ(simulated.status, 0) << simulated.message;

  const Answer by_type = run("estimate next.json run.csv -o flow.csv");
  EXPECT_EQ(by_type.status, 0) << by_type.message;
  EXPECT_THAT(by_type.message, HasSubstr("calibrate UNIT.toml --type next.json -o UNIT.json"));
  EXPECT_THAT(run("estimate models/12.json run.csv -o flow.csv").message, Not(HasSubstr("--type")));
}

TEST_F(TypeAndUnits, NoTwoUnitsOfASeriesHaveOneRecording) {
  record_series();
  std::filesystem::copy_file(folder / "units/11/stroke.csv", folder / "units/12/stroke.csv",
                             std::filesystem::copy_options::overwrite_existing);
  const Answer series = run("calibrate --type type.json units/11/unit.toml units/12/unit.toml -o models");
  EXPECT_EQ(series.status, 2);
  EXPECT_THAT(series.message, HasSubstr("units/12/stroke.csv and units/11/stroke.csv are the same file"));
  EXPECT_FALSE(std::filesystem::exists(folder / "models/12.json"));
}

TEST_F(TypeAndUnits, TwoUnitsOfOneNameAreDoubted) {
  record_series();
  const std::string series = "calibrate --type type.json units/11/unit.toml units/12/unit.toml -o models -q";
  EXPECT_EQ(run(series).message, "");
  std::filesystem::copy_file(folder / "units/11/unit.toml", folder / "units/12/unit.toml",
                             std::filesystem::copy_options::overwrite_existing);
  const Answer copied = run(series);
  EXPECT_EQ(copied.status, 0);
  EXPECT_THAT(copied.message,
              HasSubstr("doubt: units/12/unit.toml: the name is NG6 serial 11, as in units/11/unit.toml"));
}

TEST_F(TypeAndUnits, ASeriesOfUnitsWithoutTheirRecordingsHasNoPageAndSaysWhy) {
  record_series();
  for (const char* unit : {"12", "13", "14"}) std::filesystem::remove(folder / "units" / unit / "stroke.csv");
  for (const char* first : {"", "units/11/unit.toml "}) {
    const Answer series =
        run("calibrate --type type.json " + std::string(first) +
            "units/12/unit.toml units/13/unit.toml units/14/unit.toml -o models --report series.html");
    EXPECT_EQ(series.status, 2);
    EXPECT_THAT(series.message, AllOf(HasSubstr("units/13/stroke.csv does not exist"),
                                      HasSubstr(*first == 0 ? "nothing is written of the series: 0 of its 3 units"
                                                            : "nothing is written of the series: 1 of its 4 units")));
    EXPECT_THAT(files(), Not(Contains("series.html")));
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "models/11.json"));
}

TEST_F(TypeAndUnits, OfAWholeValveBothDirectionsArePlannedFittedAndComparedEachByItself) {
  std::ofstream(folder / "whole.json") << [] {
    model::Model valve = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
    valve.observer->parameters.position_sensor.drift_m_per_K = 0;
    std::ostringstream out;
    model::write_model(
        out, calibration::type_model(calibration::whole_of(std::move(valve)), calibration::tolerances_from({})));
    return out.str();
  }();
  for (const int serial : {1, 2, 3}) {
    const std::filesystem::path of_unit = folder / "whole" / std::to_string(serial);
    std::filesystem::create_directories(of_unit);
    std::ofstream(of_unit / "unit.toml") << "[[recording]]\nprotocol = \"operation\"\nfile = \"both.csv\"\n";
    calibration::Deviations deviations{};
    deviations[at(Variation::spring_preload)] = 0.01 * (serial - 2);
    const auto unit = calibration::unit_parameters(type_.observer->parameters, deviations);
    constexpr double pressure_bar = 40;
    calibration::write_whole_strokes(of_unit / "both.csv", unit, unit, pressure_bar, type_.valve.stroke_m);
  }
  const Answer series =
      run("calibrate --type whole.json whole/1/unit.toml whole/2/unit.toml whole/3/unit.toml -o models --report "
          "series.html "
          "--update-type next.json");
  EXPECT_EQ(series.status, 0) << series.message;
  for (const char* text : {"serial A, P to B", "serial A, P to A", "3 units, P to A, 0 refused"})
    EXPECT_THAT(series.message, HasSubstr(text));
  EXPECT_THAT(content("series.html"),
              AllOf(HasSubstr("of the type, P to B"), HasSubstr("Spread and capability, P to A")));
  EXPECT_TRUE(model::read_model(folder / "next.json").p_to_a->type.has_value());
  EXPECT_EQ(run("estimate models/2.json whole/2/both.csv -o estimate.csv").status, 0);
  const Answer plan = run("plan whole.json -o plan.csv --scenario plan.toml");
  EXPECT_EQ(plan.status, 0) << plan.message;
  EXPECT_THAT(content("plan.csv"), HasSubstr(",-100,"));
  EXPECT_THAT(content("plan.toml"),
              AllOf(HasSubstr("second_peak_percent = -100"), HasSubstr("valve = \"whole_size_6\"")));
  const auto refused = [&](const std::string& type_and_valve) {
    const Answer answer = run("plan " + type_and_valve + " -o other.csv --scenario other.toml");
    EXPECT_EQ(answer.status, 2);
    EXPECT_THAT(files(), AllOf(Not(Contains("other.csv")), Not(Contains("other.toml"))));
    return answer.message;
  };
  EXPECT_THAT(
      refused("whole.json --valve size_6"),
      HasSubstr("--valve size_6 is not whole, and the type whole.json is of both directions: `calibrate --type` "
                "would not take its recording; give one such as whole_size_6"));
  EXPECT_THAT(refused("type.json --valve whole_size_6"),
              HasSubstr("whole_size_6 is whole, and the type type.json is of one"));
}

TEST_F(TypeAndUnits, AUnitsModelIsTakenByMonitorValidateAndFlashPagesAsAnyValves) {
  record("12", {});
  ASSERT_EQ(run("calibrate units/12/unit.toml --type type.json -o unit.json -q").status, 0);
  ASSERT_EQ(run("monitor unit.json units/12/stroke.csv --json unit_condition.json -q").status, 0);
  EXPECT_THAT(content("unit_condition.json"), HasSubstr("\"of\": \"unit\""));
  const Answer by_type = run("validate type.json units/12/stroke.csv --json figures.json --report page.html");
  ASSERT_EQ(by_type.status, 0) << by_type.message;
  EXPECT_THAT(by_type.message, HasSubstr("the model of the type"));
  EXPECT_THAT(content("figures.json"), HasSubstr("\"of\": \"type\""));
  EXPECT_THAT(content("page.html"), HasSubstr("the model of the type, whose band holds all its units"));
  ASSERT_EQ(run("export parameters unit.json -o unit.bin").status, 0);
  EXPECT_THAT(run("inspect unit.bin").output, HasSubstr("NG6 serial 12"));
}

/// The same file with the pressure difference, the column of that number, in psi.
std::string pressure_in_psi(const std::string& csv) {
  constexpr double psi_per_bar = 14.503774;
  std::istringstream lines(csv);
  std::string out, line;
  std::getline(lines, line);
  std::size_t column = 0;
  for (std::size_t at = 0; at < line.find("pressure_difference_bar"); ++at) column += line[at] == ',' ? 1 : 0;
  out = line + '\n';
  while (std::getline(lines, line)) {
    std::size_t begin = 0;
    for (std::size_t k = 0; k < column; ++k) begin = line.find(',', begin) + 1;
    const std::size_t end = std::min(line.find(',', begin), line.size());
    out += line.substr(0, begin) + fmt::format("{:.3f}", psi_per_bar * std::stod(line.substr(begin, end - begin))) +
           line.substr(end) + '\n';
  }
  return out;
}

TEST_F(TypeAndUnits, AUnitsOperationInAnotherUnitOfPressureIsDoubtedAndTheModelSaysSo) {
  record("12", {});
  const Answer sound = run("calibrate units/12/unit.toml --type type.json -o unit.json");
  EXPECT_EQ(sound.status, 0);
  EXPECT_THAT(sound.message, Not(HasSubstr("doubt")));
  const std::string stroke = content("units/12/stroke.csv");
  write("units/12/stroke.csv", pressure_in_psi(stroke));
  const Answer answer = run("calibrate -q units/12/unit.toml --type type.json -o unit.json");
  EXPECT_THAT(answer.message, HasSubstr("pressure_difference looks in psi, not bar"));
  EXPECT_TRUE(answer.status == 2 || !model::read_model(folder / "unit.json").provenance.doubts.empty());
}

TEST_F(TypeAndUnits, AReportOrAnUpdateOfFewerThanThreeUnitsIsRefusedAndNothingIsWritten) {
  for (const char* option : {"--report series.html", "--update-type next.json"}) {
    const Answer answer =
        run(std::string("calibrate --type type.json units/1/unit.toml units/2/unit.toml -o models ") + option);
    EXPECT_EQ(answer.status, 2);
    EXPECT_THAT(answer.message, HasSubstr("a series of 3 units and more, and 2 are given"));
    EXPECT_THAT(files(), Not(Contains("models")));
  }
}

}  // namespace
}  // namespace spoolflow::apps
