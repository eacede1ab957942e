#include "spoolflow/export/cpp_folder.hpp"

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/export/cpp/cell_sums.hpp"
#include "spoolflow/numerics/single_precision.hpp"
#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"
#include "tests/export/exported_folder.hpp"

namespace spoolflow::exports {
namespace {

using numerics::single_precision;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* strict =
    " -std=c++17 -O2 -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wdouble-promotion -Wfloat-equal -Werror "
    "-I. ";
/// Behind `strict`: for programs that are compiled for what they answer, which takes half the time.
constexpr const char* unoptimised = "-O0 ";

model::Model without_observer() {
  model::Model model = example_model();
  model.observer.reset();
  return model;
}

model::Model whole_without_observer() {
  model::Model model = whole_example_model();
  model.p_to_a->observer.reset();
  return model;
}

std::vector<std::string> compilers() {
#ifdef SPOOLFLOW_CLANGXX
  return {"g++", SPOOLFLOW_CLANGXX};
#else
  return {"g++"};
#endif
}

TEST(CppFolder, StandsAloneAndAnswersAsTheHostWithoutAWarning) {
  for (const model::Model& model :
       {example_model(), without_observer(), whole_example_model(), whole_without_observer()}) {
    const ExportedFolder folder(model);
    for (const std::string& compiler : compilers()) {
      EXPECT_EQ(folder.run(compiler + strict + "self_test.cpp -o self_test && ./self_test"), 0) << compiler;
      EXPECT_EQ(folder.run(compiler + strict + unoptimised + "example.cpp -o example && ./example"), 0) << compiler;
    }
  }
}

/// Prints the bits of every answer over the golden points and what lies near them.
constexpr const char* answers_in_bits = R"(#include <cstdio>
#include "golden_points.hpp"
#include "valve_model.hpp"
template <class State, class Parameters>
void answer(const Parameters& parameters) {
  static State state;
  for (int round = 0; round < 7; ++round) {
    for (const auto& point : valve_model::golden_points) {
      auto sample = point.sample;
      sample.position_m += 1e-7F * static_cast<float>(round);
      const auto& now = step(parameters, state, sample);
      for (const float value : {now.flow_m3_per_s, now.flow_lower_m3_per_s, now.flow_upper_m3_per_s})
        std::printf("%08x ", spoolflow::sensor::bits_as<unsigned>(value));
      std::printf("%x\n", static_cast<unsigned>(now.status));
    }
  }
}
int main() {
  answer<valve_model::State>(valve_model::parameters);
  answer<valve_model::CondensedState>(valve_model::condensed);
}
)";

/// Each compiler with each standard, and each model with each of both: every pair, not every three.
TEST(CppFolder, AnswersToTheBitWithoutTheCompilersExtensions) {
  constexpr std::array standards{" -std=c++17", " -std=c++20"};
  std::size_t turn = 0;
  for (const model::Model& model : {example_model(), whole_example_model()}) {
    const ExportedFolder folder(model);
    folder.write("bits.cpp", answers_in_bits);
    ASSERT_EQ(folder.run("g++ -std=c++17 -O2 -I. bits.cpp -o bits && ./bits >with && test -s with"), 0);
    for (const std::string& compiler : compilers()) {
      const std::string build =
          compiler + standards[turn++ % 2] + " -O2 -Wall -Wextra -Wpedantic -Werror -DSPOOLFLOW_STANDARD_CPP -I. ";
      EXPECT_EQ(folder.run(build + "bits.cpp -o bits && ./bits >without && cmp with without"), 0) << build;
    }
    turn = 1;  // the other way round for the other model
  }
}

TEST(CppFolder, ServesFirmwareInC) {
  const std::string c_options = " -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Werror -I. ";
  for (const model::Model& model : {example_model(), whole_without_observer()}) {
    const ExportedFolder folder(model);
    for (const std::string& compiler : compilers()) {
      const std::string in_cpp = compiler + strict + "-fno-exceptions -fno-rtti -c valve_sensor.cpp";
      EXPECT_EQ(folder.run(in_cpp + " && cc" + c_options + "example.c valve_sensor.o -lm -o example_c && ./example_c"),
                0)
          << in_cpp;
    }
    EXPECT_EQ(folder.run("rm valve_model.hpp && g++" + std::string(strict) +
                         "-DVALVE_SENSOR_NO_MODEL -fsyntax-only valve_sensor.cpp"),
              0);
  }
}

TEST(CppFolder, SaysInCThatNothingIsKnownBeforeTheFirstSample) {
  for (const model::Model& model : {example_model(), whole_example_model(), without_observer()}) {
    const ExportedFolder folder(model);
    folder.write("before.c", R"(#include "valve_sensor.h"
int main(void) {
  static valve_sensor_state state;
  valve_sensor_answer answer;
  valve_sensor_init(&state);
  valve_sensor_answer_of(&state, &answer);
  if ((valve_sensor_status(&state) & VALVE_SENSOR_FAULT_BITS) == 0U || answer.status != valve_sensor_status(&state)) return 1;
  return answer.flow_lower_m3_per_s <= -1.0F && answer.flow_upper_m3_per_s >= 1.0F ? 0 : 2;
}
)");
    EXPECT_EQ(folder.run("g++" + std::string(strict) + unoptimised +
                         "-fno-exceptions -fno-rtti -c valve_sensor.cpp && cc -std=c99 -I. "
                         "before.c valve_sensor.o -lm -o before && ./before"),
              0);
  }
}

template <class State>
bool begins_with_zeros() {
  static const State state{};
  const std::vector<char> zeros(sizeof state);
  return std::memcmp(&state, zeros.data(), sizeof state) == 0;
}

TEST(CppFolder, OfTwoModelsMeetInOneProgramAndKeepTheirNumbers) {
  model::Model stiffer = example_model();
  for (double& force_N : stiffer.condensed.parameters.spring.curve.values) force_N *= 1.1;
  const ExportedFolder one(example_model()), other(stiffer);
  const auto object = [](const ExportedFolder& folder, const std::string& name) {
    folder.write(name + ".cpp", "#include \"valve_model.hpp\"\nconst void* " + name +
                                    "() { return &valve_model::condensed; }\nbool " + name +
                                    "_intact() { return valve_model::condensed_intact() && "
                                    "valve_model::tables_intact(); }\n");
    return folder.run(std::string("g++") + strict + "-Wno-missing-declarations -c " + name + ".cpp");
  };
  ASSERT_EQ(object(one, "one"), 0);
  ASSERT_EQ(object(other, "other"), 0);
  one.write("other.o", other.content("other.o"));
  one.write("main.cpp",
            "const void* one(); const void* other(); bool one_intact(); bool other_intact();\n"
            "int main() { return one() != other() && one_intact() && other_intact() ? 0 : 1; }\n");
  EXPECT_EQ(one.run("g++ main.cpp one.o other.o -o both && ./both"), 0);
}

TEST(CppFolder, InitialisesAStateInCAsInCpp) {
  EXPECT_TRUE(begins_with_zeros<sensor::ObserverState<float>>());
  EXPECT_TRUE(begins_with_zeros<sensor::CondensedState<float>>());
  EXPECT_TRUE(begins_with_zeros<sensor::WholeValveState<float>>());
  EXPECT_TRUE(begins_with_zeros<sensor::WholeCondensedState<float>>());
}

TEST(CppFolder, SelfTestNamesTheSensorThatWentAstray) {
  const ExportedFolder folder(example_model());
  const std::string golden = folder.content("golden_points.hpp");
  const std::string build = std::string("g++") + strict + unoptimised + "self_test.cpp -o self_test && ./self_test";
  // One point in the middle of the strokes gets other flows: 0.2 % of 80 L/min on top.
  std::string line, condensed_wrong, best_wrong;
  std::istringstream lines(golden);
  for (int k = 0; std::getline(lines, line); ++k) {
    const auto samples_end = line.find("}, ");
    if (k == 400 && samples_end != std::string::npos) {
      const auto comma = line.find(", ", samples_end + 3);
      condensed_wrong += line.substr(0, samples_end + 3) + "2.7e-6F + " + line.substr(samples_end + 3) + "\n";
      best_wrong += line.substr(0, comma + 2) + "2.7e-6F + " + line.substr(comma + 2) + "\n";
    } else {
      condensed_wrong += line + "\n";
      best_wrong += line + "\n";
    }
  }
  ASSERT_NE(condensed_wrong, golden);
  folder.write("golden_points.hpp", condensed_wrong);
  EXPECT_EQ(folder.run(build), 1);
  folder.write("golden_points.hpp", best_wrong);
  EXPECT_EQ(folder.run(build), 2);
}

TEST(CppFolder, SelfTestFindsASingleWrongNumberOfTheTables) {
  const ExportedFolder folder(example_model());
  const std::string tables = folder.content("valve_model.hpp");
  const std::string build = std::string("g++") + strict + unoptimised + "self_test.cpp -o self_test && ./self_test";
  // A number in the middle of a table of the observer loses its sign or gains one.
  for (const char* table : {"SPOOLFLOW_TABLE auto condensed", "SPOOLFLOW_TABLE auto observer"}) {
    const std::size_t at = tables.find("    ", tables.find("\n", tables.find(table)) + 4000) + 4;
    ASSERT_LT(at, tables.size());
    std::string wrong = tables;
    wrong.insert(at, wrong[at] == '-' ? "2.0F " : "1e-4F + ");
    folder.write("valve_model.hpp", wrong);
    EXPECT_GE(folder.run(build), 4) << wrong.substr(at, 40);
  }
}

/// Of every 97th number that is not zero, made a tenth larger in turn, the share that the sums over the cells find.
template <class Tables>
double share_found(const Tables& sound, const std::vector<float>& cells) {
  EXPECT_TRUE(cells_agree(sound, cells));
  const auto tables = std::make_unique<Tables>(sound);
  int found = 0, all = 0;
  for (std::size_t at = 0; at + sizeof(float) <= sizeof(Tables); at += 97 * sizeof(float)) {
    char* const place = reinterpret_cast<char*>(tables.get()) + at;
    float number = 0;
    std::memcpy(&number, place, sizeof number);
    if (number == 0) continue;
    const float wrong = 1.1F * number;
    std::memcpy(place, &wrong, sizeof wrong);
    found += cells_agree(*tables, cells) ? 0 : 1;
    ++all;
    std::memcpy(place, &number, sizeof number);
  }
  return static_cast<double>(found) / all;
}

template <class Tables>
std::vector<float> cells_of(const Tables& tables) {
  std::vector<float> out;
  sensor::CondensedState<double> state{};
  sum_cells(tables, state, [&](const CellSum<double>& row) { out.push_back(static_cast<float>(row.sum)); });
  return out;
}

TEST(CppFolder, SelfTestFindsMostSingleWrongNumbersByWhatTheTablesAnswer) {
  const model::Model model = example_model();
  const auto tables = std::make_unique<sensor::CondensedTables<double>>();
  sensor::lay_out(model.condensed.parameters, *tables);
  EXPECT_GT(share_found(single_precision(*tables), cells_of(*tables)), 0.8);
  const auto& observer = model.observer->parameters;
  EXPECT_GT(share_found(single_precision(observer), cells_of(observer)), 0.9);
}

/// The mark of the headers' version in an exported file: "of_1a2b3c4d".
std::string mark_in(const std::string& header) {
  constexpr std::string_view before = "namespace spoolflow::sensor { inline namespace ";
  const std::size_t at = header.find(before);
  return at == std::string::npos ? "" : header.substr(at + before.size(), std::string_view("of_1a2b3c4d").size());
}

TEST(CppFolder, HoldsTheSensorsHeadersUnchangedButForANamespaceOfTheirVersion) {
  std::size_t headers = 0;
  for (const ExportedFile& file : cpp_folder(without_observer())) {
    if (!file.name.starts_with("spoolflow/sensor/")) continue;
    std::ifstream source(SPOOLFLOW_SOURCES "/" + file.name, std::ios::binary);
    std::string expected{std::istreambuf_iterator<char>(source), {}};
    const std::string begins = "namespace spoolflow::sensor {\n", ends = "}  // namespace spoolflow::sensor\n";
    expected.insert(expected.find(begins) + begins.size() - 1, " inline namespace " + mark_in(file.content) + " {");
    expected.insert(expected.find(ends), "}");
    EXPECT_EQ(file.content, expected) << file.name;
    ++headers;
  }
  EXPECT_GT(headers, 15U);
}

/// How wide the band is a tenth of a second after the position went, in L/min; in a program whose other source holds
/// an export of another version, by whose constant a band opens ten times as slowly.
constexpr const char* band_without_position = R"(#include "valve_model.hpp"
float NAME() {
  static valve_model::State state;
  for (int k = 0; k < 500; ++k) step(valve_model::parameters, state, {1e-3F, 1.5F, 5.0F, 1e-3F, 318.0F});
  for (int k = 0; k < 100; ++k) step(valve_model::parameters, state, {1e-3F, 1.5F, 5.0F, __builtin_nanf(""), 318.0F});
  return 6e4F * (state.last.flow_upper_m3_per_s - state.last.flow_lower_m3_per_s);
}
)";

TEST(CppFolder, OfTwoVersionsDoNotMixInOneProgram) {
  const ExportedFolder one(example_model()), other(example_model());
  const std::string mark = mark_in(one.content("spoolflow/sensor/basis/sample.hpp"));
  ASSERT_EQ(mark.size(), 11U);
  ASSERT_EQ(
      other.run("sed -i s/unobserved_stroke_s.=.0.4/'unobserved_stroke_s = 4.0'/ spoolflow/sensor/basis/sample.hpp && "
                "grep -q 4.0 spoolflow/sensor/basis/sample.hpp && "
                "grep -rl " +
                mark.substr(3) + " . | xargs sed -i s/" + mark.substr(3) + "/01234567/"),
      0);
  const auto compile = [](const ExportedFolder& folder, const std::string& name) {
    std::string source = band_without_position;
    folder.write("band.cpp", source.replace(source.find("NAME"), 4, name));
    ASSERT_EQ(folder.run("g++ -std=c++17 -O0 -I. -c band.cpp"), 0);
  };
  compile(one, "of_one");
  compile(other, "of_other");
  one.write("main.cpp", "float of_one(); float of_other(); int main() { return of_one() > 2 * of_other() ? 0 : 1; }\n");
  ASSERT_EQ(one.run("cp " + other.path() + "/band.o other.o"), 0);
  for (const char* order : {"band.o other.o", "other.o band.o"})
    EXPECT_EQ(one.run(std::string("g++ main.cpp ") + order + " -o main && ./main"), 0) << order;
}

TEST(CppFolder, OfAWholeValveHoldsBothDirectionsAndTheirHeaders) {
  model::Model model = whole_example_model();
  model.p_to_a->observer->parameters.largest_current_A = 2.71875;
  const ExportedFolder folder(model);
  const std::string header = folder.content("valve_model.hpp");
  for (const char* name : {"condensed_b", "condensed_a", "observer_b", "observer_a"}) {
    EXPECT_THAT(header, HasSubstr("auto " + std::string(name) + " = ")) << name;
  }
  const auto of_a = header.find("2.71875F");
  EXPECT_GT(of_a, header.find("auto observer_a = "));
  EXPECT_LT(of_a, header.find("WholeValveParameters<float> observer{&observer_b, &observer_a}"));
  EXPECT_THAT(header, HasSubstr("whole_valve = true"));
  EXPECT_NE(folder.content("spoolflow/sensor/whole_valve/whole_valve.hpp"), "");
  EXPECT_THAT(folder.content("README.md"), HasSubstr("both solenoids"));
  EXPECT_THAT(ExportedFolder(example_model()).content("README.md"), Not(AnyOf(HasSubstr("@"), HasSubstr("solenoids"))));
}

TEST(CppFolder, SaysThatAModelHasNoObserver) {
  const ExportedFolder folder(without_observer());
  EXPECT_THAT(folder.content("README.md"), HasSubstr("not calibrated for the observer"));
  EXPECT_THAT(folder.content("valve_model.hpp"), HasSubstr("has_observer = false"));
  EXPECT_THAT(ExportedFolder(example_model()).content("README.md"), Not(HasSubstr("not calibrated")));
}

TEST(CppFolder, KeepsAValvesNameOutOfTheCode) {
  model::Model model = without_observer();
  model.valve.name = "A \"B\" ?\?/ \\\n#error";
  const ExportedFolder folder(model);
  EXPECT_EQ(folder.run(std::string("g++") + strict + "example.cpp -o example && ./example"), 0);
  model.valve.name = "*/ #error /*";
  EXPECT_EQ(ExportedFolder(model).run("cc -std=c99 -Wall -Wextra -Werror -I. -fsyntax-only example.c"), 0);
}

TEST(CppFolder, RefusesANumberThatSinglePrecisionDoesNotHold) {
  model::Model model = without_observer();
  model.condensed.parameters.force_residual_N = 1e39;
  EXPECT_THROW((void)cpp_folder(model), std::invalid_argument);
}

}  // namespace
}  // namespace spoolflow::exports
