#pragma once
/// Runs of many valves through sensors that are stepped together, each run of its own length and sampling rate.
#include <span>
#include <type_traits>
#include <vector>

#include "spoolflow/estimation/batch/valve_batch.hpp"
#include "spoolflow/estimation/columns.hpp"

namespace spoolflow::estimation::batch {

/// A valve of a batch. `Parameters` as in ValveBatch.
template <class Parameters>
struct BatchedValve {
  const Parameters* parameters;
  double rated_flow_m3_per_s;
};

/// As many RunningSensors as there are valves, in single precision: the same rules for times, for what is told before
/// the first complete sample, and for the coils of whole valves.
template <class Parameters>
class RunningBatch {
 public:
  /// Any number of valves but none; copies their parameters. Places that are left over in the last registers are filled
  /// up. Throws as ValveBatch does.
  explicit RunningBatch(std::span<const BatchedValve<Parameters>> valves,
                        InstructionSet instructions = instruction_sets().back());

  [[nodiscard]] std::size_t size() const { return rated_flow_m3_per_s_.size(); }

  /// The next samples of every valve, as many as each has: one estimate a sample, in answers[valve], which is as long
  /// as runs[valve]. A valve whose samples are over waits for the others; runs of about one length waste least. Throws
  /// std::invalid_argument where there are not as many runs and answers as valves, or their lengths differ, and where a
  /// run is of a whole valve's two coils and the valves are of one direction.
  void run(std::span<const Columns> runs, std::span<const std::span<sensor::Estimate<float>>> answers);

 private:
  /// The valves that run side by side, sample after sample.
  struct Rows {
    std::vector<float> time_step_s, current_A, voltage_V, position_m, oil_temperature_K;
    std::vector<float> current_a_A, voltage_a_V;  ///< of whole valves, whose others are those of coil b
    std::vector<float> flow_m3_per_s, flow_lower_m3_per_s, flow_upper_m3_per_s, pressure_difference_Pa;
    std::vector<float> magnetic_force_N, spring_force_N, flow_force_N, friction_force_N;
    std::vector<sensor::Status> status;
    std::vector<SteppedSample<float>> given;
    explicit Rows(std::size_t numbers);
    void put(std::size_t at, const sensor::Sample<float>& sample);
    void put(std::size_t at, const sensor::WholeValveSample<float>& sample);
    [[nodiscard]] sensor::Estimate<float> answer(std::size_t at) const;
  };
  static constexpr bool whole = std::is_same_v<typename BatchedKind<Parameters>::Rows, WholeSampleRows>;
  void fill(std::span<const Columns> runs, std::size_t from, std::size_t count);
  void put(std::size_t at, std::size_t valve, TimedSample sample);
  void step(std::size_t count);

  std::vector<double> rated_flow_m3_per_s_;
  std::vector<SolenoidLimits> limits_;
  std::vector<SampleTimes> times_;
  std::vector<StillPosition> positions_;
  std::size_t places_;  ///< of valves in the batch, those that fill it up included
  ValveBatch<Parameters> batch_;
  Rows rows_;
};

extern template class RunningBatch<sensor::CondensedTables<float>>;
extern template class RunningBatch<sensor::ObserverParameters<float>>;
extern template class RunningBatch<sensor::WholeCondensedTables<float>>;
extern template class RunningBatch<sensor::WholeValveParameters<float>>;

}  // namespace spoolflow::estimation::batch
