#include "addons/live/notify_settings.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/recording/toml_input.hpp"

namespace spoolflow::live {
namespace {

using monitor::Ne107;
using recording::TomlTable;

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 0x7f; });
}

/// The first line of KEY_file, or the variable KEY_environment, of which there is one at most.
std::optional<std::string> secret(const TomlTable& notify, const std::string& key) {
  const auto file = notify.optional_text(key + "_file"), variable = notify.optional_text(key + "_environment");
  if (file && variable) {
    throw SiteError(fmt::format("{0}: {1}_file and {1}_environment are two ways to the same secret; leave one out",
                                notify.place(key + "_file"), key));
  }
  if (!file && !variable) return std::nullopt;
  std::string out;
  if (file) {
    std::ifstream in(notify.file.parent_path() / *file);
    std::getline(in, out);
    if (out.ends_with('\r')) out.pop_back();
  } else if (const char* const value = std::getenv(variable->c_str())) {
    out = value;
  }
  if (!out.empty() && is_printable(out)) return out;
  throw SiteError(file ? fmt::format("{}: the first line of {} must hold the secret, without spaces; it cannot be "
                                     "read, is empty or holds others",
                                     notify.place(key + "_file"), (notify.file.parent_path() / *file).string())
                       : fmt::format("{}: the environment variable {} must hold the secret, without spaces; it is "
                                     "not set, is empty or holds others",
                                     notify.place(key + "_environment"), *variable));
}

struct Url {
  std::string scheme, host;
};

/// Nothing where it is none, or holds a user.
std::optional<Url> url_parts(const std::string& url) {
  const std::size_t mark = url.find("://");
  if (mark == std::string::npos || !is_printable(url)) return std::nullopt;
  const std::size_t begin = mark + 3, end = std::min(url.find_first_of("/?#", begin), url.size());
  std::string host = url.substr(begin, end - begin);
  const std::size_t colon = host.rfind(':');
  if (colon != std::string::npos && host.find(']', colon) == std::string::npos) {
    const std::string port = host.substr(colon + 1);
    const bool digits = std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (port.empty() || port.size() > 5 || !digits || std::stoi(port) > 65535) return std::nullopt;
    host.resize(colon);
  }
  const bool plain = std::all_of(host.begin(), host.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_' || c == ':' ||
           c == '[' || c == ']';
  });
  return host.empty() || !plain ? std::nullopt : std::optional(Url{url.substr(0, mark), host});
}

bool is_loopback(const std::string& host) {
  return host == "localhost" || Address{host, 0}.is_loopback();
}

/// "anna@example.org": nothing that could begin another header or command.
std::string mail_address(const TomlTable& notify, const char* key, const std::string& text) {
  const std::size_t at = text.find('@');
  const bool plain = is_printable(text) && text.size() <= 254 && text.find_first_of("<>,;:\"()\\") == std::string::npos;
  if (plain && at != std::string::npos && at > 0 && at + 1 < text.size() && text.find('@', at + 1) == std::string::npos)
    return text;
  throw SiteError(fmt::format("{}: '{}' is no mail address such as maintenance@example.org", notify.place(key), text));
}

std::vector<std::string> recipients(const TomlTable& notify) {
  auto out = notify.list_of_texts("to");
  if (!out || out->empty()) {
    throw SiteError(fmt::format("{}: mail needs its recipients as to = [\"maintenance@example.org\"]",
                                notify.place(notify.table.contains("to") ? "to" : "mail")));
  }
  for (std::string& text : *out) text = mail_address(notify, "to", text);
  return std::move(*out);
}

Ne107 read_least(const TomlTable& notify) {
  const std::string text = notify.optional_text("least_priority").value_or("M");
  for (const Ne107 sign :
       {Ne107::maintenance_required, Ne107::out_of_specification, Ne107::function_check, Ne107::failure}) {
    if (text == monitor::name(sign)) return sign;
  }
  throw SiteError(
      fmt::format("{}: least_priority is \"{}\"; allowed: \"M\", \"S\", \"C\" or \"F\" of NE 107, from the "
                  "least to the most urgent",
                  notify.place("least_priority"), text));
}

double seconds(const TomlTable& notify, const char* key, double otherwise) {
  constexpr double least = 0.1, most = 3600;
  const double value = notify.optional_number(key).value_or(otherwise);
  if (value >= least && value <= most) return value;
  throw SiteError(fmt::format("{}: {} is {}; allowed: {} to {} s", notify.place(key), key, value, least, most));
}

bool read_tls(const TomlTable& notify) {
  const toml::node* const node = notify.table.get("tls");
  if (node == nullptr) return true;
  if (const auto value = node->value_exact<bool>()) return *value;
  throw SiteError(fmt::format("{}: tls must be true or false", notify.place("tls")));
}

NotifySettings read_webhook(const TomlTable& notify) {
  notify.allow_only({"webhook", "webhook_file", "webhook_environment", "token_file", "token_environment", "authority",
                     "tls", "least_priority", "gather_s", "retry_s"});
  const auto plain = notify.optional_text("webhook"), hidden = secret(notify, "webhook");
  if (plain && hidden) {
    throw SiteError(fmt::format("{}: webhook stands here and in a secret; leave one out", notify.place("webhook")));
  }
  if (!plain && !hidden) {
    throw SiteError(
        fmt::format("{}: [[notify]] names no receiver; write webhook = \"https://HOST/PATH\", or mail = "
                    "\"smtp://HOST:587\" with from and to",
                    recording::place_of(notify.table, notify.file)));
  }
  NotifySettings out{.url = plain ? *plain : *hidden, .token = secret(notify, "token").value_or("")};
  const auto parts = url_parts(out.url);
  if (!parts || (parts->scheme != "https" && parts->scheme != "http")) {
    throw SiteError(
        fmt::format("{}: the webhook's address must be https://HOST/PATH, without user and password, which "
                    "go into token_file{}",
                    recording::place_of(notify.table, notify.file), plain ? "" : "; what the secret holds is none"));
  }
  out.name = "webhook at " + parts->host;
  out.encrypted = parts->scheme == "https";
  if (!out.encrypted && read_tls(notify) && !is_loopback(parts->host)) {
    throw SiteError(fmt::format("{}: the webhook at {} has no TLS; write https://, or tls = false to send unencrypted",
                                recording::place_of(notify.table, notify.file), parts->host));
  }
  if (!out.encrypted && !out.token.empty() && !is_loopback(parts->host)) {
    throw SiteError(fmt::format("{}: a token would go to {} unencrypted; write https://",
                                recording::place_of(notify.table, notify.file), parts->host));
  }
  return out;
}

NotifySettings read_mail(const TomlTable& notify) {
  notify.allow_only({"mail", "from", "to", "user", "password_file", "password_environment", "authority", "tls",
                     "least_priority", "gather_s", "retry_s"});
  NotifySettings out{.url = notify.text("mail"),
                     .from = mail_address(notify, "from", notify.text("from")),
                     .to = recipients(notify),
                     .user = notify.optional_text("user").value_or(""),
                     .password = secret(notify, "password").value_or("")};
  const auto parts = url_parts(out.url);
  if (!parts || (parts->scheme != "smtps" && parts->scheme != "smtp") ||
      out.url.find_first_of("/?#", parts->scheme.size() + 3) != std::string::npos) {
    throw SiteError(
        fmt::format("{}: mail is '{}'; write smtp://HOST:587 (STARTTLS) or smtps://HOST:465, and who logs "
                    "in as user and password_file",
                    notify.place("mail"), parts ? out.url : "no such address"));
  }
  out.name = "mail through " + parts->host;
  out.encrypted = parts->scheme == "smtps" || read_tls(notify);
  if (out.user.empty() != out.password.empty()) {
    throw SiteError(fmt::format("{}: user and password_file or password_environment go together; name the other, too",
                                recording::place_of(notify.table, notify.file)));
  }
  if (!out.password.empty() && !out.encrypted && !is_loopback(parts->host)) {
    throw SiteError(fmt::format("{}: a password would go to {} unencrypted; leave tls = false out", notify.place("tls"),
                                parts->host));
  }
  return out;
}

}  // namespace

NotifySettings read_notify(const TomlTable& notify) {
  NotifySettings out = notify.table.contains("mail") ? read_mail(notify) : read_webhook(notify);
  if (const auto authority = notify.optional_text("authority")) {
    out.authority = notify.file.parent_path() / *authority;
    if (!std::ifstream(out.authority)) {
      throw SiteError(
          fmt::format("{}: {} cannot be read; authority is the PEM file of who signed the server's "
                      "certificate",
                      notify.place("authority"), out.authority.string()));
    }
  }
  out.least = read_least(notify);
  out.gather_s = seconds(notify, "gather_s", out.gather_s);
  out.retry_s = seconds(notify, "retry_s", out.retry_s);
  return out;
}

}  // namespace spoolflow::live
