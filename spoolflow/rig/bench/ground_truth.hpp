#pragma once
/// What really happened during a run, sample by sample beside the recording: what no instrument shows.
#include <cstddef>
#include <span>
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

/// In the order of the file's columns; time first. Signs as in valve_plant.hpp. Of a whole valve's operation: the flow
/// is signed, > 0 for P to B, the pressure difference is that of the open path, and each edge, port and solenoid has
/// its own columns.
[[nodiscard]] std::span<const TruthQuantity> truth_quantities(bool whole_valve = false);

/// One row a sample of the recording, at the same time stamps; instantaneous, never averaged.
struct GroundTruth {
  explicit GroundTruth(bool whole_valve = false)
      : quantities(truth_quantities(whole_valve)), columns(quantities.size()) {}

  std::span<const TruthQuantity> quantities;
  std::vector<std::vector<double>> columns;

  void add(const PlantOutput& plant) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      columns[k].push_back(quantities[k].of(plant));
    }
  }
  [[nodiscard]] std::size_t size() const { return columns.front().size(); }
  /// The column of that header. Throws std::out_of_range for an unknown one.
  [[nodiscard]] const std::vector<double>& operator[](std::string_view header) const;
};

}  // namespace spoolflow::rig
