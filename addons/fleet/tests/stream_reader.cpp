/// stream_reader SERVER MESSAGES: fills a stream with so many messages and reads them as workers do, again from where
/// it was whenever the reader is given up; every one must come once and in its order.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <thread>

#include "addons/fleet/transport/nats.hpp"

namespace {

using namespace spoolflow::fleet;
constexpr int fetched = 64;
constexpr std::chrono::milliseconds patience{100};

void fill(Connection& nats, const StreamSettings& settings, std::uint64_t messages) {
  (void)nats.make_stream(settings);
  for (std::uint64_t k = 1; k <= messages;) {
    if (nats.publish("spoolflow.block.1.hall", std::to_string(k))) ++k;
  }
  while (nats.stream(settings.name).value().last < messages) std::this_thread::sleep_for(patience);
  std::puts("filled");
  std::fflush(stdout);
}

/// Returns how many readers it took. Throws where one message is not the next.
int read(Connection& nats, const StreamSettings& settings, std::uint64_t messages) {
  std::optional<Puller> puller;
  int readers = 0;
  for (std::uint64_t last = 0; last < messages;) {
    try {
      if (!puller) {
        puller.emplace(nats.pull(settings.name, "spoolflow.block.1.>", last + 1, 0));
        ++readers;
      }
      for (const Message& message : puller->fetch(fetched, patience)) {
        if (message.sequence != ++last || message.bytes != std::to_string(last)) {
          throw std::logic_error("message " + message.bytes + " came where " + std::to_string(last) + " was next");
        }
      }
    } catch (const TransportError&) {
      puller.reset();
    }
  }
  return readers;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    Connection nats({.servers = {argv[1]}}, "reader");
    while (!nats.connected()) std::this_thread::sleep_for(patience);
    const StreamSettings settings;
    const std::uint64_t messages = std::strtoull(argv[2], nullptr, 10);
    fill(nats, settings, messages);
    std::printf("read by %d readers\n", read(nats, settings, messages));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
