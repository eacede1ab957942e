#pragma once
/// The commands as functions of what was asked of them, so that `demo` does exactly what the commands do.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace spoolflow::apps {

struct SimulateArguments {
  std::string scenario;
  std::string recording;  ///< to write
  std::string truth;      ///< to write; empty: none
  bool quiet = false;
};
void simulate(const SimulateArguments& arguments);

struct CampaignArguments {
  std::string valve;       ///< valve file or preset
  std::string folder;      ///< to write
  std::string bench = {};  ///< "force" or "flow"; empty: as the valve file says, else force
  bool calibration_only = false;
  bool with_truth = false;
  bool quiet = false;
};
void campaign(const CampaignArguments& arguments);

struct CalibrateArguments {
  std::vector<std::string> campaigns;   ///< of one the model is a file, of several a folder
  std::string model;                    ///< to write
  std::string report;                   ///< to write, likewise; empty: none
  std::vector<std::string> units = {};  ///< of the report
  bool allow_outside = false;           ///< recordings outside the campaign's folder
  bool despite_doubts = false;          ///< recordings that contradict each other or physics
  std::string fleet = {};               ///< whose workers do the work; empty: this machine
  bool quiet = false;
  bool as_type = false;   ///< the model is to serve every unit of the valve's type
  std::string type = {};  ///< model of the type of which the campaigns are units; empty: each is a valve of its own
  std::string updated_type = {};  ///< the type as these units are, to write; empty: none
};
void calibrate(const CalibrateArguments& arguments);

struct EstimateArguments {
  std::string model;
  std::vector<std::string> recordings;  ///< of one the estimate is a file, of several a folder
  std::string output;
  std::string estimator;   ///< "condensed" or "observer"; empty: the observer where the model has one
  std::string channels;    ///< channel map; empty: none
  std::string json = {};   ///< summary to write; empty: none
  bool strict = false;     ///< faults and doubts fail
  std::string fleet = {};  ///< whose workers do the work; empty: this machine
  bool quiet = false;
  std::string format = {};       ///< of the estimates, "parquet"; empty: by the output's suffix, of several CSV
  std::string environment = {};  ///< "bench", "machine" or a file; empty: the model's
};
void estimate(const EstimateArguments& arguments);

struct ValidateArguments {
  std::string model;
  std::vector<std::string> recordings;
  std::string report;                     ///< to write; empty: none
  std::string json;                       ///< to write; empty: none
  std::string channels;                   ///< channel map; empty: none
  std::string requirements = {};          ///< requirements file; empty: none
  std::vector<std::string> compare = {};  ///< figures of other validations
  std::string estimator = "both";
  std::vector<std::string> units = {};  ///< of the report
  std::optional<double> reference_lag_ms = {};
  bool apply_reference_lag = true;
  bool fail_unmet = false;  ///< a requirement that is not met fails
  bool quiet = false;
  std::string environment = {};  ///< "bench", "machine" or a file; empty: the model's
};
void validate(const ValidateArguments& arguments);

struct MonitorArguments {
  std::string model;
  std::vector<std::string> recordings;  ///< oldest first
  std::string baseline;                 ///< empty: the model is the reference
  std::string report;                   ///< to write; empty: none
  std::string json;                     ///< to write; empty: none
  std::string adapt = {};               ///< corrected model to write; empty: none
  std::string channels;                 ///< channel map; empty: none
  std::vector<std::string> units = {};  ///< of the report
  double false_alarms_per_year = 1;     ///< wanted, over all indicators
  std::string fleet = {};               ///< whose workers do the work; empty: this machine
  bool quiet = false;
};
void monitor_recordings(const MonitorArguments& arguments);

struct RecalibrateArguments {
  std::string model;
  std::vector<std::string> recordings;   ///< oldest first
  std::string references;                ///< file of [[reference]]; empty: goes back
  std::string output;                    ///< model to write
  std::string channels = {};             ///< channel map; empty: none
  std::optional<std::size_t> back_to{};  ///< state to go back to
  bool quiet = false;
};
void recalibrate_model(const RecalibrateArguments& arguments);

}  // namespace spoolflow::apps
