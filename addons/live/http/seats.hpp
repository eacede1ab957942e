#pragma once
/// The connections that there may be, of all and of one address. Where there are too many the one ends that has waited
/// longest for its other side: idle connections keep nobody out.
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace spoolflow::live {

class Seats {
  struct Entry {
    std::string peer;
    std::function<void()> end{};  ///< empty: the server works for it
    std::chrono::steady_clock::time_point since{};
  };

 public:
  using Time = std::chrono::steady_clock::time_point;
  /// A proxy, which stands for many, leaves some to others.
  static constexpr std::size_t most = 256, most_of_one = 64, most_of_a_proxy = 224;

  /// A connection's place, free again when it is destroyed.
  class Seat {
   public:
    Seat(Seats& of, std::shared_ptr<Entry> entry) : of_(&of), entry_(std::move(entry)) {}
    ~Seat() {
      if (entry_) of_->leave(entry_);
    }
    Seat(Seat&&) noexcept = default;
    Seat& operator=(Seat&&) = delete;
    [[nodiscard]] const std::string& peer() const { return entry_->peer; }
    /// The connection waits for its other side, and may be ended for another one behind that time.
    void waits(Time since, std::function<void()> end) const { of_->change(*entry_, since, std::move(end)); }
    void works() const { of_->change(*entry_, {}, {}); }

   private:
    Seats* of_;
    std::shared_ptr<Entry> entry_;
  };

  /// Nothing where all are taken and the server works for each.
  [[nodiscard]] std::optional<Seat> take(const std::string& peer, bool is_proxy, Time now) {
    const std::size_t share = is_proxy ? most_of_a_proxy : most_of_one;
    if (count(peer) >= share && !end_one(now, [&](const Entry& one) { return one.peer == peer; })) return std::nullopt;
    if (size() >= most && !end_longest_waiting(now)) return std::nullopt;
    const std::lock_guard lock(mutex_);
    entries_.push_back(std::make_shared<Entry>(Entry{peer}));
    return std::optional<Seat>(std::in_place, *this, entries_.back());
  }
  /// Of the address that has most of those that wait. False where none waits.
  bool end_longest_waiting(Time now) {
    std::string whose;
    std::size_t largest = 0;
    {
      const std::lock_guard lock(mutex_);
      for (const auto& one : entries_) {
        const auto of_peer = static_cast<std::size_t>(std::count_if(
            entries_.begin(), entries_.end(), [&](const auto& other) { return other->peer == one->peer; }));
        if (!may_end(*one, now) || of_peer <= largest) continue;
        largest = of_peer;
        whose = one->peer;
      }
    }
    return end_one(now, [&](const Entry& one) { return one.peer == whose; });
  }

 private:
  static bool may_end(const Entry& one, Time now) { return one.end && one.since <= now; }
  template <class Chosen>
  bool end_one(Time now, Chosen&& chosen) {
    std::function<void()> end;
    {
      const std::lock_guard lock(mutex_);
      auto longest = entries_.end();
      for (auto one = entries_.begin(); one != entries_.end(); ++one) {
        if (!may_end(**one, now) || !chosen(**one)) continue;
        if (longest == entries_.end() || (*one)->since < (*longest)->since) longest = one;
      }
      if (longest == entries_.end()) return false;
      end = std::exchange((*longest)->end, nullptr);
      entries_.erase(longest);
    }
    end();
    return true;
  }
  std::size_t count(const std::string& peer) {
    const std::lock_guard lock(mutex_);
    return static_cast<std::size_t>(
        std::count_if(entries_.begin(), entries_.end(), [&](const auto& one) { return one->peer == peer; }));
  }
  std::size_t size() {
    const std::lock_guard lock(mutex_);
    return entries_.size();
  }
  void change(Entry& entry, Time since, std::function<void()>&& end) {
    const std::lock_guard lock(mutex_);
    entry.since = since;
    entry.end = std::move(end);
  }
  void leave(const std::shared_ptr<Entry>& entry) {
    const std::lock_guard lock(mutex_);
    std::erase(entries_, entry);
  }

  std::mutex mutex_;
  std::vector<std::shared_ptr<Entry>> entries_;
};

}  // namespace spoolflow::live
