#pragma once
/// A whole campaign of one virtual valve: the bench tests that calibrate it and the operating runs that judge the
/// result, under the file names of a real campaign.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace spoolflow::rig {

/// What the campaign measures; the table [campaign] of a valve file.
struct CampaignSettings {
  std::vector<double> oil_temperatures_C{30, 50, 70};
  std::vector<double> pressure_differences_bar{5, 10, 20, 30, 40, 50, 60, 70};
  double ramp_pressure_bar = 60.0;
  std::vector<double> ramps_pressures_bar{30, 40, 50, 60, 70};
  double ramps_position_faults_per_s = 0.1;
  double sweep_pressure_bar = 50.0;
  double sweep_frequency_Hz = 8.0;
  double duty_cycle_s = 180.0;
  double dither_amplitude_A = 0.2;
  double dither_frequency_Hz = 160.0;
  double dithered_duty_s = 40.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"oil_temperatures_C", "degC", -20, 100, "one axial-force map each"}, self.oil_temperatures_C);
    visit(Parameter{"pressure_differences_bar", "bar", 0.5, 350, "levels of each axial-force map"},
          self.pressure_differences_bar);
    visit(Parameter{"ramp_pressure_bar", "bar", 0.5, 350, "of the run that goes into campaign.toml"},
          self.ramp_pressure_bar);
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
  }
};

/// One recording of a campaign.
struct CampaignItem {
  std::string file;      ///< "ramp_60bar.csv"
  std::string protocol;  ///< as campaign.toml names it; empty: a validation run that is not listed there
  Protocol settings;
  ValveUnderTest valve;  ///< as built
  std::uint64_t seed;
};

struct ValveAndCampaign {
  ValveUnderTest valve;
  CampaignSettings campaign;
};
/// `valve` is a valve file, its table [campaign] included, or the name of a preset. Throws SettingsError.
[[nodiscard]] ValveAndCampaign read_valve_and_campaign(const std::string& valve);

/// Bench tests first, then the operating runs.
[[nodiscard]] std::vector<CampaignItem> campaign_items(const ValveUnderTest& valve, const CampaignSettings& settings);
/// Those that campaign.toml lists, and of the operating runs only the one at the ramp pressure.
[[nodiscard]] std::vector<CampaignItem> calibration_items(const ValveUnderTest& valve,
                                                          const CampaignSettings& settings);

/// campaign.toml for those items.
[[nodiscard]] std::string campaign_text(const ValveUnderTest& valve, const std::vector<CampaignItem>& items);

struct CampaignWork {
  /// Gets each finished recording, from the worker that made it; calls for different items may overlap.
  std::function<void(const CampaignItem&, const BenchRun&, const Simulation&)> store;
  /// Share of the whole, 0 to 1, from one of the workers; calls never overlap.
  std::function<void(double)> progress{};
  unsigned workers = 2;
  bool with_truth = false;
};

/// Simulates every item, the longest first. The recordings do not depend on the number of workers. Rethrows the first
/// exception of a worker once the others have stopped.
void run_campaign(const std::vector<CampaignItem>& items, const CampaignWork& work);

}  // namespace spoolflow::rig
