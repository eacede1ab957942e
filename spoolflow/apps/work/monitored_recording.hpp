#pragma once
/// Recordings of one valve at work through its sensor and its watch.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/monitor/baseline.hpp"
#include "spoolflow/monitor/monitor.hpp"
#include "spoolflow/plausibility/finding.hpp"
#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/report/monitor/monitored_run.hpp"

namespace spoolflow::apps {

/// What `monitor --json` wrote of healthy runs; nothing where no file is named. Throws ModelError.
[[nodiscard]] std::optional<monitor::Baseline> read_baseline(const std::string& file);

/// The band as reported and as the raised indicators widen it.
class BandWatch {
 public:
  /// Goes on from there.
  explicit BandWatch(const report::DoubtFigures& figures = {}) : figures_(figures) {}
  void take(const model::Model& model, const monitor::Monitor& watch, const estimation::TimedSample& sample,
            const sensor::Estimate<double>& answer);
  [[nodiscard]] const report::DoubtFigures& figures() const { return figures_; }

 private:
  monitor::Doubt doubt_;
  double windows_ = -1;
  report::DoubtFigures figures_;
};

/// What is known after several recordings.
struct MonitoredRuns {
  std::vector<report::MonitoredRun> runs;
  std::vector<report::TrendPoint> trend;
  BandWatch band{};
};

/// The same strokes twice are no more evidence than once: throws ModelError. Pipes cannot be read twice, and are passed
/// over.
void refuse_given_twice(const std::vector<std::string>& recordings);

/// What is to be said of a recording that was watched.
struct WatchedRecording {
  std::vector<plausibility::Finding> findings;  ///< that speak against it: such indicators are not the valve's
  std::string as_read;  ///< columns on another time, or not read (recording::ReadNotes); empty: nothing
};

/// "doubt: … ; what is raised may be the recording's and not the valve's".
[[nodiscard]] std::string doubt_text(const plausibility::Finding& finding);

/// One recording through sensor and watch. `progress` receives the share read, where it is known.
WatchedRecording monitor_recording(const model::Model& model, const std::string& recording,
                                   const recording::ChannelMap& channels, monitor::Monitor& watch,
                                   std::vector<report::TrendPoint>& trend, BandWatch& band,
                                   const std::function<void(std::optional<double>)>& progress);

}  // namespace spoolflow::apps
