"""NATS and PostgreSQL servers from Debian's packages on loopback, with ports and folders of their own."""
import glob
import os
import pwd
import shutil
import signal
import socket
import ssl
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "live", "tests"))
from ports import free_ports  # noqa: E402, F401: for those who import it from here


def until(condition, seconds, what):
    """`what` is awaited: words, or what gives them in the end."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"not within {seconds} s: {what() if callable(what) else what}")
        time.sleep(0.05)


def begins(process, answers_now, what, log):
    """Until it answers; at once where it has ended, with its last words."""
    until(lambda: answers_now() or process.poll() is not None, 60, what)
    if process.poll() is not None:
        with open(log, encoding="utf-8", errors="replace") as file:
            raise AssertionError(f"{what}: it ended with {process.returncode}: {file.read()[-2000:]}")


def answers(port):
    try:
        socket.create_connection(("127.0.0.1", port), 1).close()
        return True
    except OSError:
        return False


def make_certificates(folder):
    """An authority of our own, a server's certificate by it for 127.0.0.1, and an authority that signed nothing."""
    def openssl(*arguments):
        subprocess.run(["openssl", *arguments], cwd=folder, check=True, capture_output=True)
    new = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes")
    for name in ("authority", "stranger"):
        openssl("req", "-x509", *new, "-keyout", f"{name}.key", "-out", f"{name}.pem", "-days", "2", "-subj", f"/CN={name}",
                "-addext", "keyUsage=critical,keyCertSign,cRLSign")
    openssl("req", *new, "-keyout", "server.key", "-out", "server.csr", "-subj", "/CN=127.0.0.1")
    with open(os.path.join(folder, "names"), "w", encoding="utf-8") as file:
        file.write("subjectAltName = IP:127.0.0.1\n")
    openssl("x509", "-req", "-in", "server.csr", "-CA", "authority.pem", "-CAkey", "authority.key", "-CAcreateserial",
            "-days", "2", "-extfile", "names", "-out", "server.pem")


def tls_of_nats(folder):
    return f'tls {{ cert_file: "{folder}/server.pem", key_file: "{folder}/server.key", timeout: 60 }}\n'


PASSWORDS = {f"PASSWORD_{user}": user for user in ("worker", "hall", "yard", "system")}


class Nats:
    """One server, or one of a cluster: `number` counts from 0, `routes` are the cluster ports of all. `accounts`: who may
    do what, as --setup prints it; passwords are the users' names. `room`: for streams, whatever the disk has."""

    def __init__(self, folder, port, number=0, routes=(), accounts="", room="64GB"):
        self.port, self.process = port, None
        self.folder = os.path.join(folder, f"nats_{number}")
        os.makedirs(self.folder)
        self.configuration = os.path.join(self.folder, "nats.conf")
        with open(self.configuration, "w", encoding="utf-8") as file:
            file.write(f'server_name: "n{number}"\nlisten: "127.0.0.1:{port}"\nmax_payload: 1MB\n'
                       f'jetstream {{ store_dir: "{self.folder}/store", max_file_store: {room} }}\n{accounts}')
            if routes:
                all_routes = ", ".join(f'"nats://127.0.0.1:{route}"' for route in routes)
                file.write(f'cluster {{ name: "fleet", listen: "127.0.0.1:{routes[number]}", routes: [{all_routes}] }}\n')
        self.start()

    def start(self):
        with open(os.path.join(self.folder, "log"), "a", encoding="utf-8") as log:
            self.process = subprocess.Popen(["nats-server", "-c", self.configuration], stdout=log, stderr=log,
                                            env={**os.environ, **PASSWORDS})
        begins(self.process, lambda: answers(self.port), "a NATS server that answers", os.path.join(self.folder, "log"))

    def kill(self):
        self.process.kill()
        self.process.wait()

    def stop(self):
        if self.process.poll() is None:
            self.kill()


def as_postgres(arguments):
    """The server refuses to be root's."""
    return ["runuser", "-u", "postgres", "--", *arguments] if os.geteuid() == 0 else arguments


class Postgres:
    """A primary, or a standby of `primary`."""

    BIN = sorted(glob.glob("/usr/lib/postgresql/*/bin"))[-1]

    def __init__(self, folder, port, name="primary", primary=None, with_tls=False):
        self.port, self.name, self.process = port, name, None
        top = os.path.join(folder, name)
        os.makedirs(top)
        self.data, self.log = os.path.join(top, "data"), os.path.join(top, "log")
        if os.geteuid() == 0:
            shutil.chown(top, "postgres", pwd.getpwnam("postgres").pw_gid)
        if primary is None:
            self.tool("initdb", "-A", "trust", "-U", "postgres", "--no-sync", "-D", self.data)
            self.settings = {"max_connections": 100, "fsync": "on", "wal_level": "replica"}
            if with_tls:
                self.let_in_by_tls(folder)
        else:
            self.tool("pg_basebackup", "-h", "127.0.0.1", "-p", str(primary.port), "-U", "postgres", "-D", self.data,
                      "-R", "-X", "stream", "-c", "fast", "--no-sync",
                      "-d", f"host=127.0.0.1 port={primary.port} user=postgres application_name={name}")
            self.settings = {"max_connections": 100}
        self.start()

    def let_in_by_tls(self, folder):
        """Others than the owner by TLS alone, and one of them with a password."""
        for name in ("server.pem", "server.key"):
            to = os.path.join(self.data, name)
            shutil.copy(os.path.join(folder, name), to)
            os.chmod(to, 0o600)
            if os.geteuid() == 0:
                shutil.chown(to, "postgres", pwd.getpwnam("postgres").pw_gid)
        self.settings.update(ssl="on", ssl_cert_file="server.pem", ssl_key_file="server.key")
        rules = os.path.join(self.data, "pg_hba.conf")
        with open(rules, encoding="utf-8") as file:
            others = file.read()
        with open(rules, "w", encoding="utf-8") as file:
            file.write("hostssl all secret all scram-sha-256\nhost all postgres all trust\nhostssl all all all trust\n"
                       "host all all all reject\n" + others)

    def tool(self, name, *arguments):
        subprocess.run(as_postgres([os.path.join(self.BIN, name), *arguments]), check=True, capture_output=True,
                       cwd="/")

    def start(self):
        options = [f"-c{key}={value}" for key, value in self.settings.items()]
        with open(self.log + ".out", "a", encoding="utf-8") as log:
            # exec: the process that is started is the server itself
            self.process = subprocess.Popen(
                as_postgres([os.path.join(self.BIN, "postgres"), "-D", self.data, "-p", str(self.port), "-h",
                             "127.0.0.1", "-k", os.path.dirname(self.data), *options]), stdout=log, stderr=log, cwd="/")
        begins(self.process, self.ready, f"a PostgreSQL {self.name} that answers", self.log + ".out")

    def ready(self):
        return subprocess.run([os.path.join(self.BIN, "pg_isready"), "-q", "-h", "127.0.0.1", "-p", str(self.port)],
                              check=False).returncode == 0

    def postmaster(self):
        with open(os.path.join(self.data, "postmaster.pid"), encoding="utf-8") as file:
            return int(file.readline())

    def kill(self):
        """kill -9 of the server; what it leaves behind ends by itself."""
        os.kill(self.postmaster(), signal.SIGKILL)
        self.process.wait()
        until(lambda: not answers(self.port), 60, "a PostgreSQL server that is gone")

    def restart(self):
        for _ in range(100):  # its last processes may still hold its memory
            try:
                os.remove(os.path.join(self.data, "postmaster.pid"))
            except FileNotFoundError:
                pass
            try:
                self.start()
                return
            except AssertionError as failure:
                reason = failure
                time.sleep(0.2)
        raise AssertionError("a PostgreSQL server that was killed does not start again") from reason

    def promote(self):
        self.tool("pg_ctl", "promote", "-D", self.data)

    def stop(self):
        if self.process.poll() is None:
            try:
                os.kill(self.postmaster(), signal.SIGINT)
                self.process.wait(30)
            except (OSError, subprocess.TimeoutExpired):
                self.process.kill()

    def ask(self, sql, database="postgres"):
        done = subprocess.run([os.path.join(self.BIN, "psql"), "-X", "-h", "127.0.0.1", "-p", str(self.port), "-U",
                               "postgres", "-d", database, "-qAt", "-F", "|", "-v", "ON_ERROR_STOP=1", "-1", "-f", "-"]
                              if len(sql) > 100_000 else  # longer than an argument may be
                              [os.path.join(self.BIN, "psql"), "-X", "-h", "127.0.0.1", "-p", str(self.port), "-U",
                               "postgres", "-d", database, "-At", "-F", "|", "-c", sql], text=True, capture_output=True,
                              input=sql if len(sql) > 100_000 else "", check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stderr)
        return done.stdout.splitlines()


class Gate:
    """A way to a server that can be closed: what went through it is cut off, and nothing else gets through."""

    def __init__(self, to):
        self.to, self.open, self.pairs = to, True, []
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.let_in, daemon=True).start()

    def let_in(self):
        while True:
            try:
                inner, _ = self.listener.accept()
            except OSError:
                return
            try:
                if not self.open:
                    raise OSError
                outer = socket.create_connection(("127.0.0.1", self.to), 2)
            except OSError:
                inner.close()
                continue
            outer.settimeout(None)
            self.pairs.append((inner, outer))
            threading.Thread(target=self.join, args=(inner, outer), daemon=True).start()

    def join(self, inner, outer):
        """Both ways, until either end is closed."""
        with inner, outer:
            back = threading.Thread(target=self.carry, args=(outer, inner), daemon=True)
            back.start()
            self.carry(inner, outer)
            back.join()

    @staticmethod
    def carry(source, sink):
        try:
            while piece := source.recv(65536):
                sink.sendall(piece)
        except OSError:
            pass
        for one in (source, sink):
            try:
                one.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def close(self):
        self.open = False
        for pair in self.pairs:
            for one in pair:
                try:
                    one.shutdown(socket.SHUT_RDWR)
                except OSError:
                    pass
        self.pairs.clear()

    def say(self, words):
        """To all who came through, as if the server said it."""
        for inner, _ in self.pairs:
            try:
                inner.sendall(words)
            except OSError:
                pass

    def stop(self):
        self.close()
        self.listener.close()


def connected_to_nats(port, user, lines):
    """A connection by the NATS protocol, logged in, to which `lines` were sent."""
    raw = socket.create_connection(("127.0.0.1", port), 30)
    greeting = b""
    while not greeting.endswith(b"\r\n"):
        letter = raw.recv(1)
        if not letter:
            raise ConnectionError(f"the server at {port} ended the connection behind {greeting!r}")
        greeting += letter
    if b'"tls_required":true' in greeting:
        context = ssl.create_default_context()
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
        raw = context.wrap_socket(raw)
    login = f', "user": "{user}", "pass": "{user}"' if user else ""
    raw.sendall(f'CONNECT {{"verbose": false, "pedantic": false{login}}}\r\n{lines}'.encode())
    return raw


def heard(raw, enough):
    """What a connection says until it is enough, or until it ends."""
    got = b""
    while not enough(got):
        piece = raw.recv(65536)
        if not piece:
            break
        got += piece
    return got


def ask_nats(port, subject, user=None):
    """One request without content; what came back, "" where nothing did."""
    def answered(got):
        return b"MSG answer" in got and got.endswith(b"}\r\n")
    try:
        with connected_to_nats(port, user, f"SUB answer 1\r\nPUB {subject} answer 0\r\n\r\n") as raw:
            got = heard(raw, answered)
    except OSError:
        return ""
    return got.split(b"\r\n")[-2].decode() if answered(got) else ""


def refused_by_nats(port, user, line):
    """Whether the server says that the user may not do so."""
    with connected_to_nats(port, user, f"{line}\r\nPING\r\n") as raw:
        return b"Violation" in heard(raw, lambda got: b"PONG" in got or b"-ERR" in got)
