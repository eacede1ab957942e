#pragma once
/// The alarms that receivers of messages have, between them and the store. For any thread.
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "addons/live/history/reported_table.hpp"

namespace spoolflow::live {

class ReportedAlarms {
 public:
  /// From the store.
  void restore(ReportedTexts reported) {
    const std::lock_guard lock(mutex_);
    reported_ = std::move(reported);
  }
  [[nodiscard]] std::optional<std::string> of(const std::string& receiver) const {
    const std::lock_guard lock(mutex_);
    const auto found = reported_.find(receiver);
    return found == reported_.end() ? std::nullopt : std::optional(found->second);
  }
  /// Kept with the next second's commit.
  void set(const std::string& receiver, std::string alarms) {
    const std::lock_guard lock(mutex_);
    std::string& text = reported_[receiver];
    if (text == alarms) return;
    text = std::move(alarms);
    changed_[receiver] = text;
  }
  [[nodiscard]] ReportedTexts all() const {
    const std::lock_guard lock(mutex_);
    return reported_;
  }
  [[nodiscard]] ReportedTexts take_changed() {
    const std::lock_guard lock(mutex_);
    return std::exchange(changed_, {});
  }
  /// They could not be kept.
  void give_back(ReportedTexts reported) {
    const std::lock_guard lock(mutex_);
    changed_.merge(reported);
  }

 private:
  mutable std::mutex mutex_;
  ReportedTexts reported_, changed_;
};

}  // namespace spoolflow::live
