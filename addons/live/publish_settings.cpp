#include "addons/live/publish_settings.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "addons/live/sources/socket.hpp"
#include "spoolflow/recording/toml_input.hpp"

namespace spoolflow::live {

NatsLogin read_nats_login(const recording::TomlTable& table) {
  const auto file = [&](const char* key) {
    const auto name = table.optional_text(key);
    return name ? table.file.parent_path() / *name : std::filesystem::path();
  };
  NatsLogin out{.credentials = file("credentials"),
                .user = table.optional_text("user").value_or(""),
                .password_file = file("password_file"),
                .authority = file("authority")};
  if (out.user.empty() != out.password_file.empty()) {
    throw SiteError(fmt::format("{}: user and password_file go together; name the other, too",
                                table.place(out.user.empty() ? "password_file" : "user")));
  }
  if (!out.user.empty() && !out.credentials.empty()) {
    throw SiteError(fmt::format("{}: credentials and user are two ways to log in; leave one out", table.place("user")));
  }
  return out;
}

std::vector<std::string> read_servers(const std::string& text, const std::string& where) {
  std::vector<std::string> out;
  std::string scheme = "nats://";
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    std::string server = text.substr(at, end - at);
    at = end + 1;
    const std::size_t mark = server.find("://");
    if (mark != std::string::npos) {
      scheme = server.substr(0, mark + 3);
      server = server.substr(mark + 3);
    }
    const bool plain = std::all_of(server.begin(), server.end(), [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == ':' || c == '-' || c == '[' ||
             c == ']';
    });
    if (server.empty() || !plain || (scheme != "nats://" && scheme != "tls://")) {
      throw SiteError(
          fmt::format("{}: '{}' names no NATS servers; write nats://HOST:PORT or tls://HOST:PORT, several with commas",
                      where, text));
    }
    out.push_back(scheme + server);
  }
  return out;
}

void check_site_name(const std::string& name, const std::string& where) {
  constexpr std::size_t longest = 32;
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  });
  if (plain && !name.empty() && name.size() <= longest) return;
  throw SiteError(fmt::format("{}: the site '{}' must be 1 to {} letters, digits, '_' and '-'", where, name, longest));
}

PublishSettings read_publish(const recording::TomlTable& fleet) {
  fleet.allow_only(
      {"site", "servers", "credentials", "user", "password_file", "authority", "block_s", "largest_MB", "sends"});
  PublishSettings out{.site = fleet.text("site"), .login = read_nats_login(fleet)};
  check_site_name(out.site, fleet.place("site"));
  if (const auto servers = fleet.optional_text("servers")) out.servers = read_servers(*servers, fleet.place("servers"));
  const std::string sends = fleet.optional_text("sends").value_or("samples");
  if (sends != "samples" && sends != "summaries") {
    throw SiteError(fmt::format("{}: sends is \"samples\" or \"summaries\", not \"{}\"", fleet.place("sends"), sends));
  }
  out.summaries_only = sends == "summaries";
  out.block_s = fleet.optional_positive("block_s").value_or(out.block_s);
  if (out.block_s < 0.1 || out.block_s > 1) {
    throw SiteError(fmt::format("{}: block_s is {}; allowed: 0.1 to 1 s", fleet.place("block_s"), out.block_s));
  }
  out.largest_MB = fleet.optional_positive("largest_MB").value_or(out.largest_MB);
  return out;
}

}  // namespace spoolflow::live
