#include "addons/fleet/store/job_table.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace spoolflow::fleet {
namespace {

using std::string_view;

/// As PostgreSQL reads an array of texts; keys are hexadecimal digits.
std::string array_of(const std::vector<std::string>& keys) {
  return fmt::format("{{{}}}", fmt::join(keys, ","));
}

const char* name(JobState state) {
  return state == JobState::done ? "done" : state == JobState::failed ? "failed" : "given_up";
}

}  // namespace

bool has_content(Session& session, const std::string& sha256) {
  return session.run("UPDATE content SET came = now() WHERE sha256 = $1", Values().put(string_view(sha256)))
             .affected() > 0;
}

void keep_content(Session& session, const std::string& sha256, std::int64_t bytes,
                  const std::function<std::optional<std::vector<std::uint8_t>>(int)>& chunk) {
  FleetTransaction whole(session);
  const bool is_new = session
                          .run("INSERT INTO content(sha256, bytes) VALUES($1, $2) ON CONFLICT DO NOTHING",
                               Values().put(string_view(sha256)).put(bytes))
                          .affected() > 0;
  for (int place = 0; is_new; ++place) {
    const auto packed = chunk(place);
    if (!packed) break;
    session.run("INSERT INTO content_chunk VALUES($1, $2, $3)",
                Values().put(string_view(sha256)).put(std::int64_t{place}).put(std::span<const std::uint8_t>(*packed)));
  }
  whole.commit();
}

bool read_content(Session& session, const std::string& sha256,
                  const std::function<void(std::vector<std::uint8_t>)>& chunk) {
  const auto about = Values().put(string_view(sha256));
  if (session.run("SELECT 1 FROM content WHERE sha256 = $1", about).size() == 0) return false;
  for (std::int64_t place = 0;; ++place) {
    const Rows row = session.run("SELECT packed FROM content_chunk WHERE sha256 = $1 AND place = $2",
                                 Values().put(string_view(sha256)).put(place));
    if (row.size() == 0) return true;
    chunk(row.bytes(0, 0));
  }
}

void ask_job(Session& session, const AskedJob& job) {
  FleetTransaction whole(session);
  session.run(
      "INSERT INTO job(key, kind, program, manifest) VALUES($1, $2, $3, $4) ON CONFLICT(key) DO UPDATE SET "
      "wanted = now(), attempts = CASE WHEN job.state IN ('failed', 'given_up') THEN 0 ELSE job.attempts END, "
      "state = CASE WHEN job.state IN ('failed', 'given_up') THEN 'open' ELSE job.state END",
      Values()
          .put(string_view(job.key))
          .put(string_view(job.kind))
          .put(string_view(job.program))
          .put(string_view(job.manifest)));
  for (const std::string& sha256 : job.contents) {
    session.run("INSERT INTO job_content VALUES($1, $2) ON CONFLICT DO NOTHING",
                Values().put(string_view(job.key)).put(string_view(sha256)));
  }
  whole.commit();
}

void want_jobs(Session& session, const std::vector<std::string>& keys) {
  session.run("UPDATE job SET wanted = now() WHERE key = ANY($1::text[])", Values().put(string_view(array_of(keys))));
}

std::vector<FinishedJob> finished_jobs(Session& session, const std::vector<std::string>& keys) {
  const Rows rows = session.run(
      "SELECT key, state, coalesce(outcome, '') FROM job WHERE key = ANY($1::text[]) AND state IN ('done', 'failed', "
      "'given_up')",
      Values().put(string_view(array_of(keys))));
  std::vector<FinishedJob> out;
  for (int row = 0; row < rows.size(); ++row) {
    const std::string state = rows.text(row, 1);
    out.push_back({rows.text(row, 0),
                   state == "done"     ? JobState::done
                   : state == "failed" ? JobState::failed
                                       : JobState::given_up,
                   rows.text(row, 2)});
  }
  return out;
}

std::optional<TakenJob> take_job(Session& session, const std::string& owner, const std::string& program,
                                 double lease_s) {
  session.run(
      "UPDATE job SET state = 'given_up', owner = NULL, finished = now() WHERE state = 'running' AND lease_until < "
      "now() "
      "AND attempts >= $1",
      Values().put(most_attempts));
  const Rows taken = session.run(
      "UPDATE job SET state = 'running', owner = $1, attempts = attempts + 1, lease_until = now() + $2::float8 * "
      "interval '1 s' WHERE key = (SELECT key FROM job WHERE program = $3 AND (state = 'open' OR state = 'running' AND "
      "lease_until < now() AND attempts < $4) ORDER BY number LIMIT 1 FOR UPDATE SKIP LOCKED) RETURNING key, manifest",
      Values().put(string_view(owner)).put(lease_s).put(string_view(program)).put(most_attempts));
  if (taken.size() == 0) return std::nullopt;
  return TakenJob{taken.text(0, 0), taken.text(0, 1)};
}

bool renew_job(Session& session, const std::string& key, const std::string& owner, double lease_s) {
  return session
             .run(
                 "UPDATE job SET lease_until = now() + $3::float8 * interval '1 s' WHERE key = $1 AND owner = $2 AND "
                 "state = 'running'",
                 Values().put(string_view(key)).put(string_view(owner)).put(lease_s))
             .affected() > 0;
}

void finish_job(Session& session, const FinishedJob& job, const std::vector<std::string>& contents) {
  FleetTransaction whole(session);
  const auto there =
      session
          .run(
              "UPDATE job SET state = $2, outcome = $3, owner = NULL, finished = now() WHERE key = $1 "
              "AND state <> 'done'",
              Values().put(string_view(job.key)).put(string_view(name(job.state))).put(string_view(job.outcome)))
          .affected();
  for (const std::string& sha256 : contents) {
    if (there == 0) break;
    session.run("INSERT INTO job_content VALUES($1, $2) ON CONFLICT DO NOTHING",
                Values().put(string_view(job.key)).put(string_view(sha256)));
  }
  whole.commit();
}

void return_job(Session& session, const std::string& key, const std::string& owner, bool ended) {
  session.run(
      "UPDATE job SET owner = NULL, attempts = CASE WHEN $3::int = 1 THEN attempts ELSE attempts - 1 END, "
      "state = CASE WHEN $3::int = 1 AND attempts >= $4 THEN 'given_up' ELSE 'open' END, "
      "finished = CASE WHEN $3::int = 1 AND attempts >= $4 THEN now() END "
      "WHERE key = $1 AND owner = $2 AND state = 'running'",
      Values().put(string_view(key)).put(string_view(owner)).put(std::int64_t{ended ? 1 : 0}).put(most_attempts));
}

void report_at_work(Session& session, const std::string& owner, const std::string& program) {
  session.run("UPDATE worker SET program = $2, takes_jobs = now() WHERE name = $1",
              Values().put(string_view(owner)).put(string_view(program)));
}

void remove_old_jobs(Session& session, double keep_hours) {
  session.run(
      "DELETE FROM job WHERE wanted < now() - $1::float8 * interval '1 hour' AND NOT (state = 'running' AND "
      "lease_until > now())",
      Values().put(keep_hours));
  // What somebody may be about to name in a piece stays for an hour.
  session.run(
      "DELETE FROM content WHERE came < now() - interval '1 hour' AND NOT EXISTS "
      "(SELECT FROM job_content WHERE job_content.sha256 = content.sha256)");
}

JobStatus job_status(Session& session) {
  const Rows row = session.run(
      "SELECT count(*) FILTER (WHERE state = 'open'), count(*) FILTER (WHERE state = 'running'), "
      "count(*) FILTER (WHERE state = 'done'), count(*) FILTER (WHERE state = 'failed'), "
      "count(*) FILTER (WHERE state = 'given_up'), (SELECT count(*) FROM content), "
      "(SELECT coalesce(sum(bytes), 0)::float8 / 1e6 FROM content) FROM job");
  return {row.integer(0, 0), row.integer(0, 1), row.integer(0, 2), row.integer(0, 3),
          row.integer(0, 4), row.integer(0, 5), row.real(0, 6)};
}

Takers takers_of(Session& session, const std::string& program) {
  const Rows row = session.run(
      "SELECT extract(epoch FROM now() - max(takes_jobs) FILTER (WHERE program = $1))::float8, "
      "coalesce(string_agg(DISTINCT program, ', ') FILTER (WHERE program NOT IN ($1, '') AND alive_until > now()), '') "
      "FROM worker",
      Values().put(string_view(program)));
  const double silent_s = row.real(0, 0);
  return {std::isnan(silent_s) ? std::numeric_limits<double>::infinity() : silent_s, row.text(0, 1)};
}

}  // namespace spoolflow::fleet
