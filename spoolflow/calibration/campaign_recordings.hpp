#pragma once
/// A campaign's recordings in memory, by direction of flow and by what was measured.
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "spoolflow/calibration/edges/path_of_edges.hpp"
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/read_options.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

using Recordings = std::vector<const recording::Recording*>;

/// The recordings of one direction of flow.
struct CampaignRecordings {
  const recording::Recording& spring;
  const recording::Recording& solenoid_force_map;
  Recordings solenoid_dynamic;  ///< none or one
  AxialForceMaps axial_force_maps;
  Recordings operation;  ///< may be none
};

/// A campaign's recordings, read; addresses stay valid while more are read.
class ReadCampaign {
 public:
  /// Keeps a reference to the campaign. Throws CalibrationError where it is not complete (completeness.hpp).
  explicit ReadCampaign(const recording::Campaign& campaign);

  /// Reads the next of the campaign's recordings. Throws RecordingError, or CalibrationError where a run of the whole
  /// valve comes without bench recordings of both directions.
  const recording::Recording& read_next();

  /// The directions of which there are bench recordings: "b", "a" or both.
  [[nodiscard]] const std::vector<std::string>& directions() const { return directions_; }
  /// One of directions().
  [[nodiscard]] CampaignRecordings of(const std::string& direction) const;
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
  [[nodiscard]] AxialForceMaps axial_force_maps(const std::string& direction) const;

  const recording::Campaign& campaign_;
  std::vector<recording::ReadOptions> options_;
  std::vector<std::string> directions_;
  std::deque<Loaded> loaded_;
};

}  // namespace spoolflow::calibration
