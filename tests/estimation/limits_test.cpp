/// "Never NaN": whatever valve passes its limits, and whatever samples come, the answers are numbers and the flow lies
/// in its band; in double and in single precision.
#include <bit>
#include <cmath>
#include <memory>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "spoolflow/model/limit_check.hpp"
#include "spoolflow/model/model.hpp"
#include "tests/estimation/random_valve.hpp"
#include "tests/estimation/sound_answer.hpp"

namespace spoolflow::estimation {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr auto described = [](auto& valve, auto& visitor) { describe(valve, visitor); };

TEST(Limits, CondensedSensorsWithinThemAnswerWithNumbersWhateverComes) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Dice dice(seed);
    auto valve = std::make_unique<sensor::CondensedParameters<double>>();
    fill(*valve, dice);
    const RandomSamples samples(dice, largest_current_A(*valve), largest_position_m(*valve));
    EXPECT_EQ(flaw_in_double(valve.get(), samples, 1000), "") << seed;
    const auto tables = std::make_unique<sensor::CondensedTables<double>>();
    sensor::lay_out(*valve, *tables);
    EXPECT_EQ(flaw_in_single(*in_single_precision(*tables), sensor::CondensedState<float>{}, samples, 1000), "")
        << seed;
  }
}

TEST(Limits, ObserversWithinThemAnswerWithNumbersWhateverComes) {
  int single = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Dice dice(seed);
    auto valve = std::make_unique<sensor::ObserverParameters<double>>();
    fill(*valve, dice);
    const RandomSamples samples(dice, largest_current_A(*valve), largest_position_m(*valve));
    EXPECT_EQ(flaw_in_double(valve.get(), samples, 1000), "") << seed;
    const auto rounded = in_single_precision(*valve);
    if (model::violation(*rounded, described)) continue;  // as the C++ export does
    ++single;
    EXPECT_EQ(flaw_in_single(*rounded, sensor::ObserverState<float>{}, samples, 1000), "") << seed;
  }
  EXPECT_GT(single, 150);
}

TEST(Limits, RandomValvesAreWithinThem) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const model::Model model = random_model(seed);
    const auto condensed = model::violation(model.condensed.parameters, described);
    const auto observer = model::violation(model.observer->parameters, described);
    EXPECT_FALSE(condensed) << condensed->path << ": " << condensed->problem;
    EXPECT_FALSE(observer) << observer->path << ": " << observer->problem;
  }
}

/// Every way in which one place of a model file may be damaged, tried one after the other.
class Damage {
 public:
  explicit Damage(const model::Model& model) : dice_(1) {
    std::ostringstream out;
    write_model(out, model);
    file_ = Json::parse(out.str());
  }
  void all() {
    for (const char* part : {"valve", "condensed", "observer"}) each_in(file_[part], std::string("/") + part);
  }
  [[nodiscard]] int refused() const { return refused_; }
  [[nodiscard]] int lived_with() const { return lived_with_; }

 private:
  using Json = nlohmann::ordered_json;

  void each_in(Json& node, const std::string& path) {
    if (node.is_object()) {
      std::vector<std::string> keys;
      for (const auto& [key, value] : node.items()) keys.push_back(key);
      for (const std::string& key : keys) {
        const Json kept = node;
        node.erase(key);
        look(path + " without " + key);
        node = kept;
        each_in(node[key], path + "/" + key);
      }
    } else if (node.is_array() && !node.empty() && (node[0].is_number() || node[0].is_array())) {
      in_array(node, path);
    } else if (node.is_number()) {
      const Json kept = node;
      const double value = node.get<double>();
      for (const Json& other : {Json(), Json(0), Json(-value), Json(1e300)}) {
        node = other;
        look(path + " = " + other.dump());
      }
      node = kept;
    }
  }
  /// Its first and last entry and one between.
  void in_array(Json& node, const std::string& path) {
    const Json kept = node;
    node.erase(node.size() - 1);
    look(path + " shortened");
    node = kept;
    node.push_back(node[0]);
    look(path + " lengthened");
    node = kept;
    const std::size_t between = 1 + dice_.bits() % (node.size() - 1);
    std::swap(node[between - 1], node[between]);
    look(path + " swapped at " + std::to_string(between));
    node = kept;
    if (kept[0].is_number()) each_in(node[0], path + "/0");
    each_in(node[between], path + "/" + std::to_string(between));
    if (kept[0].is_number()) each_in(node[node.size() - 1], path + "/" + std::to_string(node.size() - 1));
  }
  void look(const std::string& what) {
    try {
      const model::Model model = model::parse_model(file_.dump(), "model.json");
      ++lived_with_;
      const auto& valve = model.condensed.parameters;
      Dice dice(2);
      const RandomSamples samples(dice, largest_current_A(valve), largest_position_m(valve));
      EXPECT_EQ(flaw_in_double(&valve, samples, 200), "") << what;
      if (model.observer) {
        EXPECT_EQ(flaw_in_double(&model.observer->parameters, samples, 200), "") << what;
      }
    } catch (const model::ModelError& error) {
      ++refused_;
      EXPECT_THAT(error.what(), HasSubstr("model.json: /")) << what;
    }
  }

  Dice dice_;
  Json file_;
  int refused_ = 0, lived_with_ = 0;
};

TEST(Limits, ADamagedModelFileIsRefusedWithItsPathOrAnswersWithNumbers) {
  Damage damage(random_model(5));
  damage.all();
  EXPECT_GT(damage.refused(), 300);
  EXPECT_GT(damage.lived_with(), 50);
}

struct Broken {
  const char* path;  ///< JSON pointer
  double value;
  const char* message;
};

TEST(Limits, RefuseByPathWhatTheEquationsCannotLiveWith) {
  std::ostringstream text;
  write_model(text, random_model(5));
  const auto good = nlohmann::ordered_json::parse(text.str());
  using Pointer = nlohmann::ordered_json::json_pointer;
  const double second_threshold = good.at(Pointer("/observer/hysteresis_threshold_Wb/1"));
  const double first_flux = good.at(Pointer("/observer/flux_linkage_Wb/values/0/3"));
  for (const Broken& broken :
       {Broken{"/observer/hysteresis_threshold_Wb/2", second_threshold, "does not rise"},
        Broken{"/observer/flux_linkage_Wb/values/1/3", first_flux, "does not rise"},
        Broken{"/observer/moving_mass_kg", 0, "0 is outside 0.001 to 100 kg"},
        Broken{"/observer/friction_ageing_s", 0, "is outside"},
        Broken{"/observer/spool_friction_N/1/2/3", -1, "is outside"},
        Broken{"/observer/band_force_residual_N", 0, "is outside"},
        Broken{"/observer/least_process_noise", 1, "first_process_noise"},
        Broken{"/observer/hysteresis_stiffness_increase_A_per_Wb/0", -1e6, "hysteresis_stiffness_A_per_Wb"},
        Broken{"/condensed/largest_flow_force_N/values/7", 0, "is outside"},
        Broken{"/fluid/density_15C_kg_per_m3", 1e16, "larger than any quantity"},
        Broken{"/condensed/current_range_A/1", 1e300, "larger than any quantity"},
        Broken{"/condensed/flow_m3_per_s/values/4/16", -0.1, "falls below"}}) {
    auto damaged = good;
    damaged[Pointer("/observer/first_process_noise")] = 0.5;
    damaged[Pointer("/observer/least_process_noise")] = 0.5;
    damaged[Pointer(broken.path)] = broken.value;
    try {
      (void)model::parse_model(damaged.dump(), "model.json");
      ADD_FAILURE() << broken.path;
    } catch (const model::ModelError& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string("model.json: ") + broken.path + ":"));
      EXPECT_THAT(error.what(), HasSubstr(broken.message));
    }
  }
}

TEST(Limits, AModelOfFormerKeysIsReadAndWrittenWithThoseOfNow) {
  const model::Model now = random_model(3);
  std::ostringstream out;
  write_model(out, now);
  auto former = nlohmann::ordered_json::parse(out.str());
  auto& observer = former["observer"];
  observer.erase("least_process_noise");
  observer.erase("first_process_noise");
  observer["least_liveliness"] = 0.02;  // the root of what it is now
  observer["first_liveliness"] = 0.07;
  observer.erase("constrained_correction_s");
  observer.erase("band_unobserved_factor");
  observer["yielding_s"] = 0.04;
  observer["band_unseen_factor"] = 2.5;
  const model::Model read = model::parse_model(former.dump(), "model.json");
  EXPECT_DOUBLE_EQ(read.observer->parameters.pressure.least_process_noise, 0.0004);
  EXPECT_DOUBLE_EQ(read.observer->parameters.pressure.first_process_noise, 0.07);
  EXPECT_DOUBLE_EQ(read.observer->parameters.pressure.constrained_correction_s, 0.04);
  EXPECT_DOUBLE_EQ(read.observer->parameters.band.unobserved_factor, 2.5);
  std::ostringstream again;
  write_model(again, read);
  for (const char* key : {"liveliness", "yielding_s", "band_unseen_factor"})
    EXPECT_THAT(again.str(), Not(HasSubstr(key)));
}

}  // namespace
}  // namespace spoolflow::estimation
