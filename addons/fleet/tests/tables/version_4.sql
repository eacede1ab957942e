-- What version 4 of the fleet's tables has beside those of version 3, roles included.
ALTER TABLE partition ADD COLUMN set_aside bigint NOT NULL DEFAULT 0;
CREATE TABLE set_aside(
  number bigint GENERATED ALWAYS AS IDENTITY, partition int NOT NULL REFERENCES partition(number), digest bytea NOT NULL,
  came timestamptz NOT NULL DEFAULT now(), came_last timestamptz NOT NULL DEFAULT now(), times bigint NOT NULL DEFAULT 1,
  sequence bigint NOT NULL, subject text NOT NULL, valve text NOT NULL, session bigint NOT NULL, block bigint NOT NULL,
  reason text NOT NULL, content bytea NOT NULL, PRIMARY KEY(partition, digest));
CREATE INDEX set_aside_newest ON set_aside(partition, number);
GRANT SELECT, INSERT, UPDATE, DELETE ON set_aside TO spoolflow_worker;
GRANT SELECT ON set_aside TO spoolflow_reader, spoolflow_page;
UPDATE setting SET value = '4' WHERE name = 'version';
