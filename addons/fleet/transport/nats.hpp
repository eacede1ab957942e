#pragma once
/// What the fleet needs of NATS: a connection that comes back by itself, messages without promise, and a stream that is
/// read in its order from any place. Nothing here is taken as kept: what must not be lost stays with its sender until
/// the fleet's store has it.
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "addons/fleet/transport/nats_access.hpp"
#include "addons/fleet/transport/reader_watch.hpp"
#include "addons/fleet/transport/retired_subscriptions.hpp"

namespace spoolflow::fleet {

struct Message {
  std::string subject;
  std::string bytes;
  std::uint64_t sequence = 0;  ///< in its stream; 0 where it came by none
};

/// The stream that carries blocks: what it holds and for how long is a matter of comfort, not of safety.
struct StreamSettings {
  std::string name = "spoolflow";
  std::int64_t replicas = 1;
  double largest_MB = 4000;
  double hours = 24;
};
struct StreamPlace {
  std::int64_t created_ns = 0;  ///< since 1970-01-01 UTC; another stream of the same name has another
  std::uint64_t first = 0, last = 0;
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;
};

class Subscription;
class Puller;

/// Safe to be used from any thread. The library tries again and again where servers are away, but closes a connection
/// for good where a server complains of what it was sent, as behind a write that came to its end half-way: then another
/// is made in its place at the next use.
class Connection {
 public:
  /// Connects when a server can be reached; each is asked for a second at most, and once more for five
  /// where none let us in. Throws LoginError where a file of `access` cannot be read, or a server refuses user,
  /// password or TLS. `name`: for the servers' own lists.
  Connection(const NatsAccess& access, const std::string& name);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  [[nodiscard]] bool connected() const;
  /// False where it could not be handed over; that it was says nothing.
  bool publish(const std::string& subject, std::span<const std::uint8_t> bytes);
  bool publish(const std::string& subject, const std::string& text);
  /// Does not outlive the connection. Throws TransportError.
  [[nodiscard]] Subscription subscribe(const std::string& subject);

  /// Makes the stream of all blocks where there is none, and gives it these settings. Throws TransportError.
  StreamPlace make_stream(const StreamSettings& settings);
  /// Nothing where there is none. Throws TransportError where no server answers.
  [[nodiscard]] std::optional<StreamPlace> stream(const std::string& name);
  /// What the stream holds under `subject` from that sequence number on. `silent_before`: as of ReaderWatch. Throws
  /// TransportError.
  [[nodiscard]] Puller pull(const std::string& stream, const std::string& subject, std::uint64_t from,
                            int silent_before);

 private:
  friend class Subscription;
  friend class Puller;
  struct Handles;
  static std::shared_ptr<Handles> made(const NatsAccess& access, const std::string& name);
  [[nodiscard]] std::shared_ptr<Handles> handles() const;
  [[nodiscard]] std::shared_ptr<Handles> open_handles();

  NatsAccess access_;
  std::string name_;
  mutable std::mutex mutex_;  ///< of the others
  std::shared_ptr<Handles> handles_;
  std::chrono::steady_clock::time_point made_{};
};

/// Messages of a subject as they come, by whichever connection there is.
class Subscription {
 public:
  /// Nothing where none came within that time, or the connection is away.
  std::optional<Message> next(std::chrono::milliseconds patience);

 private:
  friend class Connection;
  friend class Puller;
  Subscription(Connection& connection, std::string subject, std::shared_ptr<Connection::Handles> of);
  struct Retire {
    std::shared_ptr<RetiredSubscriptions> to;
    void operator()(__natsSubscription* handle) const { to->add(handle); }
  };
  Connection* connection_;
  std::string subject_;
  std::unique_ptr<__natsSubscription, Retire> handle_;
  std::shared_ptr<Connection::Handles> of_;
};

/// Reads a stream by asking for messages, a bounded number at a time. By requests of our own: the library's fetching
/// (libnats 3.4.1, natsSubscription_Fetch) writes behind its list of messages where answers to an older request come
/// with those to a newer one.
class Puller {
 public:
  /// Up to `most` messages; empty where none came within that time. Throws TransportError where the reader is gone, or
  /// silent for long: make another.
  std::vector<Message> fetch(int most, std::chrono::milliseconds patience);
  /// Whether a message came by it.
  [[nodiscard]] bool has_spoken() const { return watch_.has_spoken(); }

 private:
  friend class Connection;
  using Time = ReaderWatch::Time;
  struct Place {
    std::string stream, consumer, inbox;
  };
  Puller(std::shared_ptr<Connection::Handles> handles, Place place, Subscription subscription, int silent_before);
  void ask(int most, Time now);
  void look_whether_it_is_there(Time now);

  std::shared_ptr<Connection::Handles> handles_;
  Place place_;
  Subscription subscription_;
  ReaderWatch watch_;
  int owed_ = 0;       ///< messages of the last request that have not come
  Time owed_until_{};  ///< when the server has forgotten it
};

}  // namespace spoolflow::fleet
