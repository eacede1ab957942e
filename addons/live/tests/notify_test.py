#!/usr/bin/python3
"""notify_test.py COMMAND EXAMPLES: messages of alarms at a webhook behind TLS and at a mail server with STARTTLS and login
(aiosmtpd): one a burst, tried again while the receiver fails, none of shelved alarms, comments and shelves after a new start."""
import email
import email.policy
import http.server
import json
import os
import shutil
import socket
import ssl
import sys
import tempfile
import threading
import time

from aiosmtpd.controller import Controller
from aiosmtpd.smtp import SMTP, AuthResult

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from ports import free_ports  # noqa: E402
from served import Live, certificate  # noqa: E402

command, examples = map(os.path.abspath, sys.argv[1:3])
folder = tempfile.mkdtemp(prefix="spoolflow-notify-")
TOKEN, PASSWORD = "token-that-nobody-prints", "password-that-nobody-prints"


def until(what, true, seconds=60):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = true()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError(f"{what} never came")


class Hook(http.server.BaseHTTPRequestHandler):
    got, tries, fails = [], 0, 2

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        Hook.tries += 1
        good = self.headers["Authorization"] == f"Bearer {TOKEN}" and self.path == "/hook"
        self.send_response(503 if Hook.tries <= Hook.fails else 204 if good else 401)
        self.send_header("Content-Length", "0")
        self.end_headers()
        if good and Hook.tries > Hook.fails:
            Hook.got.append(json.loads(body))

    def log_message(self, *_):
        pass


def news(*fields):
    """Of each message what it says of silent valves; what else a valve without sound samples raises is left out."""
    reported = [[tuple(one[field] for field in fields) for one in message["alarms"] if one["cause"] == "no_samples"] for message in Hook.got]
    return [one for one in reported if one]


class Letters:
    got = []

    async def handle_DATA(self, server, session, envelope):
        Letters.got.append((session.ssl is not None, envelope.mail_from, envelope.rcpt_tos,
                            email.message_from_bytes(envelope.content, policy=email.policy.default)))
        return "250 taken"


class MailServer(Controller):
    def factory(self):
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(os.path.join(folder, "certificate.pem"), os.path.join(folder, "key.pem"))
        return SMTP(self.handler, tls_context=context, require_starttls=True, auth_required=True, authenticator=lambda _, __, ___, kind, given:
                    AuthResult(success=(given.login, given.password) == (b"hall", PASSWORD.encode())))


class Sender:
    """Samples of one valve over TCP, until it is closed."""

    def __init__(self, port):
        self.line = socket.create_connection(("127.0.0.1", port))
        self.line.sendall(b"time_s,current_A,position_mm,oil_temperature_C\n")
        self.ends = threading.Event()
        threading.Thread(target=self.run, daemon=True).start()

    def run(self):
        at = 0
        while not self.ends.wait(0.02):
            at += 1
            self.line.sendall(f"{0.02 * at:.2f},0.3,0.1,40\n".encode())
        self.line.close()


try:
    shutil.copy(os.path.join(examples, "live", "size_6.json"), os.path.join(folder, "model.json"))
    certificate(folder)
    with open(os.path.join(folder, "token"), "w", encoding="utf-8") as file:
        file.write(TOKEN + "\n")
    os.environ["SPOOLFLOW_TEST_PASSWORD"] = PASSWORD
    os.environ["no_proxy"] = "127.0.0.1"
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(os.path.join(folder, "certificate.pem"), os.path.join(folder, "key.pem"))
    hook = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Hook)
    hook.socket = context.wrap_socket(hook.socket, server_side=True)
    threading.Thread(target=hook.serve_forever, daemon=True).start()
    mail_port, = free_ports(1)
    letters = MailServer(Letters(), hostname="127.0.0.1", port=mail_port)
    letters.start()
    silent = socket.create_server(("127.0.0.1", 0))  # takes connections and never answers
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write('[page]\nlisten = "127.0.0.1:0"\n[store]\nfile = "site.sqlite"\n[alarms]\nraised_after_s = 0.5\ngone_after_s = 0.5\n'
                   f'[[notify]]\nwebhook = "https://127.0.0.1:{hook.server_port}/hook"\ntoken_file = "token"\n'
                   'authority = "certificate.pem"\nleast_priority = "C"\ngather_s = 2\nretry_s = 0.3\n'
                   f'[[notify]]\nmail = "smtp://127.0.0.1:{mail_port}"\nfrom = "live@example.org"\n'
                   'to = ["anna@example.org", "bert@example.org"]\nuser = "hall"\n'
                   'password_environment = "SPOOLFLOW_TEST_PASSWORD"\nauthority = "certificate.pem"\ngather_s = 2\n'
                   f'[[notify]]\nwebhook = "https://127.0.0.1:{hook.server_port}/failures"\nleast_priority = "F"\n'
                   'gather_s = 0.1\nauthority = "certificate.pem"\n'
                   f'[[notify]]\nwebhook = "http://127.0.0.1:{silent.getsockname()[1]}/"\ngather_s = 0.1\n'
                   + "".join(f'[[valve]]\nid = "{name}"\nmodel = "model.json"\nsource = {{ kind = "tcp", listen = "127.0.0.1:0" }}\n'
                             for name in ("press_1", "press_2", "press_3"))
                   + '[[valve]]\nid = "rig"\nmodel = "model.json"\nsource = { kind = "rig" }\n')
    with Live(command, folder, "site.toml") as live:
        def asked(path, body=None):
            own = {"Origin": f"http://127.0.0.1:{live.port}", "Content-Type": "application/json"}
            status, _, text = live.ask(path, "GET" if body is None else "POST", body=body, headers=own)
            assert status == 200, (path, status, text)
            return json.loads(text)

        # three valves fall silent: one message of each, behind two failures of the webhook
        first = until("the webhook's message", lambda: Hook.got)[0]
        assert sorted((one["valve"], one["change"], one["cause"], one["ne107"]) for one in first["alarms"]) == [
            (f"press_{k}", "raised", "no_samples", "C") for k in (1, 2, 3)], first
        assert first["text"].endswith("(function check)") and ": 3 alarms raised: no samples at press_" in first["text"], first["text"]
        assert first["alarms"][0]["remedy"].startswith("Check ") and first["left_out"] == 0
        encrypted, sender, to, letter = until("mail", lambda: Letters.got)[0]
        assert encrypted and sender == "live@example.org" and to == ["anna@example.org", "bert@example.org"]
        assert letter["Subject"] == first["text"] and letter["Auto-Submitted"] == "auto-generated"
        said = letter.get_content()
        assert said.count("No samples arrive") == 3 and "raised: no samples at press_2" in said, said
        def events_of_way_out():  # the last follows the receiver's answer, which this test has seen on the other side
            texts = [one["text"] for one in asked("/api/v1/events")["events"]]
            return texts if any("go out again" in one for one in texts) else None

        events = until("the event of messages that go out again", events_of_way_out)
        failed = [one for one in events if one.startswith("webhook at 127.0.0.1: no message")]
        assert len(failed) == 1 and "it answers with status 503" in failed[0], events

        # a receiver that never answers holds up nothing
        outputs = asked("/api/v1/site")["outputs"]
        assert outputs["notify_1"]["sent"] == 1 and outputs["notify_1"]["trouble"] == "" and outputs["notify_4"]["sent"] == 0, outputs
        rig = asked("/api/v1/valves/rig")
        assert rig["source"]["age_s"] < 1 and rig["source"]["dropped"] == 0, rig["source"]

        # press_1 is shelved with a comment: what it does is no news, that of press_2 is, in one message each
        alarms = {one["valve"]: one for one in asked("/api/v1/alarms")["alarms"] if one["cause"] == "no_samples"}
        number = alarms["press_1"]["id"]
        shelved = asked(f"/api/v1/alarms/{number}/shelve", {"hours": 1})
        assert shelved["state"] == "shelved" and shelved["shelved_by"] == "local" and shelved["shelved_until"], shelved
        asked(f"/api/v1/alarms/{number}/comment", {"text": " the cable is on its way\n"})
        for order, body in (("shelve", {"hours": 1000}), ("shelve", {}), ("comment", {"text": "  "}), ("comment", {"text": "x" * 501})):
            own = {"Origin": f"http://127.0.0.1:{live.port}"}
            assert live.ask(f"/api/v1/alarms/{number}/{order}", "POST", body=body, headers=own)[0] == 400, (order, body)
        ports = {one["id"]: one["source"].get("port") for one in asked("/api/v1/valves")["valves"]}
        senders = [Sender(ports[name]) for name in ("press_1", "press_2")]
        until("the second message", lambda: news("valve")[1:])
        for one in senders:
            one.ends.set()
        until("the third message", lambda: news("valve")[2:])
        assert news("valve", "change")[1:] == [[("press_2", "gone")], [("press_2", "raised again")]], Hook.got
        times = {one["valve"]: one["times"] for one in asked("/api/v1/alarms")["alarms"] if one["cause"] == "no_samples"}
        assert times["press_1"] == 2, times  # it was followed, on the shelf

    # a new start sends nothing again; shelf and comment are there; at the end of its time the alarm comes back
    with Live(command, folder, "site.toml") as live:
        again, = (one for one in asked("/api/v1/alarms")["alarms"] if one["id"] == number)
        assert again["state"] == "shelved", again
        assert [(one["by"], one["text"]) for one in again["comments"]] == [("local", "the cable is on its way")], again
        asked(f"/api/v1/alarms/{number}/shelve", {"hours": 2 / 3600})
        until("the message of the alarm that comes back", lambda: news("valve")[3:])
        assert news("valve", "change", "state")[3:] == [[("press_1", "back from the shelf", "raised_unacknowledged")]], Hook.got
        heard = json.dumps(asked("/api/v1/events")) + json.dumps(asked("/api/v1/site")) + live.ask("/metrics")[2]
        assert 'spoolflow_alarms_shelved 0' in heard and TOKEN not in heard and PASSWORD not in heard
        assert TOKEN not in live.heard() and PASSWORD not in live.heard()

    # the webhook fails while press_2 falls silent, and the program is killed: the next start sends what was not sent
    live = Live(command, folder, "site.toml")
    before = len(news("valve"))
    sender = Sender({one["id"]: one["source"].get("port") for one in asked("/api/v1/valves")["valves"]}["press_2"])
    until("the message that press_2 is back", lambda: news("valve")[before:])
    Hook.tries, Hook.fails = 0, 10 ** 9
    sender.ends.set()
    until("a message that fails", lambda: Hook.tries > 1)
    time.sleep(1.5)  # a commit
    live.process.kill()
    live.process.wait()
    Hook.fails = 0
    with Live(command, folder, "site.toml") as live:
        until("the message of before", lambda: news("valve")[before + 1:])
        time.sleep(3)  # none comes twice
    assert news("valve", "change")[before:] == [[("press_2", "gone")], [("press_2", "raised again")]], Hook.got

    print(f"{len(Hook.got)} messages to the webhook, {len(Letters.got)} by mail")
finally:
    shutil.rmtree(folder)
