#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/export/sensor_fmu.hpp"
#include "tests/fmu/description_rules.hpp"
#include "tests/fmu/fmu_instance.hpp"

namespace spoolflow::exports {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Every function of the standard, as its header lists them.
std::vector<std::string> functions(FmiVersion version) {
  std::istringstream names(
      version == FmiVersion::fmi2
          ? "GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance SetupExperiment "
            "EnterInitializationMode "
            "ExitInitializationMode Terminate Reset GetReal GetInteger GetBoolean GetString SetReal SetInteger "
            "SetBoolean "
            "SetString GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate "
            "DeSerializeFMUstate "
            "GetDirectionalDerivative EnterEventMode NewDiscreteStates EnterContinuousTimeMode CompletedIntegratorStep "
            "SetTime SetContinuousStates GetDerivatives GetEventIndicators GetContinuousStates "
            "GetNominalsOfContinuousStates SetRealInputDerivatives GetRealOutputDerivatives DoStep CancelStep "
            "GetStatus "
            "GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus"
          : "GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation InstantiateScheduledExecution "
            "FreeInstance EnterInitializationMode ExitInitializationMode EnterEventMode Terminate Reset GetFloat32 "
            "GetFloat64 GetInt8 GetUInt8 GetInt16 GetUInt16 GetInt32 GetUInt32 GetInt64 GetUInt64 GetBoolean GetString "
            "GetBinary GetClock SetFloat32 SetFloat64 SetInt8 SetUInt8 SetInt16 SetUInt16 SetInt32 SetUInt32 SetInt64 "
            "SetUInt64 SetBoolean SetString SetBinary SetClock GetNumberOfVariableDependencies GetVariableDependencies "
            "GetFMUState SetFMUState FreeFMUState SerializedFMUStateSize SerializeFMUState DeserializeFMUState "
            "GetDirectionalDerivative GetAdjointDerivative EnterConfigurationMode ExitConfigurationMode "
            "GetIntervalDecimal GetIntervalFraction GetShiftDecimal GetShiftFraction SetIntervalDecimal "
            "SetIntervalFraction SetShiftDecimal SetShiftFraction EvaluateDiscreteStates UpdateDiscreteStates "
            "EnterContinuousTimeMode CompletedIntegratorStep SetTime SetContinuousStates GetContinuousStateDerivatives "
            "GetEventIndicators GetContinuousStates GetNominalsOfContinuousStates GetNumberOfEventIndicators "
            "GetNumberOfContinuousStates EnterStepMode GetOutputDerivatives DoStep ActivateModelPartition");
  std::vector<std::string> out;
  for (std::string name; names >> name;) out.push_back((version == FmiVersion::fmi2 ? "fmi2" : "fmi3") + name);
  return out;
}

class Description : public ::testing::TestWithParam<FmiVersion> {
 protected:
  const UnpackedFmu fmu{sensor_fmu_of_example(GetParam())};
};

TEST_P(Description, KeepsTheRulesOfTheStandard) {
  EXPECT_THAT(description_violations(fmu), IsEmpty());
}

TEST_P(Description, ShowsPressureFlowPositionAndTemperatureInTheUnitsOfTheField) {
  std::set<std::string> display;
  for (const XmlElement& variable : fmu.variables()) {
    if (variable.has("displayUnit")) display.insert(variable["displayUnit"]);
  }
  for (const char* unit : {"bar", "L/min", "mm", "degC"}) EXPECT_THAT(display, Contains(unit));
}

TEST_P(Description, LetsDriftFilterAndLimitsBeTuned) {
  std::set<std::string> tunable;
  for (const XmlElement& variable : fmu.variables()) {
    if (variable["variability"] == "tunable") tunable.insert(variable["name"]);
  }
  for (const char* name : {"drift.position_per_temperature", "drift.free_temperature", "filter.pressure_drift_sliding",
                           "filter.pressure_drift_resting", "filter.position_noise", "limit.acceleration",
                           "limit.closed_below", "limit.current"}) {
    EXPECT_THAT(tunable, Contains(name));
  }
}

TEST_P(Description, ComesWithALibraryThatExportsEveryFunctionOfTheStandard) {
  const FmuLibrary library(fmu);
  for (const std::string& name : functions(GetParam())) EXPECT_NE(library.symbol(name), nullptr) << name;
  const std::string windows = GetParam() == FmiVersion::fmi2 ? "binaries/win64/" : "binaries/x86_64-windows/";
  const std::string dll = fmu.content(windows + "spoolflow_sensor.dll");
  EXPECT_EQ(dll.substr(0, 2), "MZ");
  for (const std::string& name : functions(GetParam())) EXPECT_NE(dll.find(name + '\0'), std::string::npos) << name;
}

TEST_P(Description, ServesLinuxOn64BitArmWhereTheStandardNamesIt) {
  const std::string library = fmu.content("binaries/aarch64-linux/spoolflow_sensor.so");
  if (GetParam() == FmiVersion::fmi2) {
    EXPECT_EQ(library, "");
    return;
  }
  if (library.empty()) GTEST_SKIP() << "built without g++-aarch64-linux-gnu";
  EXPECT_EQ(library.substr(0, 4), "\177ELF");
  constexpr std::size_t machine = 18;
  EXPECT_EQ(static_cast<unsigned char>(library.at(machine)), 0xB7);  // EM_AARCH64
  for (const std::string& name : functions(GetParam())) EXPECT_NE(library.find(name + '\0'), std::string::npos) << name;
}

TEST_P(Description, ExplainsItsVariablesAndStatusBitsOnAPage) {
  const std::string page = fmu.content("documentation/index.html");
  for (const XmlElement& variable : fmu.variables()) EXPECT_THAT(page, HasSubstr("<td>" + variable["name"] + "</td>"));
  for (const auto& entry : sensor::status_names) EXPECT_THAT(page, HasSubstr(entry.name));
}

TEST_P(Description, HasATokenThatChangesWithTheModel) {
  model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  EXPECT_EQ(UnpackedFmu(sensor_fmu(model, GetParam(), "0.1.0")).token(), fmu.token());
  model.observer->parameters.closed_below_m += 1e-9;
  EXPECT_NE(UnpackedFmu(sensor_fmu(model, GetParam(), "0.1.0")).token(), fmu.token());
}

INSTANTIATE_TEST_SUITE_P(OfTheSensor, Description, ::testing::Values(FmiVersion::fmi2, FmiVersion::fmi3),
                         [](const auto& version) { return version.param == FmiVersion::fmi2 ? "Fmi2" : "Fmi3"; });

TEST(DescriptionRules, FindWhatIsWrong) {
  const UnpackedFmu good(sensor_fmu_of_example(FmiVersion::fmi2));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good.content("modelDescription.xml");
    text.replace(text.find(from), from.size(), to);
    const UnpackedFmu other(sensor_fmu_of_example(FmiVersion::fmi2), text);
    return description_violations(other);
  };
  EXPECT_THAT(with("unit=\"A\"", "unit=\"amp\""), Contains(HasSubstr("undefined unit amp")));
  EXPECT_THAT(with("valueReference=\"3\"", "valueReference=\"2\""), Contains(HasSubstr("reference twice")));
  EXPECT_THAT(with("<Unknown index=\"7\" dependencies=\"\"/>", ""), Contains(HasSubstr("exactly the outputs")));
  EXPECT_THAT(with("variability=\"tunable\"", "variability=\"continuous\""), Contains(HasSubstr("no combination")));
  EXPECT_THAT(with(" start=\"0\"", ""), Contains(HasSubstr("no start")));
}

}  // namespace
}  // namespace spoolflow::exports
