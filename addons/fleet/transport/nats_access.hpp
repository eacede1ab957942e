#pragma once
/// Where NATS servers are and who we are to them, and what may go wrong with them.
#include <stdexcept>
#include <string>
#include <vector>

namespace spoolflow::fleet {

/// What the servers refuse, or that none can be reached at present: worth another try.
struct TransportError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// What no other try will help: exit status 2 where it is met at the start.
struct LoginError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

struct NatsAccess {
  std::vector<std::string> servers;  ///< "nats://HOST:PORT" or "tls://HOST:PORT"
  std::string credentials{};         ///< file; empty: none
  std::string user{}, password{};    ///< empty: none
  std::string authority{};           ///< PEM file of who signed the servers' certificates; empty: no TLS
};

}  // namespace spoolflow::fleet
