-- What version 3 of the fleet's tables has beside those of version 2, roles included.
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
DO $$ BEGIN
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'spoolflow_batch') THEN CREATE ROLE spoolflow_batch NOLOGIN; END IF;
END $$;
GRANT USAGE ON SCHEMA public TO spoolflow_batch;
GRANT SELECT ON ALL TABLES IN SCHEMA public TO spoolflow_reader, spoolflow_page;
REVOKE SELECT ON content_chunk FROM spoolflow_reader, spoolflow_page;
GRANT SELECT, INSERT, DELETE ON content, content_chunk TO spoolflow_worker;
GRANT SELECT, INSERT ON job_content TO spoolflow_worker;
GRANT SELECT, DELETE ON job TO spoolflow_worker;
GRANT UPDATE(came) ON content TO spoolflow_worker, spoolflow_batch;
GRANT UPDATE(state, attempts, owner, lease_until, finished, outcome) ON job TO spoolflow_worker;
GRANT SELECT ON setting, worker, content, content_chunk, job, job_content TO spoolflow_batch;
GRANT INSERT ON content, content_chunk, job_content TO spoolflow_batch;
GRANT INSERT(key, kind, program, manifest), UPDATE(wanted, state, attempts) ON job TO spoolflow_batch;
UPDATE setting SET value = '3' WHERE name = 'version';
