#pragma once
/// How outputs beside the page fare (CAN, Modbus, MQTT, messages, the way to a fleet): counted by their own threads,
/// read by the page from any.
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace spoolflow::live {

struct OutputView {
  std::string name;             ///< "can", "modbus", "mqtt", "fleet"
  std::uint64_t sent = 0;       ///< frames, answers, messages or blocks
  std::uint64_t received = 0;   ///< frames or requests that were for this site
  std::uint64_t dropped = 0;    ///< what found no room, or nobody took
  std::uint64_t waiting = 0;    ///< messages that are kept until they can be sent; blocks that are not committed
  std::uint64_t connected = 0;  ///< peers at present
  std::string trouble;          ///< why nothing goes out at present; empty: none
};

class Output {
 public:
  explicit Output(std::string name) : name_(std::move(name)) {}

  std::atomic<std::uint64_t> sent{0}, received{0}, dropped{0}, waiting{0}, connected{0};

  void set_trouble(const std::string& text) {
    const std::lock_guard lock(mutex_);
    trouble_ = text;
  }
  [[nodiscard]] OutputView view() const {
    const std::lock_guard lock(mutex_);
    return {name_, sent, received, dropped, waiting, connected, trouble_};
  }

 private:
  std::string name_;
  mutable std::mutex mutex_;
  std::string trouble_;
};

/// All outputs of a site; those that ended stay.
class Outputs {
 public:
  [[nodiscard]] std::shared_ptr<Output> add(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return all_.emplace_back(std::make_shared<Output>(name));
  }
  [[nodiscard]] std::vector<OutputView> views() const {
    const std::lock_guard lock(mutex_);
    std::vector<OutputView> out;
    for (const auto& one : all_) out.push_back(one->view());
    return out;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<Output>> all_;
};

}  // namespace spoolflow::live
