#pragma once
/// Global sensitivity over the virtual rig: what share of the sensor's error each sub-model and each instrument makes
/// from one valve of a series to the next.
#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "spoolflow/analysis/scenario.hpp"
#include "spoolflow/analysis/sobol_indices.hpp"
#include "spoolflow/analysis/study_state.hpp"
#include "spoolflow/analysis/valve_factors.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::analysis {

/// One of the outputs.
struct StudyOutput {
  estimation::Estimator estimator;
  bool p95;  ///< 95th percentile of the errors' magnitudes; else root mean square
};
[[nodiscard]] const std::array<StudyOutput, study_outputs>& study_output_list();

struct Study {
  std::string valve;
  bool given_model;
  std::uint32_t base_samples;
  std::size_t runs;  ///< simulated, of all starts together
  double run_s;
  std::array<SobolIndices, study_outputs> indices;
};

/// The runs of a study, each by itself: what one gives follows from the study and its number alone.
class StudyRuns {
 public:
  /// `identity` of the program. Keeps no reference.
  StudyRuns(const model::Model& given, const Scenario& scenario, const rig::ValveAndCampaign& asked,
            const std::string& identity);
  [[nodiscard]] const SaltelliDesign& design() const { return design_; }
  /// Of all that the results follow from.
  [[nodiscard]] std::uint64_t fingerprint() const { return fingerprint_; }
  [[nodiscard]] const rig::ValveUnderTest& nominal() const { return nominal_; }
  /// The sensor with `model`, given or made by virtual_model(), over the runs of those numbers, which are simulated at
  /// once; each as alone. From any thread.
  [[nodiscard]] std::vector<RunErrors> run(const model::Model& model, std::span<const std::size_t> numbers) const;
  /// How many of so many runs are best given to run(), that every worker has some.
  [[nodiscard]] std::size_t runs_at_once(std::size_t runs, unsigned workers) const;

 private:
  Scenario scenario_;
  rig::ValveUnderTest nominal_;
  SaltelliDesign design_;
  std::uint64_t fingerprint_;
};

/// Does the runs of these numbers and reports each result, once and from any thread. `model`: the virtual valve's as
/// the text of a model file; empty: the given one.
using RunsWork =
    std::function<void(const StudyRuns& runs, const std::string& model, const std::vector<std::size_t>& numbers,
                       const std::function<void(std::size_t, const RunErrors&)>& finished)>;

/// How a study is run. None of it changes the result.
struct StudyWork {
  std::string identity;  ///< of the program: another's saved runs are not used
  unsigned workers = 1;
  std::string saved = {};  ///< what an interrupted study saved; empty: nothing. Another study's is not used
  /// Gets all finished runs as text every now and then, from one thread at a time.
  std::function<void(const std::string&)> save = [](const std::string&) {};
  double saving_interval_s = 1;
  /// Task and share of the whole.
  std::function<void(const std::string&, double)> progress = [](const std::string&, double) {};
  RunsWork elsewhere = {};  ///< empty: the runs are done here, on `workers` threads
};

/// The virtual valve that the scenario names. Throws rig::SettingsError for an unknown one, ModelError where the study
/// is to run with a model that has no observer.
[[nodiscard]] rig::ValveAndCampaign study_valve(const model::Model& given, const Scenario& scenario);

/// The result follows from scenario, valve and model alone, whatever the threads and interruptions.
[[nodiscard]] Study global_study(const model::Model& given, const Scenario& scenario,
                                 const rig::ValveAndCampaign& asked, const StudyWork& work);

}  // namespace spoolflow::analysis
