#include "spoolflow/rig/bench/settings_file.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Inner {
  double mass_kg = 1.0;
  std::vector<double> levels_bar{1, 2};
  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"mass_kg", "kg", 0.5, 2, "a test"}, self.mass_kg);
    visit(Parameter{"levels_bar", "bar", 0, 100, "a test"}, self.levels_bar);
  }
};

struct SettingsFile : ::testing::Test {
  Inner inner;
  std::string text = "before";
  bool flag = false;
  std::uint64_t seed = 0;
  std::size_t chosen = 99;
  Settings settings;
  SettingsFile() {
    settings.add("spool", inner).add_value("name", text).add_value("ideal", flag).add_value("seed", seed);
    settings.add_choice("kind", {"one", "two"}, [this](std::size_t index) { chosen = index; });
  }
  std::string message(const std::string& toml) const {
    try {
      apply({.text = toml, .name = "worn.toml"}, settings);
    } catch (const SettingsError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(SettingsFile, SetsWhatItNamesAndLeavesTheRest) {
  apply(
      {.text = "name = \"x\"\nideal = true\nseed = 12\nkind = \"two\"\n[spool]\nlevels_bar = [3, 4.5]\n", .name = "a"},
      settings);
  EXPECT_EQ(text, "x");
  EXPECT_TRUE(flag);
  EXPECT_EQ(seed, 12U);
  EXPECT_EQ(chosen, 1U);
  EXPECT_THAT(inner.levels_bar, ElementsAre(3.0, 4.5));
  EXPECT_EQ(inner.mass_kg, 1.0);
}

TEST_F(SettingsFile, NamesFileLineValueAndRangeOfANumberOutside) {
  EXPECT_THAT(message("[spool]\nmass_kg = 3\n"), AllOf(HasSubstr("worn.toml, line 2"), HasSubstr("spool.mass_kg = 3"),
                                                       HasSubstr("0.5 to 2"), HasSubstr("kg")));
  EXPECT_THAT(message("[spool]\nlevels_bar = [3, 101]\n"), AllOf(HasSubstr("101"), HasSubstr("0 to 100")));
}

TEST_F(SettingsFile, RefusesNumbersThatAreNone) {
  EXPECT_THAT(message("[spool]\nmass_kg = nan\n"), HasSubstr("0.5 to 2"));
  EXPECT_THAT(message("[spool]\nmass_kg = \"heavy\"\n"), AllOf(HasSubstr("line 2"), HasSubstr("number")));
  EXPECT_THAT(message("[spool]\nmass_kg = true\n"), HasSubstr("number"));
  EXPECT_THAT(message("[spool]\nlevels_bar = []\n"), HasSubstr("at least one"));
  EXPECT_THAT(message("[spool]\nlevels_bar = 3\n"), HasSubstr("list"));
}

TEST_F(SettingsFile, NamesTheNearestKeyForAnUnknownOne) {
  EXPECT_THAT(message("[spool]\nmas_kg = 1\n"), AllOf(HasSubstr("spool.mas_kg"), HasSubstr("spool.mass_kg")));
  EXPECT_THAT(message("[spol]\nmass_kg = 1\n"),
              AllOf(HasSubstr("line 1"), HasSubstr("spol"), HasSubstr("did you mean")));
}

TEST_F(SettingsFile, RefusesTomlThatIsNone) {
  EXPECT_THAT(message("name = \"x\"\nname = \"y\"\n"), AllOf(HasSubstr("worn.toml, line 2"), HasSubstr("TOML")));
  EXPECT_THAT(message("name = [\n"), HasSubstr("worn.toml"));
}

TEST_F(SettingsFile, ListsTheChoices) {
  EXPECT_THAT(message("kind = \"three\"\n"), AllOf(HasSubstr("three"), HasSubstr("one, two")));
}

TEST_F(SettingsFile, WantsWholeSeedsAndPlainFlags) {
  EXPECT_THAT(message("seed = -1\n"), HasSubstr("whole number"));
  EXPECT_THAT(message("seed = 1.5\n"), HasSubstr("whole number"));
  EXPECT_THAT(message("ideal = 1\n"), HasSubstr("true or false"));
  EXPECT_THAT(message("name = 3\n"), HasSubstr("text in quotes"));
}

TEST_F(SettingsFile, SaysThatAFileCannotBeRead) {
  EXPECT_THROW((void)read_settings_source("/nowhere/valve.toml"), SettingsError);
  EXPECT_THROW((void)read_settings_source("/"), SettingsError);
}

}  // namespace
}  // namespace spoolflow::rig
