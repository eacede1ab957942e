#include "spoolflow/model/model.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/recording/temporary_file.hpp"

namespace spoolflow::model {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

template <class T>
sensor::Axis<T> axis(T first, T spacing) {
  return {first, spacing, 1 / spacing};
}

Model small_model() {
  Model model{};
  model.valve = {"test valve", 80 / 60000.0, 2.4e-3, "b"};
  model.fluid = {"HLP46", 874.0, std::nullopt, 6.8e-6};
  model.provenance = {"0.1.0", "2026-01-02T03:04:05Z", {{"spring", "spring.csv", std::string(64, 'a'), 4200}}};
  auto& p = model.condensed.parameters;
  p.magnetic_force.map.row_axis = p.magnetic_force.hysteresis_half_width_N.axis = axis(0.0, 0.08125);
  p.magnetic_force.map.column_axis = axis(-5e-6, 7.8e-5);
  for (std::size_t k = 0; k < p.magnetic_force.map.values.size(); ++k) {
    p.magnetic_force.map.values[k] = 0.1 * static_cast<double>(k) + 1.0 / 3;
  }
  p.spring.curve.axis = p.friction_half_width_N.axis = axis(0.0, 7.5e-5);
  p.flow_rate.largest_force_N.axis = p.flow_rate.flow_m3_per_s.row_axis =
      p.flow_rate.root_pressure_difference.row_axis = axis(0.0, 5e-5);
  p.flow_rate.flow_m3_per_s.column_axis = p.flow_rate.root_pressure_difference.column_axis = axis(0.0, 1.0 / 16);
  p.flow_rate.largest_force_N.values.fill(0.7);
  p.closed_below_m = 2.5e-4;
  p.force_residual_N = 0.12;
  model.condensed.current_A = {0, 2.6};
  model.condensed.position_m = {0, 2.4e-3};
  model.condensed.pressure_difference_Pa = {5e5, 70e5};
  model.condensed.residuals = {{"spring force", "N", 0.04, 0.16}};
  model.evidence.magnetic_force = {{0.2, {0, 1e-3}, {1, 2}, {3, 4}}};
  model.evidence.axial_force = {{5e5, {0, 1e-3}, {1, 2}, {3, 4}, {5, 6}, {5e5, 5e5}}};
  model.evidence.sensitivity = {{0, 1e-3}, {5e5, 70e5}, {1, 2, 3, 4}};
  model.evidence.uniqueness = {1e-4, 2e-4, {}};
  return model;
}

std::string written(const Model& model) {
  std::ostringstream out;
  write_model(out, model);
  return out.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Model, KeepsWhatTheCampaignSaysOfItsInstrumentsAndNothingWhereItSaysNothing) {
  Model model = small_model();
  EXPECT_THAT(written(model), Not(HasSubstr("instruments")));
  model.instruments.force_N = 0.25;
  const Model read = parse_model(written(model), "m.json");
  EXPECT_EQ(read.instruments.force_N, 0.25);
  EXPECT_FALSE(read.instruments.current_A);
}

TEST(Model, NamesTheCylinderThatItIsForAndNothingUnderEqualFlows) {
  Model model = small_model();
  EXPECT_THAT(written(model), Not(HasSubstr("area_ratio")));
  model.valve.load_area_ratio = 0.6;
  EXPECT_EQ(parse_model(written(model), "m.json").valve.load_area_ratio, 0.6);
  const std::string beyond = replaced(written(model), "\"load_area_ratio\": 0.6", "\"load_area_ratio\": 60");
  EXPECT_THAT([&] { (void)parse_model(beyond, "m.json"); },
              ThrowsMessage<ModelError>(HasSubstr("/valve/load_area_ratio")));
}

TEST(Model, ComesBackBitForBitFromItsFile) {
  const Model model = small_model();
  const std::string text = written(model);
  const Model back = parse_model(text, "model.json");
  EXPECT_EQ(back.condensed.parameters.magnetic_force.map.values, model.condensed.parameters.magnetic_force.map.values);
  EXPECT_EQ(back.fluid.density_15C_kg_per_m3, 874.0);
  EXPECT_FALSE(back.fluid.viscosity_40C_m2_per_s.has_value());
  EXPECT_FALSE(back.condensed.oil_temperature_K.has_value());  // missing means not calibrated, never zero
  EXPECT_EQ(back.provenance.tool_version, "0.1.0");
  EXPECT_EQ(written(back), text);
}

TEST(Model, RemembersHowEachQuantityIsKnownAndGivesADirectionItsOwn) {
  Model model = small_model();
  EXPECT_THAT(written(model), Not(HasSubstr("quantities")));
  model.provenance.quantities = {{"b", "spring force", "inferred", "unpressurised_strokes", "N", 0.4},
                                 {"a", "moving mass", "assumed", "as usual", "1"}};
  const std::string text = written(model);
  const std::vector<KnownQuantity> back = parse_model(text, "model.json").provenance.quantities;
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].from, "unpressurised_strokes");
  EXPECT_EQ(back[0].uncertainty_95, 0.4);
  EXPECT_EQ(back[1].of, "moving mass");
  EXPECT_FALSE(back[1].uncertainty_95);  // not known is not zero
  EXPECT_THAT([&] { (void)parse_model(replaced(text, "\"how\": \"assumed\"", "\"how\": \"guessed\""), "m.json"); },
              ThrowsMessage<ModelError>(HasSubstr("/provenance/quantities/1/how")));
  model.p_to_a = Direction{};
  const std::vector<KnownQuantity> of_a = of_direction(model, "a").provenance.quantities;
  ASSERT_EQ(of_a.size(), 1U);
  EXPECT_EQ(of_a[0].of, "moving mass");
}

TEST(Model, RemembersThatItsRecordingsWereSimulated) {
  Model model = small_model();
  EXPECT_FALSE(parse_model(written(model), "model.json").provenance.simulated);
  model.provenance.simulated = true;
  EXPECT_TRUE(parse_model(written(model), "model.json").provenance.simulated);
}

TEST(Model, CutShortAnywhereIsRefused) {
  const std::string text = written(small_model());
  for (std::size_t length = 0; length < text.size() - 2; length += 1 + text.size() / 97) {
    EXPECT_THROW((void)parse_model(text.substr(0, length), "model.json"), ModelError) << length;
  }
  EXPECT_THAT([&] { (void)parse_model(text.substr(0, text.size() / 2), "model.json"); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("model.json, line "), HasSubstr("cut short"))));
}

TEST(Model, NestsNoDeeperThanItsReaderCanFollow) {
  const std::string deep = "{\n\"format\": \"spoolflow model\", \"version\": " + std::string(80000, '[');
  EXPECT_THAT([&] { (void)parse_model(deep + std::string(80000, ']') + "}", "model.json"); },
              ThrowsMessage<ModelError>(HasSubstr("model.json, line 2: nests deeper than 64 levels")));
  EXPECT_THAT([&] { (void)parse_model(deep, "model.json"); }, ThrowsMessage<ModelError>(HasSubstr("nests deeper")));
  EXPECT_THAT([&] { (void)parse_model("[\"\\\"" + std::string(100, '[') + "\"]", "model.json"); },
              ThrowsMessage<ModelError>(HasSubstr("this is no spoolflow model")));  // in quotes nothing nests
}

TEST(Model, OfAnotherVersionIsRefusedWithBothVersions) {
  const std::string text = replaced(written(small_model()), "\"version\": 1", "\"version\": 7");
  EXPECT_THAT([&] { (void)parse_model(text, "model.json"); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("/version"), HasSubstr("version 7"), HasSubstr("version 1"))));
}

TEST(Model, WithNaNInATableIsRefused) {
  const std::string text = written(small_model());
  EXPECT_THAT([&] { (void)parse_model(replaced(text, "0.3333333333333333", "NaN"), "model.json"); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("line "), HasSubstr("NaN"))));
  EXPECT_THAT([&] { (void)parse_model(replaced(text, "0.3333333333333333", "null"), "model.json"); },
              ThrowsMessage<ModelError>(HasSubstr("/condensed/magnetic_force_N/values/0/0: null is no number")));
}

TEST(Model, WithAnAxisThatDoesNotRiseIsRefusedAtItsPlace) {
  const std::string text = written(small_model());
  EXPECT_THAT([&] { (void)parse_model(replaced(text, "0.1625,", "0.0625,"), "model.json"); },
              ThrowsMessage<ModelError>(
                  AllOf(HasSubstr("/condensed/magnetic_force_N/current_A/2"), HasSubstr("does not rise"))));
  EXPECT_THAT(
      [&] { (void)parse_model(replaced(text, "0.1625,", "0.1725,"), "model.json"); },
      ThrowsMessage<ModelError>(AllOf(HasSubstr("/condensed/magnetic_force_N/current_A"), HasSubstr("equal steps"))));
}

TEST(Model, NamesThePathOfWhatIsMissingOrOutOfRange) {
  const std::string text = written(small_model());
  EXPECT_THAT([&] { (void)parse_model(replaced(text, "\"spring_force_N\"", "\"sprung_force_N\""), "model.json"); },
              ThrowsMessage<ModelError>(HasSubstr("/condensed: \"spring_force_N\" is missing")));
  EXPECT_THAT([&] { (void)parse_model(replaced(text, "\"stroke_m\": 0.0024", "\"stroke_m\": 2.4"), "model.json"); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("/valve/stroke_m"), HasSubstr("2.4 is outside"))));
  EXPECT_THAT([&] { (void)parse_model("{\"format\": \"other\"}", "model.json"); },
              ThrowsMessage<ModelError>(HasSubstr("no spoolflow model")));
  EXPECT_THAT([&] { (void)parse_model("[1, 2]", "model.json"); },
              ThrowsMessage<ModelError>(HasSubstr("no spoolflow model")));
}

TEST(Model, ThatIsNotThereOrEmptyIsRefusedByName) {
  const recording::TemporaryFile beside("model.json");
  const std::filesystem::path& file = beside.path();
  std::ofstream(file).flush();
  EXPECT_THAT([&] { (void)read_model(file); }, ThrowsMessage<ModelError>(HasSubstr("is empty")));
  std::filesystem::remove(file);
  EXPECT_THAT([&] { (void)read_model(file); }, ThrowsMessage<ModelError>(HasSubstr("cannot be opened")));
  EXPECT_THAT([&] { (void)read_model(std::filesystem::temp_directory_path()); },
              ThrowsMessage<ModelError>(HasSubstr("folder")));
}

TEST(Provenance, ChecksumsAFileAsSha256DoesEverywhere) {
  EXPECT_EQ(sha256_of_file(recording::TemporaryFile("three_letters.txt", "abc").path()),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-2
}

}  // namespace
}  // namespace spoolflow::model
