#include "addons/fleet/server_configuration.hpp"

#include <fmt/format.h>

#include "addons/fleet/subjects.hpp"

namespace spoolflow::fleet {
namespace {

std::string site_user(const std::string& site) {
  return fmt::format(
      "      {{ user: \"{0}\", password: $PASSWORD_{0}, permissions: {{\n"
      "          publish: [\"{1}\", \"{2}\"], subscribe: [\"{3}\", \"{4}\"] }} }}\n",
      site, fmt::format("spoolflow.block.*.{}", site), model_subject(site), coverage_subject(site), ask_subject(site));
}

}  // namespace

std::string nats_configuration(const FleetSettings& settings) {
  std::string users;
  for (const std::string& site : settings.sites) users += site_user(site);
  // Users stand in accounts alone, and the system's account has a user of its own: with `authorization` beside accounts
  // of which only $SYS is defined nats-server 2.9.10 lets anybody in (CVE-2023-47090).
  return fmt::format(
      R"(# nats-server.conf of each server; passwords come from the environment ($PASSWORD_...), hashes by `nats server passwd`
server_name: fleet_1                    # another on each
listen: 0.0.0.0:4222
jetstream {{ store_dir: /var/lib/nats, max_file_store: {0}M, sync_interval: "10s" }}
max_payload: 1MB
tls {{ cert_file: /etc/nats/server.pem, key_file: /etc/nats/server.key, ca_file: /etc/nats/authority.pem }}
cluster {{
  name: fleet, listen: 0.0.0.0:6222
  routes: [nats://fleet_1:6222, nats://fleet_2:6222, nats://fleet_3:6222]
  tls {{ cert_file: /etc/nats/server.pem, key_file: /etc/nats/server.key, ca_file: /etc/nats/authority.pem, verify: true }}
}}
accounts {{
  SPOOLFLOW {{
    jetstream: enabled
    users: [
      {{ user: "worker", password: $PASSWORD_worker, permissions: {{
          publish: ["spoolflow.coverage.*", "spoolflow.ask.*", "$JS.API.STREAM.INFO.{1}", "$JS.API.STREAM.CREATE.{1}",
                    "$JS.API.STREAM.UPDATE.{1}", "$JS.API.CONSUMER.CREATE.{1}", "$JS.API.CONSUMER.CREATE.{1}.>",
                    "$JS.API.CONSUMER.INFO.{1}.>", "$JS.API.CONSUMER.DELETE.{1}.>", "$JS.API.CONSUMER.MSG.NEXT.{1}.>"]
          subscribe: ["spoolflow.model.*", "_INBOX.>"] }} }}
{2}    ]
  }}
  SYS {{ users: [ {{ user: "system", password: $PASSWORD_system }} ] }}
}}
system_account: SYS
)",
      static_cast<std::int64_t>(2 * settings.stream.largest_MB), settings.stream.name, users);
}

std::string postgresql_configuration() {
  return R"(# postgresql.conf of both servers
listen_addresses = '*'
ssl = on
ssl_cert_file = '/etc/postgresql/server.pem'
ssl_key_file = '/etc/postgresql/server.key'
password_encryption = scram-sha-256
max_connections = 200                   # one for each partition, two for each worker, one for each of its [jobs] processes
wal_level = replica
max_wal_senders = 5
hot_standby = on
synchronous_commit = on                 # a commit waits for the standby's disk
synchronous_standby_names = 'ANY 1 (fleet_standby)'
# pg_hba.conf: nobody without TLS and password
hostssl fleet        +spoolflow_worker  all  scram-sha-256
hostssl fleet        +spoolflow_reader  all  scram-sha-256
hostssl fleet        +spoolflow_page    all  scram-sha-256
hostssl fleet        +spoolflow_batch   all  scram-sha-256
hostssl replication  replicator         all  scram-sha-256
# once, as the database's owner; a role for each worker and each reader:
#   CREATE ROLE worker_1 LOGIN PASSWORD '...' IN ROLE spoolflow_worker;
#   CREATE ROLE page LOGIN PASSWORD '...' IN ROLE spoolflow_page;
#   CREATE ROLE engineer_1 LOGIN PASSWORD '...' IN ROLE spoolflow_batch;
#   CREATE ROLE dashboard LOGIN PASSWORD '...' IN ROLE spoolflow_reader;
)";
}

}  // namespace spoolflow::fleet
