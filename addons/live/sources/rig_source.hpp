#pragma once
/// A valve of the virtual rig at work in real time, which may age while it works.
#include <atomic>
#include <cstdint>
#include <thread>

#include "addons/live/sources/intake.hpp"
#include "spoolflow/parallel/pace.hpp"
#include "spoolflow/rig/bench/valve_under_test.hpp"

namespace spoolflow::live {

/// Wear that grows in proportion to time.
struct Ageing {
  rig::Wear until{};    ///< what it comes to, on top of the valve's own
  double after_s = 0;   ///< of work that change nothing
  double over_s = 600;  ///< of work from no wear to all of it, > 0
};

/// What a valve of the rig does all day.
enum class RigWork {
  duty,     ///< random strokes at rates from slow to fast, under loads that change
  strokes,  ///< slow strokes to the full opening and back at a held pressure difference, as of a press
};

struct RigSettings {
  rig::ValveUnderTest valve;  ///< before spread and wear
  std::uint64_t seed = 1;     ///< of its work and its instruments' noise
  double speed = 1.0;         ///< seconds of work a second, > 0
  Ageing ageing{};
  RigWork work = RigWork::duty;
};

/// Drives the valve through its work without end.
class RigSource {
 public:
  RigSource(RigSettings settings, SourcePosition after, Intake& intake);
  void ask_to_stop() { thread_.request_stop(); }

 private:
  void run(const std::stop_token& stop);

  RigSettings settings_;
  std::uint64_t next_;
  Intake& intake_;
  std::jthread thread_;
};

/// The plant after so much work [s]; `plant` is that before.
[[nodiscard]] rig::PlantParameters aged(const rig::PlantParameters& plant, const Ageing& ageing, double worked_s);

}  // namespace spoolflow::live
