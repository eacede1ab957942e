#pragma once
/// What a campaign measures, and the list of its recordings.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "spoolflow/rig/bench/protocol.hpp"

namespace spoolflow::rig {

/// On what a campaign measures for calibration.
enum class CampaignBench {
  force,  ///< solenoid and axial-force rigs
  flow    ///< a flow bench alone
};

/// What the campaign measures; the table [campaign] of a valve file.
struct CampaignSettings {
  std::vector<double> oil_temperatures_C{30, 50, 70};
  std::vector<double> pressure_differences_bar{5, 10, 20, 30, 40, 50, 60, 70};
  double ramp_pressure_bar = 60.0;
  double ramp_rate_percent_per_s = 5.0;
  std::vector<double> ramps_pressures_bar{30, 40, 50, 60, 70};
  double ramps_position_faults_per_s = 0.1;
  double sweep_pressure_bar = 50.0;
  double sweep_frequency_Hz = 8.0;
  double duty_cycle_s = 180.0;
  double dither_amplitude_A = 0.2;
  double dither_frequency_Hz = 160.0;
  double dithered_duty_s = 40.0;
  double overrunning_pressure_bar = 50.0;
  CampaignBench bench = CampaignBench::force;  ///< key `bench`: "force" or "flow"
  bool one_edge_at_a_time = false;  ///< key `edges`, of a whole valve: "joined" (A and B), or "one_at_a_time"

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"oil_temperatures_C", "degC", -20, 100, "one axial-force map, or metering recording, each"},
          self.oil_temperatures_C);
    visit(Parameter{"pressure_differences_bar", "bar", 0.5, 350, "levels of each"}, self.pressure_differences_bar);
    visit(Parameter{"ramp_pressure_bar", "bar", 0.5, 350, "of the run that goes into campaign.toml"},
          self.ramp_pressure_bar);
    visit(Parameter{"ramp_rate_percent_per_s", "%/s", 0.1, 1000, "of that run's set position; 5 %/s in the paper"},
          self.ramp_rate_percent_per_s);
    visit(Parameter{"ramps_pressures_bar", "bar", 0.5, 350, "one triangle each"}, self.ramps_pressures_bar);
    visit(Parameter{"ramps_position_faults_per_s", "1/s", 0, 10, "acquisition faults in that run (paper, Fig 10)"},
          self.ramps_position_faults_per_s);
    visit(Parameter{"sweep_pressure_bar", "bar", 0.5, 350, "of the temperature sweep and the sine sweep"},
          self.sweep_pressure_bar);
    visit(Parameter{"sweep_frequency_Hz", "Hz", 0.2, 100, "reached by the sine sweep from 0.1 Hz"},
          self.sweep_frequency_Hz);
    visit(Parameter{"duty_cycle_s", "s", 1, 3600, "of the random duty cycle"}, self.duty_cycle_s);
    visit(Parameter{"dither_amplitude_A", "A", 0, 1, "of dithered runs, where the electronics have none of their own"},
          self.dither_amplitude_A);
    visit(Parameter{"dither_frequency_Hz", "Hz", 20, 500, "of dithered runs"}, self.dither_frequency_Hz);
    visit(Parameter{"dithered_duty_s", "s", 1, 3600, "of the dithered duty cycle under each load"},
          self.dithered_duty_s);
    visit(Parameter{"overrunning_pressure_bar", "bar", 1, 350, "supply of a whole valve's overrunning loads"},
          self.overrunning_pressure_bar);
  }
};

/// One recording of a campaign.
struct CampaignItem {
  std::string file;         ///< "ramp_60bar.csv"
  std::string protocol;     ///< as campaign.toml names it; empty: a validation run that is not listed there
  std::string direction{};  ///< of a whole valve's bench tests, "a" or "b"; `valve` is turned round for a
  std::string edge{};       ///< "PB", "AT", "PA" or "BT" where the bench feeds that edge alone
  Protocol settings;
  ValveUnderTest valve;  ///< as built
  std::uint64_t seed;
};

/// What a bench feeds at once, and its name in campaign.toml: empty where A and B are joined.
struct FedEdges {
  std::string edge;
  LoadKind load;
};
/// Of that direction of a whole valve, in turn.
[[nodiscard]] std::vector<FedEdges> fed_edges(const CampaignSettings& settings, const std::string& direction);

/// The recordings of one campaign, one after the other.
class CampaignItems {
 public:
  explicit CampaignItems(const ValveUnderTest& valve);

  void add(std::string file, std::string protocol, Protocol settings);
  /// On a valve that differs from the campaign's own.
  void add_with(ValveUnderTest valve, std::string file, std::string protocol, Protocol settings);
  /// A bench test of that direction, "a" or "b", and of that edge alone where one is named.
  void add_bench_test(std::string file, std::string protocol, Protocol settings, std::string direction,
                      std::string edge = {});
  [[nodiscard]] const ValveUnderTest& valve() const { return valve_; }  ///< as built
  std::vector<CampaignItem> take() { return std::move(items_); }

 private:
  ValveUnderTest valve_;
  std::vector<CampaignItem> items_;
};

}  // namespace spoolflow::rig
