#pragma once
/// [fleet] of a site's file: under which name its valves are known to the fleet, and how it gets their samples.
/// Format: docs/fleet.md.
#include <filesystem>
#include <string>
#include <vector>

namespace spoolflow::recording {
struct TomlTable;
}

namespace spoolflow::live {

/// Who a program is to the NATS servers, and how it knows them.
struct NatsLogin {
  std::filesystem::path credentials{};    ///< a .creds file; empty: none
  std::string user{};                     ///< empty: none
  std::filesystem::path password_file{};  ///< whose first line is the user's password
  std::filesystem::path authority{};      ///< PEM of who signed the servers' certificates; empty: no TLS
};
/// The keys of it in a table.
[[nodiscard]] NatsLogin read_nats_login(const recording::TomlTable& table);
/// "nats://a:4222,b:4222" as "nats://a:4222", "nats://b:4222". Throws SiteError, naming `where`, where it is none.
[[nodiscard]] std::vector<std::string> read_servers(const std::string& text, const std::string& where);

struct PublishSettings {
  std::string site{};                  ///< up to 32 letters, digits, '_' and '-'
  std::vector<std::string> servers{};  ///< "nats://HOST:PORT" or "tls://HOST:PORT"; empty: nothing is published
  NatsLogin login{};
  bool summaries_only = false;  ///< what the site makes of its samples each second, instead of these
  double block_s = 1.0;         ///< of samples in a block, 0.1 to 1
  double largest_MB = 10000;    ///< of blocks that wait; the oldest beyond are given up
};
/// Throws SiteError or RecordingError with file, line and remedy.
[[nodiscard]] PublishSettings read_publish(const recording::TomlTable& fleet);
/// Throws SiteError where a site's name is missing or none.
void check_site_name(const std::string& name, const std::string& where);

}  // namespace spoolflow::live
