#!/usr/bin/python3
"""upgrade_test.py COMMAND EXAMPLES: tables that programs of older versions made, with their rows, become the present ones by
`fleet --setup`, and a worker goes on behind them; those of a newer program are refused."""
import ctypes
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import zlib

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from block_reader import ZSTD, read_block  # noqa: E402
from fleet import Worker, blocks_of, make_recordings, outbox, record_offline, site, write_fleet, write_site  # noqa: E402
from servers import Nats, Postgres, free_ports, until  # noqa: E402

COMMAND, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:3])
MODEL = os.path.join(EXAMPLES, "live", "size_6.json")
HERE = os.path.dirname(os.path.abspath(__file__))
SECONDS, BLOCK_S, COMMITTED = 10, 0.1, 40
TABLES = ("valve", "model", "model_in_force", "coverage", "second", "indicator", "event", "alarm", "alarm_indicator", "state",
          "older_state")
# What workers of that version had committed of a valve: blocks 1 to 40, with a state that only they can read.
ROWS = """
INSERT INTO valve(id, partition) VALUES('hall/v0', {partition});
INSERT INTO model(sha256, content) VALUES('{model}', '\\x{packed}');
INSERT INTO model_in_force VALUES(1, {session}, 1, '{model}');
INSERT INTO coverage VALUES(1, {session}, {committed}, 1700000000000, 3, '{model}', '', now());
INSERT INTO second SELECT 1, {session}, block, 1700000000000 + block, 0.1 * block, 100, 0.1, 0.2, 0.3, 0.05, 0.4, 1e-3, 0
  FROM generate_series(1, {committed}) block;
INSERT INTO indicator VALUES(1, {session}, 1, 1700000000000, 'friction_ratio', 1.25, 0.1, 1, 'good');
INSERT INTO event(wall_ms, valve, time_s, kind, text) VALUES(1700000000000, 'hall/v0', 1, 'begun', 'of version 1');
INSERT INTO alarm VALUES('hall/v0', 7, 'friction', 'M', 1700000000000, 1700000000001, 0, '', 1, 1, 'kept', 0);
INSERT INTO alarm_indicator VALUES('hall/v0', 7, 0, 'friction_ratio', 2, 0.1, 1, 'raised', '1');
INSERT INTO state VALUES(1, {session}, {committed} + 1, 100 * {committed}, 1.5, '');
INSERT INTO older_state VALUES(1, 'spoolflow 0.0.1', 8, '\\x00010102030405060708');
"""
COLUMNS = ("SELECT table_name, column_name, data_type, is_nullable, coalesce(column_default, '') FROM information_schema.columns "
           "WHERE table_schema = 'public' ORDER BY 1, 2")
GRANTS = ("SELECT grantee, table_name, column_name, privilege_type FROM information_schema.column_privileges WHERE "
          "table_schema = 'public' AND grantee LIKE 'spoolflow%' ORDER BY 1, 2, 3, 4")


def sql(version):
    with open(os.path.join(HERE, "tables", f"version_{version}.sql"), encoding="utf-8") as file:
        return file.read()


def packed(content):
    """One zstd frame."""
    out = ctypes.create_string_buffer(len(content) + 1000)
    size = ZSTD.ZSTD_compress(out, ctypes.c_size_t(len(out)), content, ctypes.c_size_t(len(content)), 3)
    return out.raw[:size]


class Upgrade(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="spoolflow-fleet-upgrade-")
        self.addCleanup(shutil.rmtree, self.folder)
        os.chmod(self.folder, 0o755)
        nats_port, port = free_ports(2)
        self.postgres = Postgres(self.folder, port)
        self.addCleanup(self.postgres.stop)
        self.nats = Nats(self.folder, nats_port)
        self.addCleanup(self.nats.stop)
        write_fleet(self.folder, [nats_port], [port], 1)

    def fleet(self, option, database="postgres", status=0):
        with open(os.path.join(self.folder, "fleet.toml"), encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(self.folder, f"{database}.toml"), "w", encoding="utf-8") as file:
            file.write(text.replace("dbname=postgres", f"dbname={database}"))
        done = subprocess.run([COMMAND, *option.split(), f"{database}.toml"], cwd=self.folder, text=True, capture_output=True)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stderr

    def rows(self):
        """Of the columns of version 1, whatever was added since."""
        out = {}
        for table in TABLES:
            names = ", ".join(self.columns[table])
            out[table] = self.postgres.ask(f"SELECT {names} FROM {table} ORDER BY 1, 2")
        return out

    def test_rows_are_kept_and_a_worker_goes_on(self):
        make_recordings(COMMAND, self.folder, SECONDS)
        write_site(self.folder, MODEL, 1, BLOCK_S)
        record_offline(COMMAND, self.folder, "nats://127.0.0.1:1", 1, 1000 * SECONDS)
        waiting, newest, _ = outbox(self.folder)
        self.assertGreater(waiting, 2 * COMMITTED)
        session = self.session()
        self.postgres.ask(sql(1))
        with open(MODEL, "rb") as file:
            model = file.read()
        self.postgres.ask(ROWS.format(partition=zlib.crc32(b"hall/v0") % 16, session=session, committed=COMMITTED,
                                      model=hashlib.sha256(model).hexdigest(), packed=packed(model).hex()))
        self.postgres.ask("CREATE ROLE worker_1 LOGIN IN ROLE spoolflow_worker")
        self.columns = {table: self.postgres.ask("SELECT column_name FROM information_schema.columns WHERE table_name = "
                                                 f"'{table}' ORDER BY ordinal_position") for table in TABLES}
        before = self.rows()
        self.assertTrue(all(before.values()))
        for command in ("worker", "fleet --status"):
            self.assertIn("of version 1, this program knows version 5; run spoolflow fleet --setup",
                          self.fleet(command, status=2))
        self.assertEqual(self.rows(), before)
        self.assertIn("brought to the present version", self.fleet("fleet --setup"))
        self.assertEqual(self.rows(), before)
        self.assertIn("were there", self.fleet("fleet --setup"))
        self.go_on(newest["v0"], before)

    def go_on(self, newest, before):
        worker = Worker(COMMAND, self.folder, "worker_1")
        self.addCleanup(worker.stop)
        with site(COMMAND, self.folder, f"nats://127.0.0.1:{self.nats.port}"):
            try:
                until(lambda: self.postgres.ask("SELECT block FROM coverage") == [str(newest)], 30, "blocks that are committed")
            except AssertionError as error:
                with open(worker.log, encoding="utf-8") as log:
                    raise AssertionError(f"{error}; {self.postgres.ask('SELECT * FROM coverage')}: {log.read()[-500:]}") from error
        worker.end()
        after = self.rows()
        for table in ("second", "indicator", "event", "model_in_force"):
            self.assertEqual([row for row in before[table] if row not in after[table]], [], table)
        self.assertEqual(self.postgres.ask("SELECT count(*), min(block), max(block) FROM second"), [f"{newest}|1|{newest}"])
        self.assertEqual(after["model_in_force"], before["model_in_force"])
        self.assertIn(before["alarm"][0], after["alarm"])
        self.assertGreater(len(after["event"]), 1)  # that sensor and monitor were reset

    def session(self):
        """Of the site's store."""
        return read_block(blocks_of(self.folder, "v0")[0])["session"]

    def test_every_way_leads_to_the_same_tables(self):
        for database in ("fresh", "one", "two", "three", "four", "newer"):
            self.postgres.ask(f"CREATE DATABASE {database}")
        self.postgres.ask(sql(1), "one")
        for newest, database in enumerate(("two", "three", "four"), 2):
            for version in range(1, newest + 1):
                self.postgres.ask(sql(version), database)
        for database in ("fresh", "one", "two", "three", "four"):
            self.fleet("fleet --setup", database)
        for question in (COLUMNS, GRANTS):
            fresh = self.postgres.ask(question, "fresh")
            self.assertGreater(len(fresh), 50)
            for database in ("one", "two", "three", "four"):
                self.assertEqual(self.postgres.ask(question, database), fresh, database)
        self.postgres.ask(sql(1), "newer")
        self.postgres.ask("UPDATE setting SET value = '99' WHERE name = 'version'", "newer")
        for command in ("fleet --setup", "fleet --status", "worker"):
            self.assertIn("of version 99, this program knows version 5; use a newer program",
                          self.fleet(command, "newer", status=2))
        self.assertEqual(self.postgres.ask("SELECT value FROM setting WHERE name = 'version'", "newer"), ["99"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
