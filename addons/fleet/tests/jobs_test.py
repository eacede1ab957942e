#!/usr/bin/python3
"""jobs_test.py COMMAND EXAMPLES: batch work by the workers of a fleet gives the bytes that one machine gives, whatever is
killed meanwhile, and the messages of one machine where an input cannot be used."""
import hashlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from servers import Nats, Postgres, free_ports, until  # noqa: E402

COMMAND, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:3])
MODEL = os.path.join(EXAMPLES, "live", "size_6.json")
SCENARIO = '[monte_carlo]\ntrials = 100\n[map]\npositions = 2\npressure_differences = 2\n[study]\nbase_samples = 4\nrun_s = 4\ngiven_model = true\n'


def running(pid):
    """Whether it still works: not gone, and not waited for alone."""
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


class Jobs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="spoolflow-fleet-jobs-")
        os.chmod(cls.folder, 0o755)
        cls.workers, cls.servers = [], []
        cls.addClassCleanup(cls.clean)
        nats_port, postgres_port = free_ports(2)
        cls.postgres = Postgres(cls.folder, postgres_port)
        cls.servers += [cls.postgres, Nats(cls.folder, nats_port)]
        for name, user in (("owner", "postgres"), ("worker", "worker_1"), ("batch", "engineer_1")):
            cls.write(f"{name}.toml", f'[nats]\nservers = "nats://127.0.0.1:{nats_port}"\n[postgresql]\nconnection = '
                      f'"host=127.0.0.1 port={postgres_port} user={user} dbname=postgres"\n[worker]\nlease_s = 2\n'
                      '[jobs]\nprocesses = 1\nlargest_MB = 20\n')
        subprocess.run([COMMAND, "fleet", "--setup", "owner.toml"], cwd=cls.folder, check=True, capture_output=True)
        cls.postgres.ask("CREATE ROLE worker_1 LOGIN IN ROLE spoolflow_worker; "
                         "CREATE ROLE engineer_1 LOGIN IN ROLE spoolflow_batch")
        cls.make_inputs()

    @classmethod
    def make_inputs(cls):
        shutil.copy(MODEL, os.path.join(cls.folder, "model.json"))
        cls.write("scenario.toml", SCENARIO)
        os.makedirs(os.path.join(cls.folder, "runs"))
        cls.write("duty.toml", 'protocol = "duty_cycle"\nvalve = "size_6"\nseed = 3\n')
        subprocess.run([COMMAND, "simulate", "-q", "duty.toml", "-o", "duty.csv"], cwd=cls.folder, check=True)
        with open(os.path.join(cls.folder, "duty.csv"), encoding="utf-8") as file:
            header, *rows = file.readlines()
        for k, name in enumerate(("monday", "tuesday", "wednesday", "thursday")):
            cls.write(f"runs/{name}.csv", "".join([header, *rows[9000 * k:9000 * (k + 1)]]))

    @classmethod
    def write(cls, name, text):
        with open(os.path.join(cls.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    @classmethod
    def clean(cls):
        cls.stop_workers()
        for server in cls.servers:
            server.stop()
        shutil.rmtree(cls.folder)

    @classmethod
    def stop_workers(cls):
        for worker in cls.workers:
            worker.kill()
            worker.wait()
        cls.workers.clear()

    @classmethod
    def start_worker(cls):
        with open(os.path.join(cls.folder, "worker.log"), "a", encoding="utf-8") as log:
            cls.workers.append(subprocess.Popen([COMMAND, "worker", "worker.toml"], cwd=cls.folder, stderr=log))

    def setUp(self):
        self.stop_workers()
        self.postgres.ask("DELETE FROM job; DELETE FROM worker")

    def run_here(self, *arguments, status=0):
        done = subprocess.run([COMMAND, *arguments], cwd=self.folder, text=True, capture_output=True, timeout=120,
                              env={**os.environ, "SOURCE_DATE_EPOCH": "1700000000"})
        self.assertEqual(done.returncode, status, done.stderr + self.worker_log())
        return done

    def worker_log(self):
        with open(os.path.join(self.folder, "worker.log"), "a+", encoding="utf-8") as log:
            log.seek(0)
            return "\nworkers: " + log.read()[-2000:]

    def begin(self, *arguments):
        return subprocess.Popen([COMMAND, *arguments], cwd=self.folder, text=True, stderr=subprocess.PIPE,
                                stdout=subprocess.DEVNULL)

    def states(self):
        return {line.split("|")[0]: int(line.split("|")[1])
                for line in self.postgres.ask("SELECT state, count(*) FROM job GROUP BY state")}

    def same(self, *names):
        """What was written here, and with --fleet under the same name below `far`."""
        for name in names:
            with open(os.path.join(self.folder, "near", name), "rb") as near, \
                    open(os.path.join(self.folder, "far", name), "rb") as far:
                self.assertEqual(near.read(), far.read(), name)

    def folders(self):
        for name in ("near", "far"):
            shutil.rmtree(os.path.join(self.folder, name), ignore_errors=True)
            os.makedirs(os.path.join(self.folder, name))

    def test_a_study_survives_its_workers_and_its_command(self):
        self.folders()
        study = ("analyse", "-q", "model.json", "--scenario", "scenario.toml")
        here = self.run_here(*study, "--json", "near/a.json", "--report", "near/a.html")
        for _ in range(2):
            self.start_worker()
        fleet = (*study, "--fleet", "batch.toml", "--json", "far/a.json", "--report", "far/a.html")
        command = self.begin(*fleet)
        until(lambda: self.states().get("running", 0) == 2, 30, "two pieces that two workers are at")
        self.workers[0].kill()
        command.kill()
        command.communicate()
        self.workers[0].wait()
        self.assertFalse(os.path.exists(os.path.join(self.folder, "far", "a.json")))
        again = self.run_here(*fleet)
        self.assertEqual(again.stdout, here.stdout)
        self.same("a.json", "a.html")
        self.assertEqual(list(self.states()), ["done"])
        self.assertIn("2", self.postgres.ask("SELECT attempts FROM job"))
        status = self.run_here("fleet", "--status", "owner.toml").stdout
        self.assertIn(f"jobs: 0 open, 0 running, {sum(self.states().values())} done, 0 failed, 0 given up", status)
        # A third time nothing is done again, even without a worker.
        self.stop_workers()
        self.run_here(*fleet)
        self.same("a.json")

    def test_recordings_are_estimated_elsewhere(self):
        self.folders()
        runs = [f"runs/{name}.csv" for name in ("monday", "tuesday", "wednesday", "thursday")]
        here = self.run_here("estimate", "model.json", *runs, "-o", "near/e", "--json", "near/e.json")
        self.start_worker()
        self.start_worker()
        fleet = self.run_here("estimate", "model.json", *runs, "-o", "far/e", "--json", "far/e.json", "--fleet",
                              "batch.toml")
        self.assertEqual(fleet.stderr, here.stderr)
        self.same("e.json", *(f"e/{os.path.basename(run)}" for run in runs))
        self.assertEqual(self.states(), {"done": 4})

    def test_an_environment_widens_the_band_elsewhere_as_here(self):
        self.folders()
        self.write("line.toml", "[environment]\nposition_zero_um = 50\n")
        self.start_worker()
        for k, environment in enumerate(("machine", "line.toml")):
            for place, by in (("near", ()), ("far", ("--fleet", "batch.toml"))):
                self.run_here("estimate", "model.json", "runs/monday.csv", "-o", f"{place}/e{k}.csv", "--environment", environment,
                              *by)
        self.same("e0.csv", "e1.csv")
        with open(os.path.join(self.folder, "far", "e0.csv"), "rb") as machine, \
                open(os.path.join(self.folder, "far", "e1.csv"), "rb") as line:
            self.assertNotEqual(machine.read(), line.read())

    def test_a_bad_recording_gives_the_message_of_the_command_alone(self):
        self.folders()
        with open(os.path.join(self.folder, "runs", "monday.csv"), encoding="utf-8") as file:
            lines = file.readlines()[:2000]
        lines[1500] = "1.5,none,of,these,is,a,number" + "," * (lines[0].count(",") - 6) + "\n"
        self.write("runs/bad.csv", "".join(lines))
        command = ("estimate", "model.json", "runs/bad.csv", "runs/tuesday.csv", "runs/absent.csv")
        here = self.run_here(*command, "-o", "near", status=2)
        self.start_worker()
        there = self.run_here(*command, "-o", "far", "--fleet", "batch.toml", status=2)
        self.assertEqual(sorted(there.stderr.splitlines()), sorted(here.stderr.splitlines()))
        self.assertIn("runs/bad.csv", there.stderr)
        self.same("tuesday.csv")
        monitor = ("monitor", "model.json", "runs/tuesday.csv", "runs/bad.csv")
        self.assertEqual(self.run_here(*monitor, "--fleet", "batch.toml", status=2).stderr,
                         self.run_here(*monitor, status=2).stderr)

    def test_the_condition_of_a_valve(self):
        self.folders()
        monitor = ("monitor", "model.json", "runs/monday.csv", "runs/tuesday.csv", "runs/wednesday.csv")
        here = self.run_here(*monitor, "--json", "near/m.json", "--report", "near/m.html")
        self.start_worker()
        there = self.run_here(*monitor, "--json", "far/m.json", "--report", "far/m.html", "--fleet", "batch.toml")
        self.assertEqual(there.stdout, here.stdout)
        self.same("m.json", "m.html")
        # One recording more: those before are known.
        self.run_here(*monitor, "runs/thursday.csv", "--json", "far/m.json", "--fleet", "batch.toml")
        self.run_here(*monitor, "runs/thursday.csv", "--json", "near/m.json")
        self.same("m.json")
        self.assertEqual(self.states(), {"done": 4})

    def test_several_campaigns(self):
        self.folders()
        for name in ("one", "two"):
            shutil.copytree(os.path.join(EXAMPLES, "valve_a"), os.path.join(self.folder, name))
        with open(os.path.join(self.folder, "two", "campaign.toml"), encoding="utf-8") as file:
            text = file.read()
        self.write("two/campaign.toml", text.replace("spring.h5", "absent.h5"))
        command = ("calibrate", "-q", "one/campaign.toml", "two/campaign.toml")
        here = self.run_here(*command, "-o", "near", "--report", "near", status=2)
        self.start_worker()
        there = self.run_here(*command, "-o", "far", "--report", "far", "--fleet", "batch.toml", status=2)
        self.assertEqual(sorted(there.stderr.splitlines()), sorted(here.stderr.splitlines()))
        self.assertIn("absent.h5", here.stderr)
        self.same("one.json", "one.html")
        self.assertEqual(os.listdir(os.path.join(self.folder, "far")).count("two.json"), 0)

    def test_says_that_nobody_works(self):
        command = self.begin("estimate", "model.json", "runs/monday.csv", "-o", "alone.csv", "--fleet", "batch.toml")
        self.assertIn("no worker has asked for work for 10 s", command.stderr.readline())
        self.start_worker()
        command.communicate(timeout=60)
        self.assertEqual(command.returncode, 0)

    def test_a_piece_that_ends_its_process_is_given_up(self):
        self.start_worker()
        command = self.begin("analyse", "-q", "model.json", "--scenario", "scenario.toml", "--fleet", "batch.toml",
                             "--json", "given_up.json")
        killed = set()
        while len(killed) < 3 and command.poll() is None:
            for folder in os.listdir(tempfile.gettempdir()):
                if not folder.startswith(f"spoolflow-piece-{self.workers[0].pid}-"):
                    continue
                asked = subprocess.run(["pgrep", "-P", str(self.workers[0].pid)], text=True, capture_output=True, check=False)
                for pid in map(int, asked.stdout.split()):
                    if pid not in killed and running(pid):
                        os.kill(pid, signal.SIGKILL)
                        killed.add(pid)
            time.sleep(0.02)
        said = command.communicate(timeout=60)[1]
        self.assertEqual(command.returncode, 1, said)
        self.assertIn("ended its worker 3 times and is given up", said)
        self.assertEqual(self.states().get("given_up"), 1)

    def test_rights_and_limits(self):
        """A login that asks for work writes no result and reads nothing else of the fleet; a worker changes no table."""
        def refused(role, sql):
            with self.assertRaisesRegex(RuntimeError, "permission denied|must be owner"):
                self.postgres.ask(f"SET ROLE {role}; {sql}")
        for sql in ("UPDATE job SET outcome = 'none'", "DELETE FROM job", "SELECT * FROM valve", "DELETE FROM content_chunk",
                    "INSERT INTO job(key, kind, program, manifest, outcome) VALUES('a', 'b', 'c', 'd', 'e')"):
            refused("spoolflow_batch", sql)
        for sql in ("DROP TABLE job", "UPDATE job SET manifest = 'none'", "UPDATE content_chunk SET packed = ''"):
            refused("spoolflow_worker", sql)
        refused("spoolflow_reader", "SELECT * FROM content_chunk")
        with open(os.path.join(self.folder, "batch.toml"), encoding="utf-8") as file:
            self.write("small.toml", file.read().replace("largest_MB = 20", "largest_MB = 1"))
        self.write("runs/large.csv", open(os.path.join(self.folder, "duty.csv"), encoding="utf-8").read() * 3)
        said = self.run_here("estimate", "model.json", "runs/large.csv", "-o", "far.csv", "--fleet", "small.toml", status=2)
        self.assertIn("may have 1 MB", said.stderr)

    def test_old_results_and_contents_are_removed(self):
        sha256 = hashlib.sha256(b"old").hexdigest()
        self.postgres.ask(f"INSERT INTO content(sha256, bytes, came) VALUES('{sha256}', 3, now() - interval '2 hours'); "
                          "INSERT INTO job(key, kind, program, manifest, wanted, state) VALUES('aa', 'estimate', 'none', "
                          "'', now() - interval '8 days', 'done'), ('bb', 'estimate', 'none', '', now(), 'done')")
        self.start_worker()
        until(lambda: self.postgres.ask("SELECT key FROM job") == ["bb"], 20, "an old result that is removed")
        until(lambda: self.postgres.ask(f"SELECT 1 FROM content WHERE sha256 = '{sha256}'") == [], 20, "its file likewise")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
