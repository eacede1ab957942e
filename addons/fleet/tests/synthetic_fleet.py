#!/usr/bin/python3
"""synthetic_fleet.py COMMAND [VALVES]: a PostgreSQL server with rows of so many valves, as workers would have kept them, and
the page of `spoolflow fleet` over it. Prints the page's address, and ends when its standard input does."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from servers import Postgres, free_ports  # noqa: E402

# Valve v belongs to one of 20 sites and one of two series. Every 1000th valve's friction is beyond that of its series, every
# 500th has an alarm, every 250th has been silent for an hour. A whole hour is kept of the first one alone.
ROWS = """
SET synchronous_commit = off;
SELECT setseed(0.5);
INSERT INTO model(sha256, content) VALUES(repeat('a', 64), ''), (repeat('b', 64), '');
INSERT INTO valve(id, partition) SELECT format('hall_%s/valve_%s', lpad((v % 20)::text, 2, '0'), lpad(v::text, 5, '0')), v % 16
  FROM generate_series(1, {0}) v ORDER BY v;
INSERT INTO coverage(valve, session, block, wall_ms, minute, model, alarm_waits, committed)
  SELECT number, 1, 3600, {1}, 60, repeat(CASE WHEN number % 2 = 0 THEN 'a' ELSE 'b' END, 64), '',
  now() + CASE WHEN number % 250 = 0 THEN interval '-1 hour' ELSE interval '1 hour' END FROM valve;
INSERT INTO state SELECT number, 1, 3601, 3600000, 1e6, '' FROM valve;
INSERT INTO second SELECT number, 1, block, {1} - 1000 * (3600 - block), block, 1000, f - 1e-5, f, f + 1e-5, f - 2e-5, f + 2e-5, 90, 0
  FROM valve, LATERAL (SELECT 2e-4 + 1e-4 * sin(number)) flow(f),
  LATERAL generate_series(CASE WHEN number = 1 THEN 1 ELSE 3599 END, 3600) block;
INSERT INTO indicator SELECT number, 1, block, {1} - 1000 * (3600 - block), name,
  CASE WHEN name = 'friction_ratio' AND number % 1000 = 0 THEN 2.5 ELSE 1 + 0.1 * (random() + random() + random() - 1.5) END,
  0.05, 1, 'good', '1' FROM valve,
  unnest(ARRAY['friction_ratio', 'spring_preload_ratio', 'spring_rate_ratio', 'overshoot', 'response_time', 'offset',
               'hysteresis', 'winding', 'shorted_turns', 'leakage']) name,
  LATERAL generate_series(CASE WHEN number = 1 THEN 60 ELSE 3600 END, 3600, 60) block;
INSERT INTO alarm SELECT id, 1, 'friction', CASE WHEN number % 1000 = 0 THEN 'F' ELSE 'M' END, {1} - 60000, 0, 0, '', 1, 3540,
  'friction is 2.5 times as usual', 0 FROM valve WHERE number % 500 = 0;
INSERT INTO event(wall_ms, valve, time_s, kind, text) SELECT {1}, id, 3600, 'condition', 'made for this test' FROM valve WHERE number <= 3;
ANALYZE;
"""


class SyntheticFleet:
    def __init__(self, command, valves):
        self.folder = tempfile.mkdtemp(prefix="spoolflow-fleet-page-")
        os.chmod(self.folder, 0o755)
        self.page = None
        port = free_ports(1)[0]
        self.postgres = Postgres(self.folder, port)
        self.postgres.ask("CREATE ROLE page LOGIN")
        self.write("owner.toml", port, "postgres")
        self.write("page.toml", port, "page")
        subprocess.run([command, "fleet", "--setup", "owner.toml"], cwd=self.folder, check=True, capture_output=True)
        self.postgres.ask("GRANT spoolflow_page TO page")
        now_ms = int(self.postgres.ask("SELECT (1000 * extract(epoch FROM now()))::bigint")[0])
        self.postgres.ask(ROWS.format(valves, now_ms))
        self.page = subprocess.Popen([command, "fleet", "page.toml"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        line = self.page.stderr.readline()
        found = re.search(r"page at (http://\S+:(\d+))/", line)
        if not found:
            raise AssertionError(line)
        self.address, self.port = found.group(1), int(found.group(2))

    def write(self, name, port, user):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(f'[nats]\nservers = "nats://127.0.0.1:1"\n[postgresql]\nconnection = "host=127.0.0.1 port={port} '
                       f'user={user} dbname=postgres"\n[page]\nlisten = "127.0.0.1:0"\n')

    def stop(self):
        if self.page:
            self.page.terminate()
            self.page.wait(30)
            self.page.stderr.close()
        self.postgres.stop()
        shutil.rmtree(self.folder)


if __name__ == "__main__":
    fleet = SyntheticFleet(os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 10000)
    try:
        print(fleet.address, flush=True)
        sys.stdin.read()
    finally:
        fleet.stop()
