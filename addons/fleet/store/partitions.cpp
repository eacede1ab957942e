#include "addons/fleet/store/partitions.hpp"

#include <fmt/format.h>

namespace spoolflow::fleet {
namespace {

std::vector<Claim> claims(const Rows& rows) {
  std::vector<Claim> out;
  for (int row = 0; row < rows.size(); ++row) out.push_back({rows.integer(row, 0), rows.integer(row, 1)});
  return out;
}

/// Each as "partition:epoch", as an array of SQL.
std::string names(const std::vector<Claim>& claims) {
  std::string out;
  for (const Claim& one : claims) out += fmt::format("{}{}:{}", out.empty() ? "" : ",", one.partition, one.epoch);
  return '{' + out + '}';
}

}  // namespace

Spread renew(Session& session, const std::string& owner, double lease_s, const std::vector<Claim>& standing) {
  session.run(
      "INSERT INTO worker(name, alive_until) VALUES($1, now() + $2::float8 * interval '1 s') "
      "ON CONFLICT(name) DO UPDATE SET alive_until = excluded.alive_until",
      Values().put(std::string_view(owner)).put(lease_s));
  // A row that a commit holds is renewed by that commit: waiting for it, the other leases would run out.
  session.run(
      "UPDATE partition SET lease_until = now() + $2::float8 * interval '1 s' "
      "WHERE number IN (SELECT number FROM partition WHERE owner = $1 AND number || ':' || epoch <> ALL($3::text[]) "
      "FOR UPDATE SKIP LOCKED)",
      Values().put(std::string_view(owner)).put(lease_s).put(std::string_view(names(standing))));
  Spread out;
  out.held = claims(
      session.run("SELECT number, epoch FROM partition WHERE owner = $1 AND number || ':' || epoch <> ALL($2::text[])",
                  Values().put(std::string_view(owner)).put(std::string_view(names(standing)))));
  out.workers = session.run("SELECT count(*) FROM worker WHERE alive_until > now()").integer(0, 0);
  session.run("DELETE FROM worker WHERE alive_until < now() - interval '1 hour'");
  return out;
}

std::vector<Claim> claim(Session& session, const std::string& owner, double lease_s, std::int64_t most) {
  return claims(session.run(
      "UPDATE partition SET owner = $1, epoch = epoch + 1, lease_until = now() + $2::float8 * interval '1 s' "
      "WHERE number IN (SELECT number FROM partition WHERE lease_until < now() ORDER BY number LIMIT $3 "
      "FOR UPDATE SKIP LOCKED) RETURNING number, epoch",
      Values().put(std::string_view(owner)).put(lease_s).put(most)));
}

std::optional<Claim> claim_again(Session& session, const std::string& owner, std::int64_t partition) {
  const std::vector<Claim> got = claims(
      session.run("UPDATE partition SET epoch = epoch + 1 WHERE number = $2 AND owner = $1 RETURNING number, epoch",
                  Values().put(std::string_view(owner)).put(partition)));
  if (got.empty()) return std::nullopt;
  return got.front();
}

void release(Session& session, const Claim& claim) {
  session.run("UPDATE partition SET owner = NULL, lease_until = '-infinity' WHERE number = $1 AND epoch = $2",
              Values().put(claim.partition).put(claim.epoch));
}

void leave(Session& session, const std::string& owner) {
  session.run("UPDATE partition SET owner = NULL, lease_until = '-infinity' WHERE owner = $1",
              Values().put(std::string_view(owner)));
  session.run("DELETE FROM worker WHERE name = $1", Values().put(std::string_view(owner)));
}

std::vector<PartitionStatus> partition_status(Session& session) {
  const Rows rows = session.run(
      "SELECT partition.number, epoch, count(valve.number), coalesce(sum(block), 0), coalesce(owner, ''), "
      "(CASE WHEN lease_until > now() THEN extract(epoch FROM lease_until - now()) ELSE 0 END)::float8, "
      "extract(epoch FROM now() - max(committed))::float8, partition.set_aside "
      "FROM partition LEFT JOIN valve ON valve.partition = partition.number LEFT JOIN coverage ON coverage.valve = "
      "valve.number GROUP BY partition.number ORDER BY partition.number");
  std::vector<PartitionStatus> out;
  for (int row = 0; row < rows.size(); ++row) {
    out.push_back({rows.integer(row, 0), rows.integer(row, 1), rows.integer(row, 2), rows.integer(row, 3),
                   rows.text(row, 4), rows.real(row, 5), rows.real(row, 6), rows.integer(row, 7)});
  }
  return out;
}

}  // namespace spoolflow::fleet
