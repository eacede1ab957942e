#include "addons/live/fieldbus/modbus_server.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <modbus/modbus.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <thread>
#include <vector>

#include "addons/live/fieldbus/plant_answers.hpp"
#include "addons/live/protocols/modbus_map.hpp"

namespace spoolflow::live {
namespace {

constexpr std::size_t most_clients = 32;

struct Freed {
  void operator()(modbus_t* context) const { modbus_free(context); }
  void operator()(modbus_mapping_t* mapping) const { modbus_mapping_free(mapping); }
};
using Context = std::unique_ptr<modbus_t, Freed>;

std::string address_of(const sockaddr_storage& from) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const void* at = from.ss_family == AF_INET6
                       ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in6&>(from).sin6_addr)
                       : &reinterpret_cast<const sockaddr_in&>(from).sin_addr;
  return ::inet_ntop(from.ss_family, at, text.data(), text.size()) == nullptr ? "" : text.data();
}

}  // namespace

bool has_modbus() {
  return true;
}

struct ModbusServer::Parts {
  Engine& engine;
  ModbusSettings settings;
  BoundSocket listener;
  std::shared_ptr<Output> output;
  std::vector<Descriptor> clients{};
  std::unique_ptr<modbus_mapping_t, Freed> mapping{};
  Context context{modbus_new_tcp(nullptr, 502)};
  std::jthread thread{};

  Parts(Engine& of, const ModbusSettings& with)
      : engine(of),
        settings(with),
        listener(bind_socket(with.listen, Transport::tcp)),
        output(of.outputs().add("modbus")) {
    const std::size_t count = std::min(engine.size(), fieldbus::modbus_most_valves);
    const int size = static_cast<int>(fieldbus::modbus_head + count * fieldbus::modbus_per_valve);
    mapping.reset(modbus_mapping_new(0, 0, size, size));
    if (!context || !mapping) throw SiteError("[modbus]: no memory for the registers");
    // A request that began comes whole at once, or its sender is let go: others wait meanwhile.
    modbus_set_indication_timeout(context.get(), 0, 200000);
    modbus_set_byte_timeout(context.get(), 0, 100000);
  }

  void renew() const {
    std::vector<fieldbus::PlantAnswer> answers;
    for (std::size_t k = 0; k < std::min(engine.size(), fieldbus::modbus_most_valves); ++k) {
      answers.push_back(answer_of(engine, k));
    }
    const std::vector<std::uint16_t> registers = fieldbus::modbus_registers(answers);
    std::copy(registers.begin(), registers.end(), mapping->tab_registers);
    std::copy(registers.begin(), registers.end(), mapping->tab_input_registers);
  }
  void accept_one() {
    sockaddr_storage from{};
    socklen_t size = sizeof from;
    Descriptor client(::accept4(listener.descriptor.number(), reinterpret_cast<sockaddr*>(&from), &size, SOCK_CLOEXEC));
    if (client.number() < 0) return;
    const bool may = settings.listen.is_loopback() ||
                     std::find(settings.allow.begin(), settings.allow.end(), address_of(from)) != settings.allow.end();
    if (!may || clients.size() >= most_clients) {
      ++output->dropped;
      return;
    }
    // Who asks and does not take the answers is let go.
    const timeval patience{0, 200000};
    (void)::setsockopt(client.number(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    clients.push_back(std::move(client));
  }
  /// False: the client is gone.
  [[nodiscard]] bool answer(const Descriptor& client) const {
    constexpr std::size_t unit_at = 6, function_at = 7;
    constexpr std::uint8_t read_holding = 3, read_input = 4;
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> request{};
    (void)modbus_set_socket(context.get(), client.number());
    const int size = modbus_receive(context.get(), request.data());
    if (size <= 0) return size == 0;
    ++output->received;
    const unsigned unit = request[unit_at];
    int sent = 0;
    if (unit != settings.unit && unit != 0 && unit != 255) {
      sent = modbus_reply_exception(context.get(), request.data(), MODBUS_EXCEPTION_GATEWAY_TARGET);
    } else if (request[function_at] != read_holding && request[function_at] != read_input) {
      sent = modbus_reply_exception(context.get(), request.data(), MODBUS_EXCEPTION_ILLEGAL_FUNCTION);
    } else {
      renew();
      sent = modbus_reply(context.get(), request.data(), size, mapping.get());
    }
    if (sent > 0) ++output->sent;
    return sent >= 0;
  }
  void run(const std::stop_token& stop) {
    constexpr int look_for_stop_ms = 100;
    std::vector<pollfd> waiting;
    while (!stop.stop_requested()) {
      waiting.assign(1, {listener.descriptor.number(), POLLIN, 0});
      for (const Descriptor& client : clients) waiting.push_back({client.number(), POLLIN, 0});
      if (::poll(waiting.data(), waiting.size(), look_for_stop_ms) <= 0) continue;
      for (std::size_t k = waiting.size() - 1; k > 0; --k) {
        if (waiting[k].revents == 0 || answer(clients[k - 1])) continue;
        clients.erase(clients.begin() + static_cast<std::ptrdiff_t>(k) - 1);
      }
      if (waiting[0].revents != 0) accept_one();
      output->connected = clients.size();
    }
  }
};

ModbusServer::ModbusServer(Engine& engine, const ModbusSettings& settings)
    : parts_(std::make_unique<Parts>(engine, settings)) {
  parts_->thread = std::jthread([parts = parts_.get()](const std::stop_token& stop) { parts->run(stop); });
}

ModbusServer::~ModbusServer() = default;

std::uint16_t ModbusServer::port() const {
  return parts_->listener.port;
}

}  // namespace spoolflow::live
