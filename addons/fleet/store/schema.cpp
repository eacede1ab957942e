#include "addons/fleet/store/schema.hpp"

#include <fmt/format.h>

namespace spoolflow::fleet {
namespace {

constexpr const char* tables = R"(
CREATE TABLE setting(name text PRIMARY KEY, value text NOT NULL);
CREATE TABLE worker(name text PRIMARY KEY, since timestamptz NOT NULL DEFAULT now(), alive_until timestamptz NOT NULL);
CREATE TABLE partition(
  number int PRIMARY KEY, owner text, epoch bigint NOT NULL DEFAULT 0,
  lease_until timestamptz NOT NULL DEFAULT '-infinity', stream_created bigint NOT NULL DEFAULT 0,
  stream_sequence bigint NOT NULL DEFAULT 0);
CREATE TABLE valve(
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, id text NOT NULL UNIQUE,
  partition int NOT NULL REFERENCES partition(number));
CREATE INDEX valve_of_partition ON valve(partition);
CREATE TABLE model(sha256 text PRIMARY KEY, content bytea NOT NULL, came timestamptz NOT NULL DEFAULT now());
CREATE TABLE model_in_force(
  valve bigint NOT NULL REFERENCES valve(number), session bigint NOT NULL, from_block bigint NOT NULL,
  sha256 text NOT NULL REFERENCES model(sha256), PRIMARY KEY(valve, session, from_block));
CREATE TABLE coverage(
  valve bigint PRIMARY KEY REFERENCES valve(number), session bigint NOT NULL, block bigint NOT NULL,
  wall_ms bigint NOT NULL, minute bigint NOT NULL, model text NOT NULL REFERENCES model(sha256),
  alarm_waits text NOT NULL, committed timestamptz NOT NULL DEFAULT now());
CREATE TABLE second(
  valve bigint NOT NULL REFERENCES valve(number), session bigint NOT NULL, block bigint NOT NULL,
  wall_ms bigint NOT NULL, time_s float8, samples bigint NOT NULL, flow_min float8, flow_mean float8, flow_max float8,
  lower_min float8, upper_max float8, energy_J float8, status bigint NOT NULL, PRIMARY KEY(valve, session, block));
CREATE INDEX second_by_time ON second(valve, wall_ms);
CREATE TABLE indicator(
  valve bigint NOT NULL REFERENCES valve(number), session bigint NOT NULL, block bigint NOT NULL,
  wall_ms bigint NOT NULL, name text NOT NULL, value float8, uncertainty_95 float8, baseline float8,
  state text NOT NULL, PRIMARY KEY(valve, session, block, name));
CREATE INDEX indicator_by_time ON indicator(valve, wall_ms);
CREATE TABLE event(
  id bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, wall_ms bigint NOT NULL, valve text NOT NULL, time_s float8,
  kind text NOT NULL, text text NOT NULL, acknowledged_ms bigint NOT NULL DEFAULT 0);
CREATE TABLE alarm(
  valve text NOT NULL, id bigint NOT NULL, cause text NOT NULL, sign text NOT NULL, raised_ms bigint NOT NULL,
  gone_ms bigint NOT NULL, acknowledged_ms bigint NOT NULL, acknowledged_by text NOT NULL, times bigint NOT NULL,
  time_s float8, text text NOT NULL, recording bigint NOT NULL, PRIMARY KEY(valve, id));
CREATE TABLE alarm_indicator(
  valve text NOT NULL, alarm bigint NOT NULL, place int NOT NULL, name text NOT NULL, value float8,
  uncertainty_95 float8, baseline float8, state text NOT NULL, unit text NOT NULL, PRIMARY KEY(valve, alarm, place));
CREATE TABLE state(
  valve bigint PRIMARY KEY REFERENCES valve(number), session bigint NOT NULL, next bigint NOT NULL,
  samples bigint NOT NULL, energy_J float8 NOT NULL, change bytea NOT NULL);
CREATE TABLE older_state(
  valve bigint PRIMARY KEY REFERENCES valve(number), layout text NOT NULL, bytes bigint NOT NULL,
  content bytea NOT NULL);
)";

/// What version 2 has beside: units of indicators, and acknowledgements that workers take to their alarms.
constexpr const char* second_version = R"(
ALTER TABLE indicator ADD COLUMN unit text NOT NULL DEFAULT '';
CREATE TABLE acknowledgement(
  valve text NOT NULL, alarm bigint NOT NULL, wall_ms bigint NOT NULL, name text NOT NULL,
  taken_session bigint, taken_block bigint, PRIMARY KEY(valve, alarm));
CREATE INDEX acknowledgement_waits ON acknowledgement(valve) WHERE taken_block IS NULL;
CREATE INDEX event_of_valve ON event(valve, id);
CREATE VIEW alarm_seen AS SELECT
  alarm.valve, id, cause, sign, raised_ms, gone_ms,
  CASE WHEN acknowledged_ms = 0 THEN coalesce(acknowledgement.wall_ms, 0) ELSE acknowledged_ms END AS acknowledged_ms,
  CASE WHEN acknowledged_ms = 0 THEN coalesce(name, '') ELSE acknowledged_by END AS acknowledged_by,
  times, time_s, text
  FROM alarm LEFT JOIN acknowledgement ON acknowledgement.valve = alarm.valve AND acknowledgement.alarm = alarm.id;
)";

/// What version 3 has beside: pieces of batch work, and the contents of files that they read and write.
constexpr const char* third_version = R"(
ALTER TABLE worker ADD COLUMN program text NOT NULL DEFAULT '', ADD COLUMN takes_jobs timestamptz;
CREATE TABLE content(sha256 text PRIMARY KEY, bytes bigint NOT NULL, came timestamptz NOT NULL DEFAULT now());
CREATE TABLE content_chunk(
  sha256 text NOT NULL REFERENCES content(sha256) ON DELETE CASCADE, place int NOT NULL, packed bytea NOT NULL,
  PRIMARY KEY(sha256, place));
CREATE TABLE job(
  key text PRIMARY KEY, number bigint GENERATED ALWAYS AS IDENTITY, kind text NOT NULL, program text NOT NULL,
  manifest text NOT NULL, wanted timestamptz NOT NULL DEFAULT now(), state text NOT NULL DEFAULT 'open',
  attempts bigint NOT NULL DEFAULT 0, owner text, lease_until timestamptz NOT NULL DEFAULT '-infinity',
  finished timestamptz, outcome text);
CREATE INDEX job_waits ON job(number) WHERE state IN ('open', 'running');
CREATE TABLE job_content(
  key text NOT NULL REFERENCES job(key) ON DELETE CASCADE, sha256 text NOT NULL REFERENCES content(sha256),
  PRIMARY KEY(key, sha256));
CREATE INDEX job_of_content ON job_content(sha256);
)";

/// What version 4 has beside: blocks of which nothing is made, and how many there were.
constexpr const char* fourth_version = R"(
ALTER TABLE partition ADD COLUMN set_aside bigint NOT NULL DEFAULT 0;
CREATE TABLE set_aside(
  number bigint GENERATED ALWAYS AS IDENTITY, partition int NOT NULL REFERENCES partition(number), digest bytea NOT NULL,
  came timestamptz NOT NULL DEFAULT now(), came_last timestamptz NOT NULL DEFAULT now(), times bigint NOT NULL DEFAULT 1,
  sequence bigint NOT NULL, subject text NOT NULL, valve text NOT NULL, session bigint NOT NULL, block bigint NOT NULL,
  reason text NOT NULL, content bytea NOT NULL, PRIMARY KEY(partition, digest));
CREATE INDEX set_aside_newest ON set_aside(partition, number);
)";

/// What version 5 has beside: alarms that people have shelved, and what they say of them.
constexpr const char* fifth_version = R"(
CREATE TABLE alarm_shelf(
  valve text NOT NULL, alarm bigint NOT NULL, wall_ms bigint NOT NULL, until_ms bigint NOT NULL, name text NOT NULL,
  PRIMARY KEY(valve, alarm));
CREATE TABLE alarm_comment(
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, valve text NOT NULL, alarm bigint NOT NULL,
  wall_ms bigint NOT NULL, name text NOT NULL, text text NOT NULL);
CREATE INDEX comment_of_alarm ON alarm_comment(valve, alarm, number);
CREATE OR REPLACE VIEW alarm_seen AS SELECT
  alarm.valve, id, cause, sign, raised_ms, gone_ms,
  CASE WHEN acknowledged_ms = 0 THEN coalesce(acknowledgement.wall_ms, 0) ELSE acknowledged_ms END AS acknowledged_ms,
  CASE WHEN acknowledged_ms = 0 THEN coalesce(acknowledgement.name, '') ELSE acknowledged_by END AS acknowledged_by,
  times, time_s, text, coalesce(shelf.wall_ms, 0) AS shelved_ms, coalesce(shelf.until_ms, 0) AS shelved_until_ms,
  coalesce(shelf.name, '') AS shelved_by
  FROM alarm LEFT JOIN acknowledgement ON acknowledgement.valve = alarm.valve AND acknowledgement.alarm = alarm.id
  LEFT JOIN alarm_shelf shelf ON shelf.valve = alarm.valve AND shelf.alarm = alarm.id
    AND shelf.until_ms > 1000 * extract(epoch FROM now());
)";

/// Workers read and write rows and change no table; readers read; the page also keeps what people do with alarms; who
/// asks for batch work adds pieces and files, and reads no result.
constexpr const char* roles = R"(
DO $$ BEGIN
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'spoolflow_worker') THEN CREATE ROLE spoolflow_worker NOLOGIN; END IF;
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'spoolflow_reader') THEN CREATE ROLE spoolflow_reader NOLOGIN; END IF;
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'spoolflow_page') THEN CREATE ROLE spoolflow_page NOLOGIN; END IF;
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'spoolflow_batch') THEN CREATE ROLE spoolflow_batch NOLOGIN; END IF;
END $$;
REVOKE ALL ON SCHEMA public FROM PUBLIC;
GRANT USAGE ON SCHEMA public TO spoolflow_worker, spoolflow_reader, spoolflow_page, spoolflow_batch;
GRANT SELECT, INSERT, UPDATE, DELETE ON worker TO spoolflow_worker;
GRANT SELECT, UPDATE ON partition TO spoolflow_worker;
GRANT SELECT ON setting TO spoolflow_worker;
GRANT SELECT, INSERT ON valve, model, model_in_force, second, indicator, event TO spoolflow_worker;
GRANT SELECT, INSERT, UPDATE ON coverage, alarm, alarm_indicator, state, older_state TO spoolflow_worker;
GRANT SELECT, UPDATE ON acknowledgement TO spoolflow_worker;
GRANT SELECT, INSERT, UPDATE, DELETE ON set_aside TO spoolflow_worker;
GRANT SELECT ON ALL TABLES IN SCHEMA public TO spoolflow_reader, spoolflow_page;
REVOKE SELECT ON content_chunk FROM spoolflow_reader, spoolflow_page;
GRANT INSERT ON acknowledgement TO spoolflow_page;
GRANT INSERT, UPDATE, DELETE ON alarm_shelf TO spoolflow_page;
GRANT INSERT, DELETE ON alarm_comment TO spoolflow_page;
GRANT SELECT, INSERT, DELETE ON content, content_chunk TO spoolflow_worker;
GRANT SELECT, INSERT ON job_content TO spoolflow_worker;
GRANT SELECT, DELETE ON job TO spoolflow_worker;
GRANT UPDATE(came) ON content TO spoolflow_worker, spoolflow_batch;
GRANT UPDATE(state, attempts, owner, lease_until, finished, outcome) ON job TO spoolflow_worker;
GRANT SELECT ON setting, worker, content, content_chunk, job, job_content TO spoolflow_batch;
GRANT INSERT ON content, content_chunk, job_content TO spoolflow_batch;
GRANT INSERT(key, kind, program, manifest), UPDATE(wanted, state, attempts) ON job TO spoolflow_batch;
)";

bool has_tables(Session& session) {
  return session.run("SELECT 1 FROM pg_tables WHERE schemaname = 'public' AND tablename = 'setting'").size() > 0;
}

double setting(Session& session, const char* name) {
  const Rows row =
      session.run("SELECT value::float8 FROM setting WHERE name = $1", Values().put(std::string_view(name)));
  if (row.size() == 0)
    throw ServerRefuses(fmt::format("the fleet's settings lack {}; run spoolflow fleet --setup", name));
  return row.real(0, 0);
}

void keep_setting(Session& session, const char* name, double value) {
  session.run("INSERT INTO setting VALUES($1, $2) ON CONFLICT(name) DO UPDATE SET value = excluded.value",
              Values().put(std::string_view(name)).put(std::string_view(fmt::format("{}", value))));
}

void check_version(Session& session) {
  const auto version = static_cast<std::int64_t>(setting(session, "version"));
  if (version == schema_version) return;
  throw ServerRefuses(fmt::format(
      "the fleet's tables are of version {}, this program knows version {}; {}", version, schema_version,
      version < schema_version ? "run spoolflow fleet --setup of this program, which brings them to it"
                               : "use a newer program, such as the one that made them, or another database"));
}

}  // namespace

SchemaWork make_schema(Session& session, const SharedSettings& settings) {
  FleetTransaction whole(session);
  // Two at a time would both find nothing.
  session.run("SELECT pg_advisory_xact_lock(5457)");
  const bool made = !has_tables(session);
  if (made) {
    session.run_script(tables);
    session.run_script(second_version);
    session.run_script(third_version);
    session.run_script(fourth_version);
    session.run_script(fifth_version);
    keep_setting(session, "version", static_cast<double>(schema_version));
    keep_setting(session, "partitions", static_cast<double>(settings.partitions));
  }
  const double version = setting(session, "version");
  if (version == 1) session.run_script(second_version);
  if (version == 1 || version == 2) session.run_script(third_version);
  if (version == 1 || version == 2 || version == 3) session.run_script(fourth_version);
  const bool upgraded = version == 1 || version == 2 || version == 3 || version == 4;
  if (upgraded) {
    session.run_script(fifth_version);
    keep_setting(session, "version", static_cast<double>(schema_version));
  }
  check_version(session);
  const auto partitions = static_cast<std::int64_t>(setting(session, "partitions"));
  if (partitions != settings.partitions) {
    throw ServerRefuses(
        fmt::format("the fleet's valves are in {} partitions, those of this program in {}; use the "
                    "program that made the tables, or another database",
                    partitions, settings.partitions));
  }
  session.run("INSERT INTO partition(number) SELECT generate_series(0, $1::int - 1) ON CONFLICT DO NOTHING",
              Values().put(partitions));
  keep_setting(session, "raised_after_s", settings.raised_after_s);
  keep_setting(session, "gone_after_s", settings.gone_after_s);
  session.run_script(roles);
  whole.commit();
  return made ? SchemaWork::made : upgraded ? SchemaWork::upgraded : SchemaWork::nothing;
}

SharedSettings read_settings(Session& session) {
  if (!has_tables(session))
    throw ServerRefuses("the database has none of the fleet's tables; run spoolflow fleet --setup");
  check_version(session);
  return {static_cast<std::int64_t>(setting(session, "partitions")), setting(session, "raised_after_s"),
          setting(session, "gone_after_s")};
}

}  // namespace spoolflow::fleet
