#include "addons/live/sources/intake.hpp"

#include <chrono>
#include <utility>

namespace spoolflow::live {

std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::int64_t wall_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

void Intake::append(SampleBlock&& block) {
  block.counted = counters();
  waiting_ += block.samples.size();
  blocks_.push_back(std::move(block));
}

void Intake::push(SampleBlock&& block) {
  received_ += block.samples.size();
  lost_ += block.lost_before;
  bool first = false;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_ + block.samples.size() > most_samples) {
      dropped_ += block.samples.size();
      return;
    }
    first = blocks_.empty();
    append(std::move(block));
  }
  if (first) arrived_();
}

bool Intake::push_waiting(SampleBlock&& block, const std::stop_token& stop) {
  bool first = false;
  {
    std::unique_lock lock(mutex_);
    const std::size_t count = block.samples.size();
    if (!room_.wait(lock, stop, [&] { return waiting_ == 0 || waiting_ + count <= most_samples; })) return false;
    received_ += count;
    first = blocks_.empty();
    append(std::move(block));
  }
  if (first) arrived_();
  return true;
}

void Intake::take(std::vector<SampleBlock>& blocks) {
  blocks.clear();
  {
    const std::lock_guard lock(mutex_);
    std::swap(blocks, blocks_);
    waiting_ = 0;
  }
  room_.notify_all();
}

void Intake::set_trouble(std::string trouble) {
  const std::lock_guard lock(mutex_);
  trouble_ = std::move(trouble);
}

std::string Intake::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

void Intake::set_unread(std::string columns) {
  const std::lock_guard lock(mutex_);
  unread_ = std::move(columns);
}

std::string Intake::unread() const {
  const std::lock_guard lock(mutex_);
  return unread_;
}

bool Intake::empty() const {
  const std::lock_guard lock(mutex_);
  return blocks_.empty();
}

IntakeCounters Intake::counters() const {
  return {received_, dropped_, lost_, repeated_, unreadable_, connections_};
}

}  // namespace spoolflow::live
