#include "addons/live/page_settings.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "spoolflow/recording/toml_input.hpp"

namespace spoolflow::live {
namespace {

using recording::TomlTable;

constexpr std::size_t longest_account = 32;

Role read_role(const TomlTable& table, std::string_view key) {
  const std::string text = table.text(key);
  if (text == "read") return Role::read;
  if (text == "acknowledge") return Role::acknowledge;
  throw SiteError(fmt::format("{}: {} is \"read\" or \"acknowledge\", not \"{}\"", table.place(key), key, text));
}

Account read_account(const TomlTable& table) {
  table.allow_only({"name", "role", "secret"});
  Account account{table.text("name"), read_role(table, "role"), table.text("secret")};
  const bool plain = std::all_of(account.name.begin(), account.name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  });
  if (!plain || account.name.empty() || account.name.size() > longest_account) {
    throw SiteError(fmt::format("{}: the name '{}' must be 1 to {} letters, digits, '_' and '-'", table.place("name"),
                                account.name, longest_account));
  }
  if (!account.secret.starts_with("$scrypt$")) {
    throw SiteError(
        fmt::format("{}: the secret of '{}' is no hash of a password or token; make one with `spoolflow "
                    "account {}`",
                    table.place("secret"), account.name, account.name));
  }
  return account;
}

std::vector<std::string> read_texts(const TomlTable& page, std::string_view key, const char* example) {
  if (!page.table.contains(key)) return {};
  if (auto out = page.list_of_texts(key)) return std::move(*out);
  throw SiteError(fmt::format("{}: {} must be a list of texts, such as [\"{}\"]", page.place(key), key, example));
}

}  // namespace

std::string_view name(Role role) {
  switch (role) {
    case Role::none:
      return "none";
    case Role::read:
      return "read";
    case Role::acknowledge:
      return "acknowledge";
  }
  return "none";
}

PageSettings read_page(const TomlTable& page) {
  page.allow_only({"listen", "certificate", "key", "names", "proxies", "account", "without_account", "session_hours"});
  PageSettings out;
  if (const auto listen = page.optional_text("listen")) out.listen = read_address(*listen, page.place("listen"));
  const auto file = [&](const char* key) {
    const auto name = page.optional_text(key);
    return name ? page.file.parent_path() / *name : std::filesystem::path();
  };
  out.certificate = file("certificate");
  out.key = file("key");
  if (out.certificate.empty() != out.key.empty()) {
    throw SiteError(fmt::format("{}: TLS needs both certificate and key; name the other PEM file, too",
                                page.place(out.key.empty() ? "certificate" : "key")));
  }
  out.names = read_texts(page, "names", "valves.example.org");
  for (const std::string& proxy : read_texts(page, "proxies", "127.0.0.1")) {
    out.proxies.push_back(read_host(proxy, page.place("proxies")));
  }
  if (page.table.contains("without_account")) out.without_account = read_role(page, "without_account");
  out.session_hours = page.optional_positive("session_hours").value_or(out.session_hours);
  const toml::node* accounts = page.table.get("account");
  if (accounts == nullptr) return out;
  if (!accounts->is_array_of_tables()) {
    throw SiteError(
        fmt::format("{}: accounts are tables [[page.account]] with name, role and secret", page.place("account")));
  }
  for (const toml::node& account : *accounts->as_array()) {
    out.accounts.push_back(read_account({*account.as_table(), page.file, "[[page.account]]"}));
    const auto same = std::count_if(out.accounts.begin(), out.accounts.end(),
                                    [&](const Account& one) { return one.name == out.accounts.back().name; });
    if (same > 1) {
      throw SiteError(fmt::format("{}: two accounts have the name '{}'; rename one", page.place("account"),
                                  out.accounts.back().name));
    }
  }
  return out;
}

PageSettings read_page_of(const std::filesystem::path& file) {
  const toml::table document = recording::read_toml(file);
  const toml::node* page = document.get("page");
  if (page == nullptr) return {};
  if (!page->is_table()) throw SiteError(fmt::format("{}: page must be a table", file.string()));
  return read_page({*page->as_table(), file, "[page]"});
}

void check_reach(const PageSettings& page) {
  if (page.listen.is_loopback()) return;
  if (page.has_tls() && !page.accounts.empty()) return;
  const char* const missing = page.has_tls()          ? "an account"
                              : page.accounts.empty() ? "a certificate and an account"
                                                      : "a certificate";
  throw SiteError(fmt::format(
      "the page at {} would be reached by other machines; that needs TLS and a token or password, and {} is "
      "missing: name certificate and key (PEM files) in [page] of the site's file, and add to it what "
      "`spoolflow account NAME` prints; or listen at 127.0.0.1 and come by `ssh -L "
      "8080:127.0.0.1:8080 machine`",
      page.listen.text(), missing));
}

}  // namespace spoolflow::live
