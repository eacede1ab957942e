#include "addons/fleet/transport/nats_login.hpp"

#include <array>

namespace spoolflow::fleet {
namespace {

/// Several connection attempts fit a broken server's absence; a server that stands takes no bytes.
constexpr std::int64_t reconnect_wait_ms = 250, ping_interval_ms = 2000, write_wait_ms = 3000;
constexpr int pings_out = 2;

/// What another try does not help: who we are, and whether both sides speak TLS and trust each other.
bool is_refusal(natsStatus status) {
  return status == NATS_CONNECTION_AUTH_FAILED || status == NATS_NOT_PERMITTED || status == NATS_SSL_ERROR ||
         status == NATS_SECURE_CONNECTION_WANTED || status == NATS_SECURE_CONNECTION_REQUIRED;
}

/// Asks one server after the other until one lets us in; the connection itself would go on trying in silence.
/// Throws LoginError where one refuses us; servers that are away, or do not answer in time, are passed over. Returns
/// whether one let us in.
bool let_in(const NatsAccess& access, const std::string& name, std::int64_t answer_within_ms) {
  for (const std::string& server : access.servers) {
    NatsAccess one = access;
    one.servers = {server};
    const Handle<natsOptions> options = options_of(one, name);
    check(natsOptions_SetRetryOnFailedConnect(options.get(), false, nullptr, nullptr), "options");
    check(natsOptions_SetAllowReconnect(options.get(), false), "options");
    check(natsOptions_SetTimeout(options.get(), answer_within_ms), "options");
    natsConnection* made = nullptr;
    const natsStatus status = natsConnection_Connect(&made, options.get());
    const Handle<natsConnection> connection(made);
    if (status == NATS_OK) return true;
    if (!is_refusal(status)) continue;
    const char* const last = nats_GetLastError(nullptr);
    throw LoginError("NATS: " + server + " refuses this user or its TLS: " + natsStatus_GetText(status) +
                     (last != nullptr && *last != 0 ? std::string(" (") + last + ")" : "") +
                     "; check user, password_file or credentials, and authority");
  }
  return false;
}

}  // namespace

Handle<natsOptions> options_of(const NatsAccess& access, const std::string& name) {
  natsOptions* made = nullptr;
  check(natsOptions_Create(&made), "options");
  Handle<natsOptions> options(made);
  std::vector<const char*> servers;
  for (const std::string& server : access.servers) servers.push_back(server.c_str());
  check(natsOptions_SetServers(made, servers.data(), static_cast<int>(servers.size())), "servers");
  check(natsOptions_SetName(made, name.c_str()), "name");
  check(natsOptions_SetMaxReconnect(made, -1), "reconnects");
  check(natsOptions_SetReconnectWait(made, reconnect_wait_ms), "reconnects");
  check(natsOptions_SetRetryOnFailedConnect(
            made, true, [](natsConnection*, void*) {}, nullptr),
        "reconnects");
  // Only the servers that were named: others that those name may be out of reach from here.
  check(natsOptions_SetIgnoreDiscoveredServers(made, true), "servers");
  check(natsOptions_SetPingInterval(made, ping_interval_ms), "pings");
  check(natsOptions_SetMaxPingsOut(made, pings_out), "pings");
  check(natsOptions_SetWriteDeadline(made, write_wait_ms), "writes");
  const auto login = [](natsStatus status, const std::string& what, const std::string& remedy) {
    if (status == NATS_OK) return;
    throw LoginError("NATS: " + what + " (" + natsStatus_GetText(status) + "); " + remedy);
  };
  if (!access.credentials.empty()) {
    login(natsOptions_SetUserCredentialsFromFiles(made, access.credentials.c_str(), nullptr),
          "the credentials " + access.credentials + " cannot be used", "check the file and its rights");
  }
  if (!access.user.empty()) {
    login(natsOptions_SetUserInfo(made, access.user.c_str(), access.password.c_str()), "the user cannot be used",
          "check user and password_file");
  }
  if (!access.authority.empty()) {
    login(natsOptions_SetSecure(made, true), "TLS cannot be used", "check libnats");
    login(natsOptions_LoadCATrustedCertificates(made, access.authority.c_str()),
          "the certificates " + access.authority + " cannot be read", "name a PEM file as authority");
  }
  // What comes before there is an answer is refused by the servers later: the connection goes on trying.
  return options;
}

/// A busy server needs longer for TLS and a password than one that is away is worth.
void check_login(const NatsAccess& access, const std::string& name) {
  constexpr std::array<std::int64_t, 2> patience_ms{1000, 5000};
  for (const std::int64_t one : patience_ms) {
    if (let_in(access, name, one)) return;
  }
}

}  // namespace spoolflow::fleet
