#pragma once
/// [[notify]] of a site's file: who gets a message when alarms are raised. Format: docs/live.md.
#include <filesystem>
#include <string>
#include <vector>

#include "addons/live/sources/socket.hpp"
#include "spoolflow/monitor/condition.hpp"

namespace spoolflow::recording {
struct TomlTable;
}

namespace spoolflow::live {

/// One of them: a webhook, or mail through a server.
struct NotifySettings {
  std::string name{};  ///< for people: "webhook at hooks.example.org", "mail through smtp.example.org"; holds no secret
  std::string url{};   ///< http, https, smtp or smtps; that of a webhook may be a secret
  std::string token{};                ///< of a webhook: Authorization: Bearer; empty: none
  std::string from{};                 ///< of mail
  std::vector<std::string> to{};      ///< of mail; empty: it is a webhook
  std::string user{}, password{};     ///< of the mail server; empty: none
  bool encrypted = true;              ///< false: without TLS
  std::filesystem::path authority{};  ///< PEM of who signed the server's certificate; empty: the system's
  monitor::Ne107 least = monitor::Ne107::maintenance_required;  ///< alarms of less are left out
  double gather_s = 10;                                         ///< from the first alarm of a burst to its message
  double retry_s = 10;  ///< from the first failure to the next try; then twice as long each

  [[nodiscard]] bool is_mail() const { return !to.empty(); }
};

/// Reads secrets from their files and variables, too. Throws SiteError or RecordingError with file, line and remedy,
/// and without any secret.
[[nodiscard]] NotifySettings read_notify(const recording::TomlTable& notify);

}  // namespace spoolflow::live
