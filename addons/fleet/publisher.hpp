#pragma once
/// A site's side: sends the blocks that its store keeps, hears which the fleet has committed, and sends again what
/// comes not to be covered in time.
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "addons/fleet/delivery.hpp"
#include "addons/fleet/standstill.hpp"
#include "addons/fleet/transport/nats.hpp"
#include "addons/live/engine.hpp"

namespace spoolflow::fleet {

class Publisher {
 public:
  /// Of the engine's site, which must have servers and a store. Throws LoginError. `report`: as of Worker.
  Publisher(live::Engine& engine, std::function<void(const std::string&)> report);
  ~Publisher();
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  void run(const std::stop_token& stop);
  void look_for_new(live::Database& database);
  void report_connection(bool connected);
  void report_standstill();
  void hear(Subscription& coverage, Subscription& asks);
  void take_coverage(const std::string& text);
  void answer(const std::string& ask);
  void send_model(const std::string& sha256);
  void send(live::Database& database);
  void send(live::Database& database, const std::string& valve, Delivery& at);

  live::Engine& engine_;
  std::function<void(const std::string&)> report_;
  std::shared_ptr<live::Output> output_;  ///< of the site's page and metrics
  Connection nats_;
  std::map<std::string, Delivery> valves_;
  /// A model that was asked for, as it travels.
  struct SentModel {
    std::string packed{};
    Clock::time_point sent{};
  };
  std::map<std::string, SentModel> models_;  ///< by hash
  Standstill standstill_;
  std::string standing_;  ///< what it says of a standstill; empty: there is none
  std::jthread thread_;
};

}  // namespace spoolflow::fleet
