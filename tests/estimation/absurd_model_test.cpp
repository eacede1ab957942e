/// A calibrated model of which one number, or one whole table, is absurd: it is refused at load by its JSON path, or
/// the sensors made from it answer with finite numbers inside their bands, in double and in single precision.
#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "spoolflow/model/limit_check.hpp"
#include "spoolflow/model/model.hpp"
#include "tests/estimation/random_valve.hpp"
#include "tests/estimation/sound_answer.hpp"

namespace spoolflow::estimation {
namespace {

using AbsurdJson = nlohmann::ordered_json;
using AbsurdPlace = AbsurdJson::json_pointer;

struct AbsurdPlaces {
  std::vector<AbsurdPlace> numbers;  ///< all of them
  std::vector<AbsurdPlace> tables;   ///< lists and tables as a whole
};

void list_places(const AbsurdJson& value, const AbsurdPlace& at, bool in_table, AbsurdPlaces& out) {
  if (value.is_number()) out.numbers.push_back(at);
  if (value.is_array() && !in_table) out.tables.push_back(at);
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) list_places(member, at / key, in_table, out);
  } else if (value.is_array()) {
    for (std::size_t k = 0; k < value.size(); ++k) list_places(value[k], at / k, true, out);
  }
}

/// Every number of a table through `change`.
template <class Change>
void change_numbers(AbsurdJson& value, const Change& change) {
  if (value.is_number()) {
    value = change(value.get<double>());
  } else if (value.is_structured()) {
    for (auto& member : value) change_numbers(member, change);
  }
}

struct AbsurdModel : ::testing::Test {
  AbsurdModel() {
    std::ifstream in(SPOOLFLOW_SMALL_MODEL);
    file = AbsurdJson::parse(in);
    list_places(file, AbsurdPlace(), false, places);
  }

  /// The model as `file` says, which names `what` in a message.
  void look(const std::string& what) {
    try {
      const model::Model model = model::parse_model(file.dump(), "model.json");
      ++taken;
      const auto& valve = model.condensed.parameters;
      Dice dice(2);
      const RandomSamples samples(dice, largest_current_A(valve), largest_position_m(valve));
      EXPECT_EQ(flaw_in_double(&valve, samples, 100), "") << what;
      const auto tables_of_valve = std::make_unique<sensor::CondensedTables<double>>();
      sensor::lay_out(valve, *tables_of_valve);
      EXPECT_EQ(flaw_in_single(*in_single_precision(*tables_of_valve), sensor::CondensedState<float>{}, samples, 100),
                "")
          << what;
      const auto& observer = model.observer.value().parameters;
      EXPECT_EQ(flaw_in_double(&observer, samples, 100), "") << what;
      const auto single = in_single_precision(observer);
      const auto described = [](auto& parameters, auto& visitor) { describe(parameters, visitor); };
      if (model::violation(*single, described)) return;  // the C++ export refuses it
      EXPECT_EQ(flaw_in_single(*single, sensor::ObserverState<float>{}, samples, 100), "") << what;
    } catch (const model::ModelError& error) {
      ++refused;
      EXPECT_THAT(error.what(), ::testing::HasSubstr("model.json: /")) << what;
    }
  }
  /// `change` done to what stands at `place`, for one look.
  template <class Change>
  void try_change(const AbsurdPlace& place, const char* name, const Change& change) {
    const AbsurdJson kept = file.at(place);
    change_numbers(file.at(place), change);
    if (file.at(place) != kept) look(place.to_string() + " " + name);
    file.at(place) = kept;
  }
  void try_changes(const AbsurdPlace& place) {
    try_change(place, "huge", [](double value) { return value * 1e300; });
    try_change(place, "tiny", [](double value) { return value * 1e-300; });
    try_change(place, "negated", [](double value) { return -value; });
  }
  void try_swap(std::size_t one, std::size_t other) {
    std::swap(file.at(places.numbers[one]), file.at(places.numbers[other]));
    look(places.numbers[one].to_string() + " and " + places.numbers[other].to_string());
    std::swap(file.at(places.numbers[one]), file.at(places.numbers[other]));
  }

  AbsurdJson file;
  AbsurdPlaces places;
  int taken = 0, refused = 0;
};

TEST_F(AbsurdModel, OfOneNumberIsRefusedOrAnswersWithABand) {
  constexpr std::size_t stride = 97;  // prime: every table is met, at ever other places of its rows
  for (std::size_t k = 0; k < places.numbers.size(); k += stride) {
    try_changes(places.numbers[k]);
    if (k > 0) try_swap(k, k - 1);
  }
  EXPECT_GT(refused, 20);
  EXPECT_GT(taken, 20);
}

TEST_F(AbsurdModel, OfOneTableIsRefusedOrAnswersWithABand) {
  for (const AbsurdPlace& table : places.tables) try_changes(table);
  EXPECT_GT(refused, 20);
  EXPECT_GT(taken, 20);
}

}  // namespace
}  // namespace spoolflow::estimation
