-- The fleet's tables as programs of version 1 of them made them, roles included.
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
DO $$ BEGIN
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'spoolflow_worker') THEN CREATE ROLE spoolflow_worker NOLOGIN; END IF;
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'spoolflow_reader') THEN CREATE ROLE spoolflow_reader NOLOGIN; END IF;
END $$;
REVOKE ALL ON SCHEMA public FROM PUBLIC;
GRANT USAGE ON SCHEMA public TO spoolflow_worker, spoolflow_reader;
GRANT SELECT, INSERT, UPDATE, DELETE ON worker TO spoolflow_worker;
GRANT SELECT, UPDATE ON partition TO spoolflow_worker;
GRANT SELECT ON setting TO spoolflow_worker;
GRANT SELECT, INSERT ON valve, model, model_in_force, second, indicator, event TO spoolflow_worker;
GRANT SELECT, INSERT, UPDATE ON coverage, alarm, alarm_indicator, state, older_state TO spoolflow_worker;
GRANT SELECT ON ALL TABLES IN SCHEMA public TO spoolflow_reader;
INSERT INTO setting VALUES('version', '1'), ('partitions', '16'), ('raised_after_s', '0'), ('gone_after_s', '0.05');
INSERT INTO partition(number) SELECT generate_series(0, 15);
