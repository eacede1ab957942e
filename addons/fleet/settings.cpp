#include "addons/fleet/settings.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "addons/live/sources/socket.hpp"
#include "spoolflow/recording/toml_input.hpp"

namespace spoolflow::fleet {
namespace {

using recording::TomlTable;

double within(const TomlTable& table, const char* key, double otherwise, double least, double most) {
  const double value = table.optional_number(key).value_or(otherwise);
  if (value >= least && value <= most) return value;
  throw live::SiteError(
      fmt::format("{}: '{}' in {} is {}; allowed: {} to {}", table.place(key), key, table.name, value, least, most));
}

void read_nats(const TomlTable& nats, FleetSettings& out) {
  nats.allow_only({"servers", "credentials", "user", "password_file", "authority", "stream", "replicas", "largest_MB",
                   "keep_hours"});
  out.servers = live::read_servers(nats.text("servers"), nats.place("servers"));
  out.login = live::read_nats_login(nats);
  out.stream.name = nats.optional_text("stream").value_or(out.stream.name);
  live::check_site_name(out.stream.name, nats.place("stream"));
  out.stream.replicas = static_cast<std::int64_t>(within(nats, "replicas", 1, 1, 5));
  out.stream.largest_MB = within(nats, "largest_MB", out.stream.largest_MB, 1, 1e9);
  out.stream.hours = within(nats, "keep_hours", out.stream.hours, 0.01, 1e5);
}

void read_worker(const TomlTable& worker, WorkerSettings& out) {
  worker.allow_only({"name", "lease_s", "commit_s"});
  if (const auto name = worker.optional_text("name")) {
    live::check_site_name(*name, worker.place("name"));
    out.name = *name;
  }
  out.lease_s = within(worker, "lease_s", out.lease_s, 2, 60);
  out.commit_s = within(worker, "commit_s", out.commit_s, 0.05, 10);
}

void read_jobs(const TomlTable& jobs, JobSettings& out) {
  jobs.allow_only({"processes", "keep_hours", "largest_MB"});
  out.processes = static_cast<unsigned>(within(jobs, "processes", out.processes, 0, 1024));
  out.keep_hours = within(jobs, "keep_hours", out.keep_hours, 1, 1e5);
  out.largest_MB = within(jobs, "largest_MB", out.largest_MB, 1, 2000);
}

void read_sites(const TomlTable& top, FleetSettings& out) {
  if (!top.table.contains("sites")) return;
  auto names = top.list_of_texts("sites");
  if (!names) {
    throw live::SiteError(fmt::format("{}: sites must be a list of names, such as [\"hall_3\"]", top.place("sites")));
  }
  for (const std::string& name : *names) live::check_site_name(name, top.place("sites"));
  out.sites = std::move(*names);
}

}  // namespace

FleetSettings read_fleet(const std::filesystem::path& file) {
  const toml::table document = recording::read_toml(file);
  const TomlTable top{document, file, "the file"};
  top.allow_only({"sites", "nats", "postgresql", "worker", "jobs", "alarms", "page"});
  const auto part = [&](const char* key, bool needed) -> std::optional<TomlTable> {
    const toml::node* node = top.table.get(key);
    if (node == nullptr && !needed) return std::nullopt;
    if (node == nullptr) {
      throw live::SiteError(fmt::format("{}: has no [{}]; docs/fleet.md shows what it needs", file.string(), key));
    }
    if (!node->is_table()) throw live::SiteError(fmt::format("{}: {} must be a table", top.place(key), key));
    return TomlTable{*node->as_table(), file, fmt::format("[{}]", key)};
  };
  FleetSettings out;
  read_sites(top, out);
  read_nats(*part("nats", true), out);
  const auto postgresql = part("postgresql", true);
  postgresql->allow_only({"connection"});
  out.connection = postgresql->text("connection");
  if (const auto worker = part("worker", false)) read_worker(*worker, out.worker);
  out.jobs.processes = std::max(1U, std::thread::hardware_concurrency());
  if (const auto jobs = part("jobs", false)) read_jobs(*jobs, out.jobs);
  if (const auto page = part("page", false)) out.page = live::read_page(*page);
  if (const auto alarms = part("alarms", false)) {
    alarms->allow_only({"raised_after_s", "gone_after_s"});
    out.raised_after_s = within(*alarms, "raised_after_s", out.raised_after_s, 0, 1e6);
    out.gone_after_s = within(*alarms, "gone_after_s", out.gone_after_s, 0, 1e6);
  }
  return out;
}

NatsAccess access_of(const std::vector<std::string>& servers, const live::NatsLogin& login) {
  for (const std::filesystem::path& file : {login.credentials, login.authority}) {
    if (!file.empty() && !std::ifstream(file)) {
      throw LoginError(fmt::format("{}: cannot be read; check the name and the permissions", file.string()));
    }
  }
  NatsAccess out{servers, login.credentials.string(), login.user, {}, login.authority.string()};
  if (login.password_file.empty()) return out;
  std::ifstream in(login.password_file);
  if (!std::getline(in, out.password) || out.password.empty()) {
    throw LoginError(
        fmt::format("{}: holds no password in its first line, or cannot be read", login.password_file.string()));
  }
  return out;
}

}  // namespace spoolflow::fleet
