#include "addons/live/work_together.hpp"

#include <algorithm>

#include "addons/live/blocks/steps.hpp"

namespace spoolflow::live {

void WorkTogether::work(std::span<const ValveTurn> turns) {
  while (!turns.empty()) {
    const std::size_t count = std::min(turns.size(), most_turns);
    work_at_once(turns.first(count));
    turns = turns.subspan(count);
  }
}

void WorkTogether::work(std::span<const ValveBlocks> waiting) {
  for (std::size_t number = 0;; ++number) {
    turns_.clear();
    for (const auto& [valve, blocks] : waiting)
      if (number < blocks.size()) turns_.push_back({valve, &blocks[number]});
    if (turns_.empty()) return;
    work(turns_);
  }
}

/// What a valve shows and what is kept of it is that before its block or that behind it, as it is alone.
void WorkTogether::work_at_once(std::span<const ValveTurn> turns) {
  samples_.resize(most_turns);
  answers_.resize(most_turns);
  runs_.clear();
  std::vector<std::unique_lock<std::mutex>> locks;
  for (std::size_t k = 0; k < turns.size(); ++k) {
    ValveAtWork& valve = *turns[k].valve;
    locks.emplace_back(valve.mutex_);
    std::span<const estimation::TimedSample> samples = turns[k].block->samples;
    if (valve.cutter_) {
      samples_[k].resize(samples.size());
      std::transform(samples.begin(), samples.end(), samples_[k].begin(), fleet::on_grid);
      samples = samples_[k];
    }
    answers_[k].resize(samples.size());
    runs_.push_back({&valve.sensor_, samples, answers_[k]});
  }
  group_.step(runs_);
  for (std::size_t k = 0; k < turns.size(); ++k) {
    ValveAtWork& valve = *turns[k].valve;
    for (std::size_t s = 0; s < answers_[k].size(); ++s) valve.take(runs_[k].samples[s], answers_[k][s]);
    valve.end(*turns[k].block);
    locks[k].unlock();
  }
}

}  // namespace spoolflow::live
