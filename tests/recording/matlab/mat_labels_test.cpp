/// Logs of Simulink and timeseries saved as structs, written with matio in either format.
#include "spoolflow/recording/matlab/mat_labels.hpp"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/inspection.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::size_t log_samples = 300;

using Fields = std::vector<std::pair<std::string, matvar_t*>>;

matvar_t* numbers(std::vector<std::size_t> size, double (*value)(std::size_t)) {
  std::size_t count = 1;
  for (const std::size_t one : size) count *= one;
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) values[k] = value(k);
  return Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<int>(size.size()), size.data(), values.data(),
                       0);
}
matvar_t* text(std::string content) {
  std::size_t size[2]{1, content.size()};
  return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, size, content.data(), 0);
}
matvar_t* cell(const std::vector<std::string>& texts) {
  std::vector<matvar_t*> cells;
  for (const std::string& one : texts) cells.push_back(text(one));
  std::size_t size[2]{1, texts.size()};
  return Mat_VarCreate(nullptr, MAT_C_CELL, MAT_T_CELL, 2, size, cells.data(), 0);
}
matvar_t* structs(const std::vector<Fields>& elements) {
  std::vector<const char*> names;
  for (const auto& field : elements.front()) names.push_back(field.first.c_str());
  std::size_t size[2]{1, elements.size()};
  matvar_t* const out = Mat_VarCreateStruct("", 2, size, names.data(), static_cast<unsigned>(names.size()));
  for (std::size_t k = 0; k < elements.size(); ++k) {
    for (const auto& field : elements[k]) Mat_VarSetStructFieldByName(out, field.first.c_str(), k, field.second);
  }
  return out;
}

double log_time_s(std::size_t k) {
  return 1e-3 * static_cast<double>(k);
}
double current_A(std::size_t k) {
  return 1 + 1e-3 * static_cast<double>(k % log_samples);
}
double position_m(std::size_t k) {
  return 1e-3 + 1e-6 * static_cast<double>(k % log_samples);
}
double temperature_C(std::size_t) {
  return 45;
}

/// What `inspect` makes of a file with these variables.
Inspection inspected(const std::map<std::string, matvar_t*>& variables, mat_ft format) {
  const TemporaryFile file("log.mat");
  mat_t* const mat = Mat_CreateVer(file.path().c_str(), nullptr, format);
  for (const auto& [name, variable] : variables) {
    matvar_t* const named = Mat_VarDuplicate(variable, 1);
    free(named->name);
    named->name = strdup(name.c_str());
    Mat_VarWrite(mat, named, format == MAT_FT_MAT5 ? MAT_COMPRESSION_ZLIB : MAT_COMPRESSION_NONE);
    Mat_VarFree(named);
    Mat_VarFree(variable);
  }
  Mat_Close(mat);
  Inspection out = inspect(file.path(), {}, [](std::optional<double>, std::uint64_t) {});
  // The proposed map is one with which the file is read.
  const Recording run = read_recording(
      file.path(),
      {.channels = out.proposal, .required = {Channel::current, Channel::position}, .optional = {}, .stroke_m = {}});
  EXPECT_EQ(run.size(), log_samples);
  EXPECT_NEAR(run[Channel::current][10], current_A(10), 1e-12);
  EXPECT_NEAR(run[Channel::position][10], position_m(10), 1e-12);
  return out;
}

std::string proposed_for(const Inspection& found, Channel channel) {
  const auto source = found.proposal.sources.find(channel);
  return source == found.proposal.sources.end() ? "" : source->second.column + " in " + source->second.unit;
}

Fields signal(matvar_t* values, matvar_t* label, const std::string& block, double columns) {
  std::size_t one[2]{1, 1};
  return {{"values", values},
          {"dimensions", Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, one, &columns, 0)},
          {"label", label},
          {"blockName", text(block)}};
}

class MatLabels : public ::testing::TestWithParam<mat_ft> {};

TEST_P(MatLabels, OfAStructureWithTimeNameCurrentPositionAndOilTemperature) {
  // The oil stands first and still, and the position before the current: no order of the signals identifies them.
  matvar_t* const log =
      structs({{{"time", numbers({log_samples, 1}, log_time_s)},
                {"signals",
                 structs({signal(numbers({log_samples, 1}, temperature_C), text("Oil temperature [C]"), "rig/Scope", 1),
                          signal(numbers({log_samples, 1}, position_m), text("Position [m]"), "rig/Scope", 1),
                          signal(numbers({log_samples, 1}, current_A), text("Current [A]"), "rig/Scope", 1)})},
                {"blockName", text("rig/Scope")}}});
  const Inspection found = inspected({{"log", log}}, GetParam());
  EXPECT_EQ(proposed_for(found, Channel::time), "log.time in s");
  EXPECT_EQ(proposed_for(found, Channel::current), "log.signals(3).values in A");
  EXPECT_EQ(proposed_for(found, Channel::position), "log.signals(2).values in m");
  EXPECT_EQ(proposed_for(found, Channel::oil_temperature), "log.signals(1).values in C");
  EXPECT_THAT(found.remarks, SizeIs(0));           // nothing is a guess
  EXPECT_THAT(found.contents.columns, SizeIs(4));  // dimensions and blockName are no columns
  EXPECT_EQ(found.columns.back().why, "by its label 'Current [A]'");
}

TEST_P(MatLabels, OfASignalOfSeveralColumnsNameEachColumn) {
  const auto log = [](matvar_t* label) {
    return structs(
        {{{"time", numbers({log_samples, 1}, log_time_s)},
          {"signals",
           structs({signal(
               numbers({log_samples, 2}, [](std::size_t k) { return k < log_samples ? current_A(k) : position_m(k); }),
               label, "rig/Scope", 2)})}}});
  };
  for (matvar_t* const label : {cell({"Current [A]", "Position [m]"}), text("<Current [A]>, <Position [m]>")}) {
    const Inspection found = inspected({{"log", log(label)}}, GetParam());
    EXPECT_EQ(proposed_for(found, Channel::current), "log.signals.values(:,1) in A");
    EXPECT_EQ(proposed_for(found, Channel::position), "log.signals.values(:,2) in m");
  }
}

TEST_P(MatLabels, OfSignalsOfMatricesRunAlongTheLastDimension) {
  matvar_t* const log = structs(
      {{{"time", numbers({log_samples, 1}, log_time_s)},
        {"signals", structs({signal(numbers({1, 1, log_samples}, current_A), text("Current [A]"), "a/b", 1),
                             signal(numbers({1, 1, log_samples}, position_m), text("Position [m]"), "a/c", 1)})}}});
  EXPECT_EQ(proposed_for(inspected({{"log", log}}, GetParam()), Channel::current), "log.signals(1).values in A");
}

TEST_P(MatLabels, MayBeTheBlockThatASignalComesFrom) {
  matvar_t* const log = structs(
      {{{"time", numbers({log_samples, 1}, log_time_s)},
        {"signals", structs({signal(numbers({log_samples, 1}, current_A), text(""), "rig/coil/Current [A]", 1),
                             signal(numbers({log_samples, 1}, position_m), text(""), "rig/Position [m]", 1)})}}});
  EXPECT_EQ(proposed_for(inspected({{"log", log}}, GetParam()), Channel::current), "log.signals(1).values in A");
}

TEST_P(MatLabels, AreTheNamesOfTimeseriesAndOfADatasetsElements) {
  const auto series = [](double (*value)(std::size_t), const std::string& name, const std::string& unit) {
    return structs({{{"Name", text(name)},
                     {"Time", numbers({log_samples, 1}, log_time_s)},
                     {"Data", numbers({log_samples, 1}, value)},
                     {"DataInfo", structs({{{"Units", text(unit)}}})},
                     {"TimeInfo", structs({{{"Units", text("seconds")}}})}}});
  };
  const Inspection single =
      inspected({{"ts1", series(position_m, "Position", "m")}, {"ts2", series(current_A, "Current", "A")}}, GetParam());
  EXPECT_EQ(proposed_for(single, Channel::current), "ts2.Data in A");
  EXPECT_EQ(proposed_for(single, Channel::position), "ts1.Data in m");
  EXPECT_EQ(proposed_for(single, Channel::time), "ts2.Time in s");
  const Inspection set =
      inspected({{"ds", structs({{{"Name", text("Position")}, {"Values", series(position_m, "", "m")}},
                                 {{"Name", text("Current")}, {"Values", series(current_A, "", "A")}}})}},
                GetParam());
  EXPECT_EQ(proposed_for(set, Channel::current), "ds(2).Values.Data in A");
  EXPECT_EQ(proposed_for(set, Channel::position), "ds(1).Values.Data in m");
}

TEST_P(MatLabels, LeaveASignalWithoutANameToItsNumbersAndSayThatItIsAGuess) {
  matvar_t* const log = structs(
      {{{"time", numbers({log_samples, 1}, log_time_s)},
        {"signals", structs({signal(numbers({log_samples, 1}, current_A), text("Current [A]"), "rig/Scope", 1),
                             signal(numbers({log_samples, 1}, position_m), text("Position [m]"), "rig/Scope", 1),
                             signal(numbers({log_samples, 1}, temperature_C), text(""), "rig/Scope", 1)})}}});
  EXPECT_EQ(proposed_for(inspected({{"log", log}}, GetParam()), Channel::oil_temperature), "");
}

INSTANTIATE_TEST_SUITE_P(OfVersion, MatLabels, ::testing::Values(MAT_FT_MAT5, MAT_FT_MAT73),
                         [](const auto& of) { return of.param == MAT_FT_MAT5 ? "5" : "73"; });

}  // namespace
}  // namespace spoolflow::recording
