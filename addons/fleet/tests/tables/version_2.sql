-- What version 2 of the fleet's tables has beside those of version 1, roles included.
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
DO $$ BEGIN
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'spoolflow_worker') THEN CREATE ROLE spoolflow_worker NOLOGIN; END IF;
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'spoolflow_reader') THEN CREATE ROLE spoolflow_reader NOLOGIN; END IF;
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'spoolflow_page') THEN CREATE ROLE spoolflow_page NOLOGIN; END IF;
END $$;
REVOKE ALL ON SCHEMA public FROM PUBLIC;
GRANT USAGE ON SCHEMA public TO spoolflow_worker, spoolflow_reader, spoolflow_page;
GRANT SELECT, INSERT, UPDATE, DELETE ON worker TO spoolflow_worker;
GRANT SELECT, UPDATE ON partition TO spoolflow_worker;
GRANT SELECT ON setting TO spoolflow_worker;
GRANT SELECT, INSERT ON valve, model, model_in_force, second, indicator, event TO spoolflow_worker;
GRANT SELECT, INSERT, UPDATE ON coverage, alarm, alarm_indicator, state, older_state TO spoolflow_worker;
GRANT SELECT, UPDATE ON acknowledgement TO spoolflow_worker;
GRANT SELECT ON ALL TABLES IN SCHEMA public TO spoolflow_reader, spoolflow_page;
GRANT INSERT ON acknowledgement TO spoolflow_page;
UPDATE setting SET value = '2' WHERE name = 'version';
