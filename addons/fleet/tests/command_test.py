#!/usr/bin/python3
"""command_test.py COMMAND EXAMPLES: what the fleet's commands say to files and servers that cannot be used, and how they
end."""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

COMMAND, EXAMPLES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
NATS = '[nats]\nservers = "nats://127.0.0.1:1"\n'
AWAY = '[postgresql]\nconnection = "host=127.0.0.1 port=1 user=w dbname=f"\n'


class Commands(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="spoolflow-fleet-command-")
        shutil.copy(os.path.join(EXAMPLES, "live", "size_6.json"), os.path.join(self.folder, "model.json"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def said(self, status, *arguments, **files):
        for name, text in files.items():
            with open(os.path.join(self.folder, f"{name}.toml"), "w", encoding="utf-8") as file:
                file.write(text)
        done = subprocess.run([COMMAND, *arguments], cwd=self.folder, text=True, capture_output=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (status, "", 1), done.stderr)
        return done.stderr

    def test_refuses_files_that_cannot_be_used(self):
        self.assertIn("cannot be opened", self.said(2, "worker", "none.toml"))
        self.assertIn("has no [nats]", self.said(2, "worker", "f.toml", f=AWAY))
        self.assertIn("workers", self.said(2, "worker", "f.toml", f=NATS + AWAY + "[workers]\n"))
        self.assertIn("written wrongly", self.said(2, "worker", "f.toml", f=NATS + '[postgresql]\nconnection = "hos=a"\n'))
        self.assertIn("no.creds", self.said(2, "worker", "f.toml", f=NATS + 'credentials = "no.creds"\n' + AWAY))
        self.assertIn("--setup and --status", self.said(2, "fleet", "--setup", "--status", "f.toml", f=NATS + AWAY))
        self.assertIn("needs TLS", self.said(2, "fleet", "f.toml", "--listen", "0.0.0.0:0", f=NATS + AWAY))
        self.assertIn("cannot be reached", self.said(1, "fleet", "f.toml", f=NATS + AWAY))
        self.assertIn("cannot be reached", self.said(1, "fleet", "--status", "f.toml", f=NATS + AWAY))

    def test_publishing_needs_a_store_a_name_and_servers(self):
        valve = '[[valve]]\nid = "v"\nmodel = "model.json"\nsource = { kind = "rig" }\n'
        live = ("live", "s.toml", "--publish", "nats://127.0.0.1:1")
        self.assertIn("needs a store", self.said(2, *live, s=valve))
        self.assertIn("needs the site's name", self.said(2, *live, "--store", "s.sqlite", s=valve))
        self.assertIn("no NATS servers", self.said(2, "live", "s.toml", "--publish", "ftp://a", s=valve))
        self.assertIn("sevrers", self.said(2, "live", "s.toml", s=valve + '[fleet]\nsite = "h"\nsevrers = "a"\n'))

    def test_a_worker_waits_for_its_servers_and_ends_on_a_signal(self):
        with open(os.path.join(self.folder, "f.toml"), "w", encoding="utf-8") as file:
            file.write(NATS + AWAY)
        for number in (signal.SIGINT, signal.SIGTERM):
            worker = subprocess.Popen([COMMAND, "worker", "f.toml"], cwd=self.folder, text=True, stderr=subprocess.PIPE)
            self.addCleanup(worker.kill)
            first = worker.stderr.readline()
            self.assertIn("cannot be reached", first)
            self.assertIn("end with Ctrl-C", worker.stderr.readline())
            worker.send_signal(number)
            self.assertEqual(worker.wait(30), 0)
            worker.stderr.close()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
