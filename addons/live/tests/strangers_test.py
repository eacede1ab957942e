#!/usr/bin/python3
"""strangers_test.py COMMAND EXAMPLES: the page with TLS and accounts, met by other programs over TLS: who is let in,
who is not, and what a start without certificate or account says."""
import json
import os
import shutil
import socket
import ssl
import struct
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from served import Live, certificate  # noqa: E402

COMMAND, EXAMPLES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
PASSWORD = "correct horse battery"


def account(*arguments, password=None):
    """What `spoolflow account` prints, and what it says."""
    done = subprocess.run([COMMAND, "account", *arguments], input=password and password + "\n", text=True,
                          capture_output=True)
    return done.returncode, done.stdout, done.stderr


class Strangers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="spoolflow-strangers-")
        shutil.copy(os.path.join(EXAMPLES, "live", "size_6.json"), os.path.join(cls.folder, "model.json"))
        certificate(cls.folder)
        cls.trust = os.path.join(cls.folder, "certificate.pem")
        status, cls.anna, _ = account("anna", "--role", "acknowledge", password=PASSWORD)
        assert status == 0
        status, cls.eve, said = account("eve", "--token")
        assert status == 0
        cls.token = said.strip().rsplit(" ", 1)[1]
        # No sample comes to the valve of UDP: an alarm to acknowledge.
        cls.valves = ('[sources]\nudp = "127.0.0.1:0"\n[alarms]\nraised_after_s = 0\n[[valve]]\nid = "v"\n'
                      'model = "model.json"\nsource = { kind = "udp" }\n[[valve]]\nid = "r"\nmodel = "model.json"\n'
                      'source = { kind = "rig" }\n')
        cls.page = '[page]\nlisten = "0.0.0.0:0"\ncertificate = "certificate.pem"\nkey = "key.pem"\n'
        cls.write("site.toml", cls.page + cls.anna + cls.eve + cls.valves)
        cls.live = Live(COMMAND, cls.folder, "site.toml", "--store", "site.sqlite")

    @classmethod
    def tearDownClass(cls):
        cls.live.__exit__()
        shutil.rmtree(cls.folder)

    @classmethod
    def write(cls, name, text):
        with open(os.path.join(cls.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def ask(self, *arguments, **options):
        return self.live.ask(*arguments, trust=self.trust, **options)

    def bearer(self, token=None):
        return {"Authorization": f"Bearer {token or self.token}"}

    def origin(self):
        return f"https://127.0.0.1:{self.live.port}"

    def login(self, password=PASSWORD):
        return self.ask("/api/v1/login", "POST", {"name": "anna", "password": password}, {"Origin": self.origin()})

    def test_speaks_tls_1_2_and_1_3_and_nothing_older(self):
        self.assertTrue(self.live.encrypted)
        for version in (ssl.TLSVersion.TLSv1_2, ssl.TLSVersion.TLSv1_3):
            context = ssl.create_default_context(cafile=self.trust)
            context.minimum_version = context.maximum_version = version
            with socket.create_connection(("127.0.0.1", self.live.port)) as raw:
                with context.wrap_socket(raw, server_hostname="localhost") as tls:
                    self.assertIn(tls.version(), ("TLSv1.2", "TLSv1.3"))
        old = subprocess.run(["openssl", "s_client", "-connect", f"127.0.0.1:{self.live.port}", "-tls1_1", "-cipher",
                              "ALL:@SECLEVEL=0"], input="", text=True, capture_output=True)
        self.assertNotEqual(old.returncode, 0)

    def test_plain_http_gets_no_answer(self):
        with socket.create_connection(("127.0.0.1", self.live.port)) as raw:
            raw.sendall(b"GET /api/v1/valves HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
            raw.settimeout(30)
            try:
                self.assertNotIn(b"HTTP/1.1", raw.recv(4096))
            except ConnectionResetError:
                pass

    def test_without_account_there_is_the_page_alone(self):
        status, headers, text = self.ask("/")
        self.assertEqual(status, 200)
        self.assertIn("max-age", headers["Strict-Transport-Security"])
        self.assertNotIn("\"v\"", text)
        for path in ("/api/v1/valves", "/api/v1/events", "/api/v1/alarms", "/api/v1/site", "/metrics",
                     "/api/v1/valves/v/indicators", "/api/v1/recordings"):
            self.assertEqual(self.ask(path)[0], 401, path)
        for act in ("acknowledge", "shelve", "unshelve", "comment"):
            self.assertEqual(self.ask(f"/api/v1/alarms/1/{act}", "POST")[0], 401, act)
        self.assertEqual(self.ask("/metrics", headers=self.bearer("eve.wrong"))[0], 401)

    def test_a_token_reads_and_does_not_acknowledge(self):
        status, _, text = self.ask("/metrics", headers=self.bearer())
        self.assertEqual(status, 200)
        self.assertIn('spoolflow_stalled{valve="v"} 1', text)
        begin = time.monotonic()
        for _ in range(20):
            self.assertEqual(self.ask("/metrics", headers=self.bearer())[0], 200)
        self.assertLess(time.monotonic() - begin, 20)  # its hash is computed once
        for act, body in (("acknowledge", {}), ("shelve", {"hours": 1}), ("unshelve", {}), ("comment", {"text": "seen"})):
            self.assertEqual(self.ask(f"/api/v1/alarms/1/{act}", "POST", body, self.bearer())[0], 403, act)

    def test_a_password_opens_a_session_that_acknowledges_on_its_own_page(self):
        status, headers, text = self.login()
        self.assertEqual(status, 200, text)
        self.assertEqual(json.loads(text), {"account": "anna", "role": "acknowledge", "accounts": True})
        cookie = headers["Set-Cookie"]
        for part in ("__Host-spoolflow=", "Secure", "HttpOnly", "SameSite=Strict", "Path=/"):
            self.assertIn(part, cookie)
        session = {"Cookie": cookie.split(";")[0]}
        alarms = []
        for _ in range(100):
            alarms = json.loads(self.ask("/api/v1/alarms", headers=session)[2])["alarms"]
            if alarms:
                break
            time.sleep(0.1)
        self.assertEqual((alarms[0]["valve"], alarms[0]["cause"]), ("v", "no_samples"))
        path = f"/api/v1/alarms/{alarms[0]['id']}/acknowledge"
        for origin in ({}, {"Origin": "https://evil.example"}, {"Origin": "null"}):
            self.assertEqual(self.ask(path, "POST", headers={**session, **origin})[0], 403, origin)
        self.assertIsNone(json.loads(self.ask("/api/v1/alarms", headers=session)[2])["alarms"][0]["acknowledged"])
        status, _, text = self.ask(path, "POST", headers={**session, "Origin": self.origin()})
        self.assertEqual(status, 200)
        self.assertEqual(json.loads(text)["acknowledged_by"], "anna")
        path = path.replace("acknowledge", "comment")
        status, _, text = self.ask(path, "POST", {"text": "seen"}, {**session, "Origin": self.origin()})
        self.assertEqual([(one["by"], one["text"]) for one in json.loads(text)["comments"]], [("anna", "seen")])
        self.ask("/api/v1/logout", "POST", headers={**session, "Origin": self.origin()})
        self.assertEqual(self.ask("/api/v1/valves", headers=session)[0], 401)

    def upgrade(self, headers):
        """The first line of the answer to a WebSocket that is asked for, and the first bytes behind its header."""
        context = ssl.create_default_context(cafile=self.trust)
        with socket.create_connection(("127.0.0.1", self.live.port)) as raw:
            with context.wrap_socket(raw, server_hostname="127.0.0.1") as tls:
                lines = ["GET /api/v1/valves/r/stream HTTP/1.1", f"Host: 127.0.0.1:{self.live.port}",
                         "Connection: Upgrade", "Upgrade: websocket", "Sec-WebSocket-Version: 13",
                         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==", *headers]
                tls.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
                tls.settimeout(30)
                got = b""
                while b"\r\n\r\n" not in got or (b" 101 " in got and len(got.split(b"\r\n\r\n", 1)[1]) < 40):
                    more = tls.recv(4096)
                    if not more:
                        break
                    got += more
                head, _, rest = got.partition(b"\r\n\r\n")
                return head.split(b"\r\n")[0].decode(), rest

    def test_plots_come_to_those_who_may_read(self):
        self.assertIn(" 401 ", self.upgrade([])[0])
        self.assertIn(" 403 ", self.upgrade([f"Authorization: Bearer {self.token}", "Origin: https://evil.example"])[0])
        line, rest = self.upgrade([f"Authorization: Bearer {self.token}"])
        self.assertIn(" 101 ", line)
        self.assertEqual(rest[0] & 0x0F, 2)  # the begin of a binary message
        begin = {126: 4, 127: 10}.get(rest[1] & 0x7F, 2)
        self.assertEqual(struct.unpack_from("<I", rest, begin)[0], 1)  # of version 1

    def test_wrong_passwords_are_held_back(self):
        # From an address of its own, so that the other tests go on.
        context = ssl.create_default_context(cafile=self.trust)
        statuses = []
        for _ in range(8):
            with socket.create_connection(("127.0.0.1", self.live.port), source_address=("127.0.0.7", 0)) as raw:
                with context.wrap_socket(raw, server_hostname="127.0.0.1") as tls:
                    body = json.dumps({"name": "anna", "password": "guess"})
                    tls.sendall((f"POST /api/v1/login HTTP/1.1\r\nHost: 127.0.0.1:{self.live.port}\r\nOrigin: "
                                 f"{self.origin()}\r\nConnection: close\r\nContent-Length: {len(body)}\r\n\r\n{body}")
                                .encode())
                    tls.settimeout(30)
                    statuses.append(int(tls.recv(4096).split()[1]))
        self.assertEqual(statuses, [401] * 5 + [429] * 3)
        self.assertEqual(self.login()[0], 200)

    def test_accounts_and_certificate_are_read_again_when_their_files_change(self):
        folder = tempfile.mkdtemp(prefix="spoolflow-strangers-")
        try:
            certificate(folder)
            old = os.path.join(folder, "old.pem")
            shutil.copy(os.path.join(folder, "certificate.pem"), old)
            shutil.copy(os.path.join(self.folder, "model.json"), folder)
            site = os.path.join(folder, "site.toml")

            def write(accounts):
                with open(site, "w", encoding="utf-8") as file:
                    file.write(self.page + accounts + self.valves)

            write(self.eve)
            with Live(COMMAND, folder, "site.toml") as live:
                def status(trust=old):
                    return live.ask("/api/v1/site", headers=self.bearer(), trust=trust)[0]

                def until(true):
                    for _ in range(300):
                        if true():
                            return
                        time.sleep(0.1)
                    self.fail(live.heard())

                self.assertEqual(status(), 200)
                def read_again(times):  # not by trying: wrong tokens are held back
                    until(lambda: live.heard().count("were read again") == times)

                write(self.anna)
                read_again(1)
                self.assertEqual(status(), 401)
                write(self.eve + "role = \n")
                until(lambda: "of before stay in force" in live.heard())
                self.assertEqual(status(), 401)
                write(self.eve)
                read_again(2)
                self.assertEqual(status(), 200)
                # Not both files fit each other: the old ones stay.
                with open(os.path.join(folder, "key.pem"), "w", encoding="utf-8") as key:
                    key.write("no key")
                until(lambda: "is no key of the certificate" in live.heard())
                self.assertEqual(status(), 200)
                certificate(folder)

                def is_new():
                    try:
                        return status(os.path.join(folder, "certificate.pem")) == 200
                    except ssl.SSLError:
                        return False
                until(is_new)
                with self.assertRaises(ssl.SSLError):
                    status()
        finally:
            shutil.rmtree(folder)

    def refused(self, site):
        self.write("other.toml", site)
        done = subprocess.run([COMMAND, "live", "other.toml"], cwd=self.folder, text=True, capture_output=True,
                              timeout=60)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_does_not_start_without_certificate_or_account(self):
        self.assertIn("a certificate and an account is missing", self.refused('[page]\nlisten = "0.0.0.0:0"\n' + self.valves))
        self.assertIn("and an account is missing", self.refused(self.page + self.valves))
        self.assertIn("and a certificate is missing",
                      self.refused('[page]\nlisten = "0.0.0.0:0"\n' + self.anna + self.valves))
        self.write("no.pem", "nothing")
        os.chmod(os.path.join(self.folder, "no.pem"), 0o600)
        for key in ("no.pem", "missing.pem"):
            self.assertIn("is no key of the certificate",
                          self.refused(self.page.replace("key.pem", key) + self.anna + self.valves))
        self.assertIn("no certificate can be read",
                      self.refused(self.page.replace("certificate.pem", "no.pem") + self.anna + self.valves))
        shutil.copy(os.path.join(self.folder, "key.pem"), os.path.join(self.folder, "open.pem"))
        os.chmod(os.path.join(self.folder, "open.pem"), 0o644)
        self.assertIn("chmod 600", self.refused(self.page.replace("key.pem", "open.pem") + self.anna + self.valves))

    def test_accounts_are_made_with_hashes(self):
        self.assertNotIn(PASSWORD, self.anna)
        self.assertIn('secret = "$scrypt$ln=15,r=8,p=1$', self.anna)
        self.assertNotIn(self.token.split(".")[1], self.eve)
        for arguments, password, what in ((["anna"], "short", "it must have 10 to 256"),
                                          (["an na"], PASSWORD, "letters, digits"),
                                          (["anna", "--role", "admin"], PASSWORD, "--role is read or acknowledge")):
            status, out, said = account(*arguments, password=password)
            self.assertEqual((status, out), (2, ""))
            self.assertIn(what, said)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
