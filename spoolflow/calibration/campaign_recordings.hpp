#pragma once
/// A campaign's recordings in memory, by direction of flow and by what was measured.
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "spoolflow/calibration/edges/path_of_edges.hpp"
#include "spoolflow/calibration/flow_bench/equivalent_benches.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/read_options.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

using Recordings = std::vector<const recording::Recording*>;

/// The recordings of one direction of flow; what no force bench recorded is inferred from the flow bench.
struct CampaignRecordings {
  const recording::Recording& spring;
  const recording::Recording& solenoid_force_map;
  Recordings solenoid_dynamic;  ///< none or one
  AxialForceMaps axial_force_maps;
  Recordings operation{};                         ///< may be none
  const EquivalentBenches* flow_bench = nullptr;  ///< where strokes at held pressure differences are among them
  model::Fluid fluid{};
  bool strokes_as_operation = false;  ///< there was no run: it is the flow bench's strokes
  [[nodiscard]] bool actuator_is_inferred() const {
    return flow_bench != nullptr && !flow_bench->actuator_was_measured;
  }
};

/// The data sheet's values of the oil.
[[nodiscard]] model::Fluid fluid_of(const recording::Campaign& campaign);

/// A campaign's recordings, read; addresses stay valid while more are read.
class ReadCampaign {
 public:
  /// Keeps a reference to the campaign. Throws CalibrationError where it is not complete (completeness.hpp).
  explicit ReadCampaign(const recording::Campaign& campaign);

  /// Reads the next of the campaign's recordings. Throws RecordingError, or CalibrationError where a run of the whole
  /// valve comes without bench recordings of both directions.
  const recording::Recording& read_next();

  /// What was recorded of the direction by the valve's own solenoid.
  [[nodiscard]] FlowBenchRecordings on_flow_bench(const std::string& direction) const;

  /// What force benches did not record of the direction, from its flow bench; nothing where it was on none. Before
  /// of(), after all are read. Throws CalibrationError.
  void infer_benches(const std::string& direction);

  /// The directions of which there are bench recordings: "b", "a" or both.
  [[nodiscard]] const std::vector<std::string>& directions() const { return directions_; }
  /// One of directions().
  [[nodiscard]] CampaignRecordings of(const std::string& direction) const;
  /// `solenoid_dynamic` without the force map that it belongs to: of it the coil's largest voltage alone is taken.
  [[nodiscard]] Recordings unused(const std::string& direction) const;
  /// Operating runs of the whole valve, with the currents of both coils.
  [[nodiscard]] Recordings through_centre() const;
  [[nodiscard]] Recordings all() const;

 private:
  struct Loaded {
    const recording::CampaignRecording& entry;
    recording::Recording recording;
    bool through_centre;
  };
  [[nodiscard]] Recordings of(recording::Protocol protocol, const std::string& direction) const;
  [[nodiscard]] const EquivalentBenches* flow_bench(const std::string& direction) const;
  [[nodiscard]] AxialForceMaps axial_force_maps(const std::string& direction) const;
  /// The armature's friction is then in that of all forces, and what force rigs measured stands among the equivalents.
  [[nodiscard]] bool has_inferred_actuator(const std::string& direction) const;

  const recording::Campaign& campaign_;
  std::vector<recording::ReadOptions> options_;
  std::vector<std::string> directions_;
  std::deque<Loaded> loaded_;
  std::map<std::string, EquivalentBenches> flow_benches_;  ///< by direction
};

}  // namespace spoolflow::calibration
