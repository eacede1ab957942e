#pragma once
/// One valve of a site: its sensor, its monitor, and what is reported and kept of them. Safe to be asked from any
/// thread.
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "addons/live/history/store.hpp"
#include "addons/live/sources/sample_block.hpp"
#include "addons/live/valve/block_cutter.hpp"
#include "addons/live/valve/plot_trace.hpp"
#include "addons/live/valve/raw_trace.hpp"
#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/monitor.hpp"

namespace spoolflow::live {

/// A model that valves share, and what distinguishes it from others.
struct SharedModel {
  std::shared_ptr<const model::Model> model;
  std::string sha256;            ///< of its file
  std::filesystem::path file{};  ///< empty: embedded
};

/// What a valve shows at an instant.
struct ValveView {
  std::string id;
  double rated_flow_m3_per_s = 0;
  double time_s = 0;                ///< of the last sample; NaN: none since the start
  sensor::Estimate<double> answer;  ///< its band widened while the monitor doubts the model
  bool doubted = false;             ///< whether it does
  std::uint64_t samples = 0;        ///< since the store began
  double energy_J = 0;              ///< likewise
  std::int64_t arrived_ns = 0;      ///< when the last sample came, by the steady clock; 0: none yet
  monitor::Ne107 condition = monitor::Ne107::good;
  std::vector<monitor::Cause> causes;
  std::vector<monitor::Indicator> indicators;  ///< empty where the model has no observer
};

class ValveAtWork {
 public:
  /// `program`: name and version, of whose kept states none other is taken. `raw_s`: of raw samples that are at hand.
  ValveAtWork(std::string id, SharedModel model, std::string_view program, double raw_s = 0);

  [[nodiscard]] const std::string& id() const { return id_; }
  /// Goes on from what was kept. Returns false where sensor and monitor start again, as model or program were others,
  /// or bytes are damaged.
  bool restore(const KeptState& kept);

  /// From now on samples are worked on as the fleet gets them (fleet::on_grid), and blocks of them are kept for it.
  void publish(std::string name, const OutboxPosition& after, const BlockLimits& limits);

  void work(const SampleBlock& block);
  /// The source is over: the monitor judges what it had gathered.
  void finish();

  /// Indicators take as long as a hundred samples: not for those who look often and need none.
  [[nodiscard]] ValveView view(bool with_indicators = true) const;
  /// When the last sample came, by the steady clock; 0: none yet.
  [[nodiscard]] std::int64_t arrived_ns() const;
  /// The points of the plot from that number on, and which was the first; `arrived_ns` of the newest sample in them.
  struct TracePart {
    std::uint64_t first;
    std::vector<PlotPoint> points;
    std::int64_t arrived_ns;
  };
  [[nodiscard]] TracePart trace_from(std::uint64_t first) const;
  [[nodiscard]] std::uint64_t trace_size() const;

  /// Raw samples of that time as a recording's CSV, as far as they are at hand.
  [[nodiscard]] std::string raw_csv(double from_s, double to_s) const;

  /// What is to be kept now, and of what came since the last time; `with_indicators`: theirs too.
  [[nodiscard]] ValveCommit take_commit(bool with_indicators);
  /// What came since the last commit or summary alone.
  [[nodiscard]] Summary take_summary();
  /// It could not be kept: what came since then is returned together next time, its blocks come again. Returns how many
  /// blocks are given up, as BlockCutter does.
  std::size_t give_back(const ValveCommit& commit);

 private:
  /// What is made of a sample, in the grid of the fleet where it gets them, and of its sensor's answer, which depends
  /// on nothing here; and what is reported after a block.
  void take(const estimation::TimedSample& sample, const sensor::Estimate<double>& answer);
  void end(const SampleBlock& block);
  void add_to_summary(const estimation::TimedSample& sample, const sensor::Estimate<double>& answer);
  void ask_doubt(double time_s);

  std::string id_;
  SharedModel model_;
  std::string layout_;  ///< of what is kept: other bytes are not taken
  mutable std::mutex mutex_;
  estimation::RunningSensor sensor_;
  std::optional<monitor::Monitor> watch_;  ///< of models that have an observer
  monitor::Doubt doubt_;
  SourcePosition after_;
  SourceCounts counted_before_{};  ///< in the store when the program started
  IntakeCounters counted_{};       ///< since then, up to the sample that was worked on last
  std::uint64_t samples_ = 0;
  double energy_J_ = 0;
  double time_s_;        ///< of the last sample, also before this start
  double doubt_second_;  ///< of the source's clock, in which doubt was asked last
  std::int64_t arrived_ns_ = 0;
  sensor::Estimate<double> last_{};
  Summary summary_;
  PlotTrace trace_;
  RawTrace raw_;
  std::optional<BlockCutter> cutter_;  ///< where the fleet gets the samples
};

}  // namespace spoolflow::live
