#!/usr/bin/python3
"""set_aside_test.py COMMAND EXAMPLES: a site that sends blocks nobody can keep, among those of sound valves of the same partition. The sound ones are
committed; the others lie in a table with the reason, counted, named in the worker's log, and hold nothing up."""
import ctypes
import hashlib
import os
import struct
import subprocess
import sys
import time
import unittest
import zlib

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from block_reader import ZSTD  # noqa: E402
from servers import connected_to_nats, heard, until  # noqa: E402
from whole_fleet import Fleet, WithAFleet  # noqa: E402

COMMAND, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:3])
PARTITION, NOW_MS = 3, 1_790_000_000_000
NAN = float("nan")


def packed(content):
    """One zstd frame."""
    out = ctypes.create_string_buffer(len(content) + 1000)
    size = ZSTD.ZSTD_compress(out, ctypes.c_size_t(len(out)), content, ctypes.c_size_t(len(content)), 3)
    return out.raw[:size]


def report(samples=1000, energy=0.5, events=()):
    """The body of addons/live/blocks/block.hpp, version 2."""
    body = struct.pack("<Q7dI", 1000, 7, 1e-5, 2e-5, 3e-5, NAN, 4e-5, 0.1, 0) + struct.pack("<QdI", samples, energy, 0)
    body += struct.pack("<I", len(events))
    for text in events:
        body += struct.pack("<qd", NOW_MS, 7) + struct.pack("<I", 6) + b"source" + struct.pack("<I", len(text)) + text
    return body + struct.pack("<I", 0)


def block(valve, number, model, body, wall_ms=NOW_MS):
    head = struct.pack("<4sBBHQQQqqqIIQ", b"SFBL", 2, len(valve), 0, 1, number, number, wall_ms, 0, 0, 0, len(body), 0)
    whole = head + bytes.fromhex(model) + valve + packed(body)
    return whole + struct.pack("<I", zlib.crc32(whole))


def samples(valve, number, model, count):
    """So many samples of nothing."""
    body = bytes(count)
    head = struct.pack("<4sBBHQQQqqqIIQ", b"SFBL", 1, len(valve), 0, 1, number, number, NOW_MS, 0, 0, count, len(body), 0)
    whole = head + bytes.fromhex(model) + valve + packed(body)
    return whole + struct.pack("<I", zlib.crc32(whole))


def named(form, partition=PARTITION):
    """A valve of that partition; `form` with a number in it."""
    return next(name for name in (form % k for k in range(1000)) if zlib.crc32(name) % 16 == partition)


class SetAside(WithAFleet):
    def publish(self, subject, *messages):
        with connected_to_nats(self.fleet.nats_ports[0], "hall", "") as raw:
            raw.sendall(b"".join(b"PUB %s %d\r\n%s\r\n" % (subject, len(one), one) for one in messages) + b"PING\r\n")
            said = heard(raw, lambda got: b"PONG" in got or b"-ERR" in got)
            self.assertNotIn(b"-ERR", said)

    def send(self, *blocks):
        self.publish(b"spoolflow.block.%d.hall" % PARTITION, *blocks)

    def covered(self, valve):
        return self.fleet.postgres.ask(f"SELECT block FROM coverage JOIN valve ON valve = number WHERE id = '{valve.decode()}'")

    def numbers(self, valve):
        return self.fleet.postgres.ask(f"SELECT block FROM second JOIN valve ON valve = number WHERE id = '{valve.decode()}' ORDER BY 1")

    def test_a_valve_whose_first_block_is_missing_does_not_fill_the_memory(self):
        fleet = self.fleet = Fleet(COMMAND, self.folder, "single")
        fleet.setup()
        fleet.start_worker()
        with open(os.path.join(EXAMPLES, "live", "size_6.json"), "rb") as file:
            text = file.read()
        model = hashlib.sha256(text).hexdigest()
        sound, gap = named(b"hall/sound_%d"), named(b"hall/gap_%d")
        until(lambda: fleet.postgres.ask("SELECT owner IS NULL FROM partition WHERE number = 3") == ["f"], 20, "a partition with an owner")
        process = fleet.workers[0].process.pid
        self.send(*(samples(gap, number, model, 32768) for number in range(2, 250)), block(sound, 1, model, report()))

        def known():
            self.publish(b"spoolflow.model.hall", model.encode() + packed(text))
            time.sleep(0.5)
            return self.covered(sound) == ["1"]
        until(known, 60, "a block of another valve")
        with open(f"/proc/{process}/status", encoding="utf-8") as file:
            largest_kB = next(int(line.split()[1]) for line in file if line.startswith("VmHWM"))
        self.assertLess(largest_kB, 350_000)  # all of them are 710 MB
        self.send(samples(gap, 1, model, 32768))
        until(lambda: self.covered(gap) and int(self.covered(gap)[0]) > 10, 60, "the blocks that were kept, behind the first")

    def test_a_model_on_its_way_into_the_store_costs_no_block(self):
        """One partition keeps the model, which all of them share in memory; the store takes its time for it."""
        fleet = self.fleet = Fleet(COMMAND, self.folder, "single")
        fleet.setup()
        fleet.postgres.ask("CREATE FUNCTION slow() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN PERFORM pg_sleep(2); RETURN NEW; "
                           "END $$; CREATE TRIGGER slow BEFORE INSERT ON model FOR EACH ROW EXECUTE FUNCTION slow()")
        fleet.start_worker()
        with open(os.path.join(EXAMPLES, "live", "size_6.json"), "rb") as file:
            text = file.read()
        model = hashlib.sha256(text).hexdigest()
        valves = [(partition, named(b"hall/v%d", partition)) for partition in range(4)]
        until(lambda: fleet.postgres.ask("SELECT count(*) FROM partition WHERE owner IS NULL") == ["0"], 20, "a worker")

        def known():
            for partition, valve in valves:
                self.publish(b"spoolflow.block.%d.hall" % partition, block(valve, 1, model, report()))
            self.publish(b"spoolflow.model.hall", model.encode() + packed(text))
            time.sleep(0.5)
            return fleet.postgres.ask("SELECT count(*) FROM coverage") == ["4"]
        until(known, 60, "a block of each valve")
        self.assertEqual([self.numbers(valve) for _, valve in valves], [["1"]] * 4)
        self.assertEqual(fleet.postgres.ask("SELECT count(*) FROM set_aside"), ["0"])

    def test_blocks_that_nobody_can_keep_hold_up_no_other(self):
        fleet = self.fleet = Fleet(COMMAND, self.folder, "single")
        fleet.setup()
        fleet.postgres.ask("ALTER TABLE event ADD CONSTRAINT sound CHECK (text <> 'poison')")  # what no check of the program knows
        fleet.start_worker()
        with open(os.path.join(EXAMPLES, "live", "size_6.json"), "rb") as file:
            text = file.read()
        model = hashlib.sha256(text).hexdigest()
        sound, refused, wrong = named(b"hall/sound_%d"), named(b"hall/refused_%d"), named(b"hall/wrong_%d")
        self.send(block(sound, 1, model, report()))

        def known():
            self.publish(b"spoolflow.model.hall", model.encode() + packed(text))
            return self.covered(sound) == ["1"]
        until(known, 30, "a block of a sound valve")
        bad = [block(named(b"hall/\xff%d"), 1, model, report()), block(named(b"hall/a\0b%d"), 1, model, report()),
               block(named(b"hall/two words%d"), 1, model, report()), block(named(b"hall/\x1b[31m%d"), 1, model, report()),
               block(named(b"hall/late_%d"), 1, model, report(), wall_ms=2**62),
               block(named(b"hall/early_%d"), 1, model, report(), wall_ms=-1)]
        poisoned = [block(refused, 2, model, report(events=(b"seen", b"poison"))), block(refused, 3, model, report())]
        self.send(*bad, block(wrong, 1, model, report(energy=NAN)), block(wrong, 2, model, report()),
                  block(refused, 1, model, report()), *poisoned, block(sound, 2, model, report()), *bad)
        until(lambda: (self.covered(sound), self.covered(wrong)) == (["2"], ["2"]), 30, "sound blocks behind those that are set aside")

        def passed():
            self.send(*poisoned)  # as a site sends what is not covered
            time.sleep(0.5)
            return self.covered(refused) == ["3"]
        until(passed, 30, "a sound block behind one that the store refuses")
        self.assertEqual((self.numbers(sound), self.numbers(wrong), self.numbers(refused)), (["1", "2"], ["2"], ["1", "3"]))
        self.assertEqual(fleet.postgres.ask("SELECT count(*) FROM valve"), ["3"])
        for valve, number, reason in ((wrong, 1, "without sense"), (refused, 2, "refused by the store")):
            events = fleet.postgres.ask(f"SELECT text FROM event WHERE valve = '{valve.decode()}' AND text LIKE '%set aside%'")
            self.assertEqual(len(events), 1, events)
            self.assertIn(f"block {number} is set aside: it is {reason}", events[0])

        rows = fleet.postgres.ask("SELECT encode(content, 'hex'), times, valve, block FROM set_aside WHERE partition = 3 ORDER BY number")
        self.assertEqual([row.split("|")[0] for row in rows[:len(bad)]], [one.hex() for one in bad])
        self.assertEqual([row.split("|")[1] for row in rows[:len(bad)]], ["2"] * len(bad))
        self.assertEqual([row.split("|")[2:] for row in rows[len(bad):]], [[wrong.decode(), "1"], [refused.decode(), "2"]])
        self.assertGreaterEqual(int(fleet.postgres.ask("SELECT set_aside FROM partition WHERE number = 3")[0]), 2 * len(bad) + 2)
        status = subprocess.run([COMMAND, "fleet", "--status", "fleet.toml"], cwd=self.folder, text=True, capture_output=True, check=True)
        self.assertRegex(status.stdout, r"\d+ blocks are set aside; see the table set_aside")
        fleet.workers[0].end()
        with open(fleet.workers[0].log, "rb") as file:
            log = file.read()
        self.assertIn(b"partition 3: a block of %s, number 2 (subject spoolflow.block.3.hall, stream sequence" % refused, log)
        self.assertIn(b"it is of a valve whose name is not SITE/ID", log)
        self.assertFalse(set(log) - set(range(0x20, 0x7f)) - {0x0a}, log)  # nothing of a name reaches the terminal


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
