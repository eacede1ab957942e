#pragma once
/// Steps of a stream that work beside one another, each in a thread of its own.
#include <array>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "spoolflow/apps/terminal/interruption.hpp"

namespace spoolflow::apps {

/// Produces items in a thread of its own, a few ahead of whoever takes them, in order.
template <class Item>
class Ahead {
 public:
  /// `produce(item)` fills an item, whose capacities are those of an earlier one, and returns whether there was one
  /// more. `beside` false, or no thread to be had: each item is produced when it is asked for.
  Ahead(std::function<bool(Item&)> produce, bool beside) : produce_(std::move(produce)), beside_(beside) {
    const InterruptionPause inherited;  // interruptions are the main thread's, which holds them back where it must
    if (!beside_) return;
    try {
      thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    } catch (const std::system_error&) {  // no further thread is to be had
      beside_ = false;
    }
  }
  /// Waits for the item that is being produced.
  ~Ahead() {
    thread_.request_stop();
    changed_.notify_all();
  }
  Ahead(const Ahead&) = delete;
  Ahead& operator=(const Ahead&) = delete;

  /// The next item, the caller's until the next call; null after the last one. Throws what `produce` threw, after the
  /// items before.
  Item* next() {
    if (!beside_) return produce_(items_.front()) ? &items_.front() : nullptr;
    std::unique_lock lock(mutex_);
    if (std::exchange(taken_, false)) {
      ++first_;
      lock.unlock();  // whoever is woken needs it
      changed_.notify_all();
      lock.lock();
    }
    changed_.wait(lock, [this] { return first_ < end_ || ended_; });
    if (first_ < end_) {
      taken_ = true;
      return &items_[first_ % items_.size()];
    }
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return nullptr;
  }

 private:
  void run(const std::stop_token& stop) {
    for (std::size_t k = 0;; ++k) {
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, stop, [&] { return k < first_ + items_.size(); });
      }
      bool more = false;
      std::exception_ptr failure;
      if (!stop.stop_requested()) {
        try {
          more = produce_(items_[k % items_.size()]);
        } catch (...) {
          failure = std::current_exception();
        }
      }
      {
        const std::lock_guard lock(mutex_);
        if (more) {
          end_ = k + 1;
        } else {
          ended_ = true;
          failure_ = failure;
        }
      }
      changed_.notify_all();  // unlocked: whoever is woken needs it
      if (!more) return;
    }
  }

  std::function<bool(Item&)> produce_;
  bool beside_;
  std::array<Item, 4> items_{};
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::size_t first_ = 0, end_ = 0;  ///< items [first_, end_) are ready or taken
  bool taken_ = false, ended_ = false;
  std::exception_ptr failure_;
  std::jthread thread_;  ///< last: it uses the others
};

}  // namespace spoolflow::apps
