"""A running `spoolflow live` for tests: its site, its certificate, its page."""
import http.client
import json
import os
import re
import signal
import ssl
import subprocess
import threading


def certificate(folder):
    """A self-signed certificate for 127.0.0.1 with its key; returns their names in the folder."""
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                    "-keyout", "key.pem", "-out", "certificate.pem", "-days", "2", "-subj", "/CN=localhost", "-addext",
                    "subjectAltName=DNS:localhost,IP:127.0.0.1"], cwd=folder, check=True, capture_output=True)
    os.chmod(os.path.join(folder, "key.pem"), 0o600)
    return "certificate.pem", "key.pem"


class Live:
    """The program, from its first answer to its end."""

    def __init__(self, command, folder, *arguments):
        self.process = subprocess.Popen([command, "live", *arguments], cwd=folder, stderr=subprocess.PIPE, text=True)
        self.said = []
        self.port = None
        for line in self.process.stderr:
            self.said.append(line)
            page = re.search(r"page at (https?)://\S+?:(\d+)/", line)
            if page:
                self.encrypted, self.port = page[1] == "https", int(page[2])
                break
        assert self.port, "".join(self.said)
        # A full pipe would hold the program.
        self.listener = threading.Thread(target=lambda: self.said.extend(self.process.stderr), daemon=True)
        self.listener.start()

    def heard(self):
        """What it said at standard error."""
        return "".join(self.said)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.process.send_signal(signal.SIGTERM)
        assert self.process.wait(timeout=60) == 0
        self.listener.join(60)
        self.process.stderr.close()

    def ask(self, path, method="GET", body=None, headers=None, trust=None):
        """Status, headers and text of one request, with `trust` as the only trusted certificate."""
        if self.encrypted:
            context = ssl.create_default_context(cafile=trust)
            connection = http.client.HTTPSConnection("127.0.0.1", self.port, timeout=30, context=context)
        else:
            connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        connection.request(method, path, body=None if body is None else json.dumps(body), headers=headers or {})
        answer = connection.getresponse()
        text = answer.read().decode()
        connection.close()
        return answer.status, dict(answer.getheaders()), text
