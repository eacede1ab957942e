"""A fleet on loopback: servers, workers, and what may happen to each of them."""
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from fleet import Worker, make_recordings, outbox, computed, record_offline, write_fleet, write_site
from servers import Gate, Nats, Postgres, ask_nats, free_ports, make_certificates, tls_of_nats, until


class Fleet:
    """Servers, workers, and how each of them is hurt."""

    def __init__(self, command, folder, kind):
        self.command, self.folder, self.running = command, folder, []
        count = 3 if kind == "cluster" else 1
        ports = free_ports(2 * count + 2)
        self.nats_ports, routes, postgres_ports = ports[:count], ports[count:2 * count], ports[2 * count:]
        with_tls = kind == "single"
        if with_tls and not os.path.exists(os.path.join(folder, "authority.pem")):
            make_certificates(folder)
        self.postgres = self.started(Postgres(folder, postgres_ports[0], with_tls=with_tls))
        self.standby = None
        if kind == "cluster":
            self.standby = self.started(Postgres(folder, postgres_ports[1], "standby", self.postgres))
            self.postgres.ask("ALTER SYSTEM SET synchronous_standby_names = 'standby'")
            self.postgres.ask("SELECT pg_reload_conf()")
            until(lambda: self.postgres.ask("SELECT sync_state FROM pg_stat_replication") == ["sync"], 60, "a standby")
        else:
            postgres_ports = postgres_ports[:1]
        write_fleet(folder, self.nats_ports, postgres_ports, count, with_login=kind == "single")
        self.rights, self.user = "", None
        if kind == "single":  # with the accounts that --setup prints, and one more user who may do all
            printed = self.setup().stdout
            self.rights = printed[printed.index("accounts {"):printed.index("# postgresql.conf")].replace(
                "users: [\n", 'users: [\n      { user: "test", password: "test" }\n', 1)
            self.user = "test"
            self.rights += tls_of_nats(folder)
        self.nats = [self.started(Nats(folder, port, k, routes if count > 1 else (), self.rights))
                     for k, port in enumerate(self.nats_ports)]
        self.gates = [self.started(Gate(port)) for port in self.nats_ports]
        self.workers, self.begun = [], 0

    def started(self, one):
        self.running.append(one)
        return one

    def servers(self):
        """As the site reaches them."""
        return "nats://" + ",".join(f"127.0.0.1:{gate.port}" for gate in self.gates)

    def setup(self):
        done = []

        def made():
            done.append(subprocess.run([self.command, "fleet", "--setup", "fleet.toml"], cwd=self.folder, text=True,
                                       capture_output=True))
            return done[-1].returncode == 0
        until(made, 90, lambda: f"a fleet that is set up: {done[-1].stderr}")
        if not self.postgres.ask("SELECT 1 FROM pg_roles WHERE rolname = 'worker_1'"):
            self.postgres.ask("CREATE ROLE worker_1 LOGIN IN ROLE spoolflow_worker")
            self.postgres.ask("CREATE ROLE secret LOGIN PASSWORD 'secret' IN ROLE spoolflow_worker")
        return done[-1]

    def start_worker(self):
        worker = Worker(self.command, self.folder, f"worker_{self.begun}")
        self.begun += 1
        self.workers.append(self.started(worker))

    def show_logs(self):
        """What workers and NATS servers have to say, and how the fleet looks."""
        status = subprocess.run([self.command, "fleet", "--status", "fleet.toml"], cwd=self.folder, text=True,
                                capture_output=True)
        print(status.returncode, status.stdout, status.stderr, flush=True)
        logs = {worker.name: worker.log for worker in self.workers}
        logs |= {os.path.basename(server.folder): os.path.join(server.folder, "log") for server in self.nats}
        for name, file in logs.items():
            with open(file, encoding="utf-8", errors="replace") as log:
                print(f"{name}:\n{log.read()[-6000:]}", flush=True)

    def stop(self):
        for one in reversed(self.running):
            one.stop()

    # What may happen to it, each with the state in which blocks go on.

    def kill_worker_and_start_it_again(self, chance):
        worker = chance.choice(self.workers)
        worker.kill()
        worker.start()

    def kill_worker_and_start_another(self, chance):
        worker = self.workers.pop(chance.randrange(len(self.workers)))
        worker.kill()
        self.start_worker()

    def stop_worker_until_others_have_its_valves(self, chance):
        worker = chance.choice(self.workers)
        worker.signal(signal.SIGSTOP)
        owned = f"SELECT count(*) FROM partition WHERE owner LIKE '{worker.name}-%'"
        until(lambda: self.postgres.ask(owned) == ["0"], 90, "partitions that were taken over")
        worker.signal(signal.SIGCONT)

    def kill_nats(self, chance):
        server = chance.choice(self.nats)
        server.kill()
        time.sleep(chance.uniform(0, 1))
        server.start()

    def delete_the_stream(self, _):
        # A cluster may be without a leader for a while, and one that has deleted it may fail before it confirms.
        def deleted():
            said = ask_nats(self.nats_ports[0], "$JS.API.STREAM.DELETE.spoolflow", self.user)
            return '"success":true' in said or "stream not found" in said
        until(deleted, 90, "a stream that is deleted")

    def cut_the_site_off(self, chance):
        for gate in self.gates:
            gate.close()
        time.sleep(chance.uniform(1, 3))
        for gate in self.gates:
            gate.open = True

    def complain_to_the_site(self, _):
        """As a server does of what it cannot read: behind these words libnats closes a connection for good."""
        for gate in self.gates:
            gate.say(b"-ERR 'Unknown Protocol Operation'\r\n")

    def kill_postgres(self, _):
        self.postgres.kill()
        if self.standby:
            self.standby.promote()
            self.postgres, self.standby = self.standby, None
        else:
            self.postgres.restart()

    def start_another_worker(self, _):
        self.start_worker()


class WithAFleet(unittest.TestCase):
    """A folder of its own, and the fleet that a test starts in it, ended behind the test."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="spoolflow-fleet-")
        os.chmod(self.folder, 0o755)
        self.fleet = None

    def tearDown(self):
        if self.fleet:
            self.fleet.stop()
        shutil.rmtree(self.folder)

    def blocks_that_wait(self, command, reference, model, valves, seconds):
        """How many a site keeps that worked while no server was there, and what one process makes of them."""
        make_recordings(command, self.folder, seconds)
        write_site(self.folder, model, valves, 0.1)
        record_offline(command, self.folder, "nats://127.0.0.1:1", valves, 1000 * seconds, 120)
        return outbox(self.folder)[0], computed(command, reference, self.folder, model)
