#pragma once
/// [page] of a site's file: where the page listens, its certificate, and who may come in. Format: docs/live.md.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "addons/live/sources/socket.hpp"

namespace spoolflow::recording {
struct TomlTable;
}

namespace spoolflow::live {

/// What somebody may do; each includes those before.
enum class Role : std::uint8_t { none, read, acknowledge };
/// "none", "read", "acknowledge".
[[nodiscard]] std::string_view name(Role role);

struct Account {
  std::string name;  ///< up to 32 letters, digits, '_' and '-'
  Role role = Role::read;
  std::string secret;  ///< of a password or token, as `spoolflow account` writes it
};

struct PageSettings {
  Address listen{"127.0.0.1", 8080};
  std::filesystem::path certificate{};  ///< PEM, with the certificates that it hangs on; empty: no TLS
  std::filesystem::path key{};          ///< PEM
  std::vector<std::string> names{};     ///< by which browsers may call the server, beside loopback ones
  std::vector<std::string> proxies{};   ///< addresses whose X-Forwarded-For says for whom they call
  std::vector<Account> accounts{};
  Role without_account = Role::acknowledge;  ///< of everybody, where there are no accounts
  double session_hours = 12;                 ///< after which a browser logs in again

  [[nodiscard]] bool has_tls() const { return !certificate.empty(); }
};

/// Throws SiteError or RecordingError with file, line and remedy.
[[nodiscard]] PageSettings read_page(const recording::TomlTable& page);

/// The table [page] of a site's or a fleet's file alone. Throws as read_page() does.
[[nodiscard]] PageSettings read_page_of(const std::filesystem::path& file);

/// Throws SiteError, which says what to do, where other machines reach the address and not both TLS and accounts are
/// there.
void check_reach(const PageSettings& page);

}  // namespace spoolflow::live
