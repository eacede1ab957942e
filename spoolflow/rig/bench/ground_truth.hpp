#pragma once
/// What really happened during a run, sample by sample beside the recording: what no instrument shows.
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "spoolflow/rig/plant/valve_plant.hpp"

namespace spoolflow::rig {

/// One column of the truth file: its header and how it follows from the plant, in the header's unit.
struct TruthQuantity {
  std::string_view header;  ///< such as "flow_force_N"
  int decimals;
  double (*of)(const PlantOutput&);
};

inline constexpr std::size_t truth_quantity_count = 22;
/// In the order of the file's columns; time first. Signs as in valve_plant.hpp.
[[nodiscard]] const std::array<TruthQuantity, truth_quantity_count>& truth_quantities();

/// One row a sample of the recording, at the same time stamps; instantaneous, never averaged.
struct GroundTruth {
  std::array<std::vector<double>, truth_quantity_count> columns;

  void add(const PlantOutput& plant) {
    for (std::size_t k = 0; k < truth_quantity_count; ++k) {
      columns[k].push_back(truth_quantities()[k].of(plant));
    }
  }
  [[nodiscard]] std::size_t size() const { return columns.front().size(); }
  /// The column of that header. Throws std::out_of_range for an unknown one.
  [[nodiscard]] const std::vector<double>& operator[](std::string_view header) const;
};

}  // namespace spoolflow::rig
