#pragma once
/// Work of the commands that an add-on can do on other machines (`--fleet`). The program `spoolflow` has none of it; a
/// program that has sets these before it parses its arguments.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "spoolflow/analysis/study.hpp"
#include "spoolflow/apps/calibrate_work.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/estimate_work.hpp"
#include "spoolflow/apps/work/monitored_recording.hpp"
#include "spoolflow/report/monitor/monitored_run.hpp"

namespace spoolflow::apps {

/// What a global study is made from.
struct StudyInputs {
  std::string fleet;       ///< fleet file
  std::string model_file;  ///< the given model's
  std::string direction;   ///< of a whole valve's model the one that is studied
  const analysis::Scenario& scenario;
  std::string scenario_file;  ///< from which it was read; empty: none
};

/// How far the watch over a valve has come.
struct Watched {
  monitor::MonitorState state{};
  std::vector<report::TrendPoint> trend{};
  report::DoubtFigures band{};
};

/// Does one piece of work and keeps its failure.
using Attempt = std::function<void(const std::function<void()>&)>;

struct Elsewhere {
  /// One summary a recording, in their order; the estimates stand at `targets`.
  std::function<std::vector<validation::EstimateSummary>(const EstimateTask&, const EstimateArguments&,
                                                         const std::vector<std::filesystem::path>& targets)>
      estimate;
  std::function<void(const CalibrateArguments&, const std::vector<CalibrationTask>&, const Attempt&)> calibrate;
  std::function<analysis::RunsWork(const StudyInputs&)> study;
  /// The watch after the next recording, each from where the one before ended.
  std::function<std::function<Watched(const std::string& recording)>(const MonitorArguments&)> monitor;
};

/// The program's own.
[[nodiscard]] inline Elsewhere& elsewhere() {
  static Elsewhere of_the_program;
  return of_the_program;
}

}  // namespace spoolflow::apps
