/// How many single wrong numbers the exported self-test finds by its points alone, without the tables' CRC-32: each
/// number of the tables in turn is changed, in single precision, and the self-test's criteria are asked.
///
///     self_test_reach MODEL.json
///
/// Numbers that no step reads (the records' padding) are left out.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <exception>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/export/cpp/cell_sums.hpp"
#include "spoolflow/export/golden_points.hpp"
#include "spoolflow/export/number_groups.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace {

using namespace spoolflow;
using exports::DirectionPoint;

struct SelfTest {
  std::vector<DirectionPoint> points;
  double rated_m3_per_s;
  std::vector<float> condensed_cells, observer_cells;

  [[nodiscard]] bool near(float one, double other, double share) const {
    const double apart = static_cast<double>(one) - other;
    return apart >= -share * rated_m3_per_s && apart <= share * rated_m3_per_s;
  }
  [[nodiscard]] bool strokes_agree(const sensor::CondensedTables<float>& tables) const {
    sensor::CondensedState<float> state{};
    for (const DirectionPoint& point : points)
      if (!near(step(tables, state, point.sample).flow_m3_per_s, point.condensed_m3_per_s, 1e-3)) return false;
    return true;
  }
  [[nodiscard]] bool strokes_agree(const sensor::ObserverParameters<float>& valve) const {
    sensor::ObserverState<float> state{};
    std::size_t apart = 0;
    for (const DirectionPoint& point : points) {
      const auto& answer = step(valve, state, point.sample);
      if (!near(answer.flow_m3_per_s, point.best_m3_per_s, 1e-3)) return false;
      const bool same = near(answer.flow_lower_m3_per_s, point.best_lower_m3_per_s, 5e-3) &&
                        near(answer.flow_upper_m3_per_s, point.best_upper_m3_per_s, 5e-3) &&
                        answer.status == point.best_status;
      apart += same ? 0U : 1U;
    }
    return 50U * apart <= points.size();
  }
  [[nodiscard]] bool cells_agree(const sensor::CondensedTables<float>& tables) const {
    return exports::cells_agree(tables, condensed_cells);
  }
  [[nodiscard]] bool cells_agree(const sensor::ObserverParameters<float>& valve) const {
    return exports::cells_agree(valve, observer_cells);
  }
};

/// Whether a step of the condensed sensor reads this number of its tables; all of the observer's are read.
bool is_read(const sensor::CondensedTables<float>& /*tables*/, std::size_t number) {
  using Layout = sensor::CondensedLayout;
  constexpr std::size_t head = offsetof(sensor::CondensedTables<float>, records) / sizeof(float);
  if (number < head) return true;
  const auto in_record = static_cast<int>((number - head) % Layout::record);
  return in_record < Layout::flow + Layout::flow_cell * Layout::root_cells &&
         !(in_record >= Layout::spare && in_record < Layout::magnetic_force);
}
bool is_read(const sensor::ObserverParameters<float>& /*valve*/, std::size_t /*number*/) {
  return true;
}

float changed(float number, int how) {
  if (how == 0) return std::bit_cast<float>(std::bit_cast<std::uint32_t>(number) ^ 0x80000000U);
  return how == 1 ? 2 * number : 1.1F * number;
}

template <class Tables>
void count(const char* name, const Tables& sound, const SelfTest& test) {
  constexpr std::size_t numbers = sizeof(Tables) / sizeof(float);
  for (const int how : {0, 1, 2}) {
    std::size_t all = 0, by_strokes = 0, by_either = 0;
    const auto tables = std::make_unique<Tables>(sound);
    for (std::size_t k = 0; k < numbers; ++k) {
      char* const at = reinterpret_cast<char*>(tables.get()) + k * sizeof(float);
      float number = 0;
      std::memcpy(&number, at, sizeof number);
      if (!is_read(sound, k) || number == 0) continue;
      const float wrong = changed(number, how);
      std::memcpy(at, &wrong, sizeof wrong);
      ++all;
      const bool strokes = !test.strokes_agree(*tables);
      by_strokes += strokes ? 1U : 0U;
      by_either += strokes || !test.cells_agree(*tables) ? 1U : 0U;
      std::memcpy(at, &number, sizeof number);
    }
    constexpr std::array<const char*, 3> words{"other sign", "doubled", "10 % more"};
    const auto percent = [all](std::size_t found) {
      return 100.0 * static_cast<double>(found) / static_cast<double>(all);
    };
    fmt::print("{:<12}{:<14}{:>10}{:>16.1f}{:>24.1f}\n", name, words[static_cast<std::size_t>(how)], all,
               percent(by_strokes), percent(by_either));
  }
}

template <class Tables>
std::vector<float> cells_of(const Tables& tables) {
  std::vector<float> out;
  sensor::CondensedState<double> state{};
  exports::sum_cells(tables, state,
                     [&](const exports::CellSum<double>& row) { out.push_back(static_cast<float>(row.sum)); });
  return out;
}

template <class Tables>
float largest_rounding(const Tables& tables, const std::vector<float>& cells) {
  float largest = 0;
  std::size_t next = 0;
  sensor::CondensedState<float> state{};
  exports::sum_cells(tables, state, [&](const exports::CellSum<float>& row) {
    const float apart = sensor::magnitude(row.sum - cells[next++]);
    if (row.size > 0) largest = std::max(largest, apart / row.size);
  });
  return largest;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: self_test_reach MODEL.json\n");
    return 2;
  }
  try {
    const model::Model model = model::read_model(argv[1]);
    const auto tables = std::make_unique<sensor::CondensedTables<double>>();
    sensor::lay_out(model.condensed.parameters, *tables);
    const auto& observer = model.observer.value().parameters;
    const SelfTest test{exports::golden_points(model), model.valve.rated_flow_m3_per_s, cells_of(*tables),
                        cells_of(observer)};
    fmt::print("{:<12}{:<14}{:>10}{:>16}{:>24}\n", "", "each number", "numbers", "strokes find %",
               "strokes or cells find %");
    fmt::print("rounding moves a sum by {:.1e} and {:.1e} of its terms at most, {:.0e} are allowed\n",
               largest_rounding(exports::single_precision(*tables), test.condensed_cells),
               largest_rounding(exports::single_precision(observer), test.observer_cells), exports::cell_sum_tolerance);
    count("condensed", exports::single_precision(*tables), test);
    count("observer", exports::single_precision(observer), test);
  } catch (const std::exception& error) {
    fmt::print(stderr, "self_test_reach: {}\n", error.what());
    return 1;
  }
  return 0;
}
