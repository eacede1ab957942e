#pragma once
/// A recording played back as if its valve were at work.
#include <filesystem>
#include <thread>

#include "addons/live/sources/csv_stream.hpp"
#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::live {

struct ReplaySettings {
  std::filesystem::path recording;
  double speed = 1.0;    ///< recorded seconds a second; 0: as fast as they are worked on, none dropped
  bool repeats = false;  ///< over and over, time going on
};

class ReplaySource {
 public:
  /// Goes on behind the samples that were worked on before. Throws RecordingError where the recording cannot be read.
  ReplaySource(ReplaySettings settings, recording::ReadOptions options, SourcePosition after, Intake& intake);
  /// Whether the recording was played to its end; never where it repeats.
  [[nodiscard]] bool ended() const { return ended_; }
  void ask_to_stop() { thread_.request_stop(); }

 private:
  void run(const std::stop_token& stop);
  bool play(recording::Reader& reader, const std::stop_token& stop);
  bool hand_over(std::vector<estimation::TimedSample>&& samples, const std::stop_token& stop);

  ReplaySettings settings_;
  recording::ReadOptions options_;
  std::uint64_t skip_;               ///< samples that were worked on before
  std::uint64_t next_ = 0;           ///< sequence number
  double added_s_ = 0;               ///< to the recorded times, from pass to pass
  double first_s_ = 0, last_s_ = 0;  ///< recorded times of this pass
  double last_step_s_ = 0;
  bool paced_ = false;          ///< the clock below was set
  parallel::SteadyTime clock_;  ///< of a sample whose recorded and added time is `clock_s_`
  double clock_s_ = 0;
  Intake& intake_;
  std::atomic<bool> ended_ = false;
  std::jthread thread_;
};

}  // namespace spoolflow::live
