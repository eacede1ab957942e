#include "addons/live/fieldbus/can_sender.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "addons/live/fieldbus/can_ports.hpp"
#include "addons/live/fieldbus/plant_answers.hpp"
#include "addons/live/protocols/canopen_device.hpp"
#include "addons/live/protocols/j1939_address.hpp"
#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::live {

struct CanSender::Parts {
  struct Auxiliary {
    std::size_t valve;
    sensor::AuxiliaryValve at;
  };
  struct Node {
    std::size_t valve;
    fieldbus::CanopenDevice device;
  };
  static constexpr std::uint32_t tick_ms = 10;
  /// SAE J1939-81: who claims an address sends nothing else under it until others had this time to object.
  static constexpr std::uint32_t objection_ms = 250;

  Engine& engine;
  CanSettings settings;
  std::vector<std::unique_ptr<CanPort>> ports;
  std::shared_ptr<Output> output;
  fieldbus::J1939Address address;
  std::uint32_t claimed_tick = 0;
  std::vector<Auxiliary> auxiliaries{};
  std::vector<Node> nodes{};
  std::jthread thread{};

  Parts(Engine& of, const CanSettings& with)
      : engine(of),
        settings(with),
        ports(open_can_ports(with)),
        output(of.outputs().add("can")),
        address(with.source_address) {
    for (std::size_t k = 0; k < engine.size(); ++k) {
      const std::string& id = engine.valve(k).id();
      if (const auto at = settings.auxiliary_valve.find(id); at != settings.auxiliary_valve.end()) {
        auxiliaries.push_back({k, {at->second, settings.source_address}});
      }
      if (const auto at = settings.node.find(id); at != settings.node.end()) {
        nodes.push_back({k, fieldbus::CanopenDevice({at->second, settings.period_ms})});
      }
    }
  }

  void send(const sensor::CanFrame& frame) {
    const double now_s = 1e-3 * static_cast<double>(wall_ms());
    for (const auto& port : ports) {
      if (port->send(frame, now_s)) {
        ++output->sent;
      } else {
        ++output->dropped;
      }
    }
  }
  void claim(std::uint32_t tick) {
    if (auxiliaries.empty()) return;
    claimed_tick = tick;
    send(address.claim());
  }
  void hear() {
    constexpr int most_in_a_tick = 200;
    for (const auto& port : ports) {
      for (int k = 0; k < most_in_a_tick; ++k) {
        const auto frame = port->receive();
        if (!frame) break;
        ++output->received;
        if (const auto claim = auxiliaries.empty() ? std::nullopt : address.hear(*frame)) send(*claim);
        for (Node& node : nodes) {
          const bool is_for_it = !frame->extended && (frame->id == 0 || frame->id == 0x600U + node.device.node());
          if (!is_for_it) continue;
          if (const auto answer = node.device.hear(*frame, answer_of(engine, node.valve))) send(*answer);
        }
      }
    }
  }
  void send_due(std::uint32_t tick) {
    const auto is_due = [&](std::uint32_t period_ms) { return tick * tick_ms % period_ms < tick_ms; };
    const bool is_ours = !address.is_lost() && tick - claimed_tick > objection_ms / tick_ms;
    if (is_ours && is_due(sensor::estimated_flow_period_ms)) {
      for (const Auxiliary& one : auxiliaries) {
        send(sensor::estimated_flow_frame(flow_answer(answer_of(engine, one.valve)), one.at));
      }
    }
    for (Node& node : nodes) {
      if (is_due(fieldbus::heartbeat_ms)) send(node.device.heartbeat());
      if (node.device.state() != fieldbus::NmtState::operational || !is_due(settings.period_ms)) continue;
      send(sensor::process_data_frame(flow_answer(answer_of(engine, node.valve)), node.device.node()));
    }
  }
  void look_after(std::uint32_t tick) {
    bool is_back = false;
    std::string trouble = address.is_lost() ? fmt::format(
                                                  "J1939 address {} belongs to another device; name another as "
                                                  "source_address in [can]",
                                                  settings.source_address)
                                            : "";
    for (const auto& port : ports) {
      is_back = port->look_after() || is_back;
      if (!port->trouble().empty()) trouble = port->trouble();
    }
    if (is_back) claim(tick);
    output->set_trouble(trouble);
  }
  void run(const std::stop_token& stop) {
    constexpr std::uint32_t ticks_a_second = 1000 / tick_ms;
    parallel::SteadyTime next = std::chrono::steady_clock::now();
    claim(0);
    for (std::uint32_t tick = 0;; ++tick) {
      hear();
      send_due(tick);
      if (tick % ticks_a_second == 0) look_after(tick);
      next = std::max(next + std::chrono::milliseconds(tick_ms), std::chrono::steady_clock::now());
      if (!parallel::wait_until(next, stop)) return;
    }
  }
};

CanSender::CanSender(Engine& engine, const CanSettings& settings) : parts_(std::make_unique<Parts>(engine, settings)) {
  parts_->thread = std::jthread([parts = parts_.get()](const std::stop_token& stop) { parts->run(stop); });
}

CanSender::~CanSender() = default;

}  // namespace spoolflow::live
