#include "addons/live/sources/replay_source.hpp"

#include <cmath>
#include <exception>

#include "spoolflow/estimation/recordings/sensor_channels.hpp"

namespace spoolflow::live {
namespace {

/// Samples are handed over in pieces of so much playing time.
constexpr double replayed_piece_s = 0.01;
constexpr std::size_t largest_piece = 1024;

}  // namespace

ReplaySource::ReplaySource(ReplaySettings settings, recording::ReadOptions options, SourcePosition after,
                           Intake& intake)
    : settings_(std::move(settings)), options_(std::move(options)), skip_(after.next), intake_(intake) {
  options_.runs_on = true;
  (void)estimation::open_sensor_channels(settings_.recording, options_);  // reports at once what is wrong with it
  intake_.count_connection();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void ReplaySource::run(const std::stop_token& stop) {
  try {
    do {
      const std::uint64_t before = next_;
      if (!play(*estimation::open_sensor_channels(settings_.recording, options_), stop)) return;
      const double pass_s = last_s_ - first_s_ + last_step_s_;
      const std::uint64_t pass = next_ - before;
      if (pass == 0) break;
      added_s_ += pass_s;
      if (next_ < skip_) {  // whole passes that were worked on before
        const std::uint64_t passes = (skip_ - next_) / pass;
        next_ += passes * pass;
        added_s_ += static_cast<double>(passes) * pass_s;
      }
    } while (settings_.repeats);
    intake_.set_trouble("the recording has ended");
    ended_ = true;
  } catch (const std::exception& error) {
    intake_.set_trouble(error.what());
  }
}

bool ReplaySource::play(recording::Reader& reader, const std::stop_token& stop) {
  recording::SampleBlock block;
  std::vector<estimation::TimedSample> piece;
  bool first = true;
  while (reader.next(block)) {
    for (estimation::TimedSample& sample : samples_of(block)) {
      if (std::isfinite(sample.time_s)) {
        if (first) first_s_ = sample.time_s;
        if (!first && sample.time_s > last_s_) last_step_s_ = sample.time_s - last_s_;
        first = false;
        last_s_ = sample.time_s;
        sample.time_s += added_s_;
      }
      if (next_++ < skip_) continue;
      piece.push_back(sample);
      const double length_s = piece.back().time_s - piece.front().time_s;
      const bool whole =
          settings_.speed == 0 ? piece.size() >= largest_piece : !(length_s < replayed_piece_s * settings_.speed);
      if (!whole && piece.size() < largest_piece) continue;
      if (!hand_over(std::exchange(piece, {}), stop)) return false;
    }
  }
  return piece.empty() || hand_over(std::move(piece), stop);
}

bool ReplaySource::hand_over(std::vector<estimation::TimedSample>&& samples, const std::stop_token& stop) {
  SampleBlock block{.samples = std::move(samples), .after = {.next = next_}};
  if (settings_.speed == 0) {
    block.arrived_ns = steady_ns();
    return intake_.push_waiting(std::move(block), stop);
  }
  const double time_s = block.samples.back().time_s;
  if (std::isfinite(time_s)) {
    const double ahead_s = (time_s - clock_s_) / settings_.speed;
    if (!paced_ || !(ahead_s >= 0) || ahead_s > 3600) {  // the first, a time that runs back, or one that leaps
      paced_ = true;
      clock_ = std::chrono::steady_clock::now();
      clock_s_ = time_s;
    } else {
      const auto ahead = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(ahead_s));
      if (!parallel::wait_until(clock_ + ahead, stop)) return false;
    }
  }
  block.arrived_ns = steady_ns();
  intake_.push(std::move(block));
  return true;
}

}  // namespace spoolflow::live
