#pragma once
/// What receivers of messages of alarms were told, between them and the store. For any thread.
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "addons/live/history/told_table.hpp"

namespace spoolflow::live {

class ToldAlarms {
 public:
  /// From the store.
  void restore(ToldTexts told) {
    const std::lock_guard lock(mutex_);
    told_ = std::move(told);
  }
  [[nodiscard]] std::optional<std::string> of(const std::string& receiver) const {
    const std::lock_guard lock(mutex_);
    const auto found = told_.find(receiver);
    return found == told_.end() ? std::nullopt : std::optional(found->second);
  }
  /// Kept with the next second's commit.
  void set(const std::string& receiver, std::string alarms) {
    const std::lock_guard lock(mutex_);
    std::string& text = told_[receiver];
    if (text == alarms) return;
    text = std::move(alarms);
    changed_[receiver] = text;
  }
  [[nodiscard]] ToldTexts all() const {
    const std::lock_guard lock(mutex_);
    return told_;
  }
  [[nodiscard]] ToldTexts take_changed() {
    const std::lock_guard lock(mutex_);
    return std::exchange(changed_, {});
  }
  /// They could not be kept.
  void give_back(ToldTexts told) {
    const std::lock_guard lock(mutex_);
    changed_.merge(told);
  }

 private:
  mutable std::mutex mutex_;
  ToldTexts told_, changed_;
};

}  // namespace spoolflow::live
