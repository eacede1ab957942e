#!/usr/bin/python3
"""page_test.py COMMAND: what the interface of `spoolflow fleet` answers about a thousand valves, who may acknowledge, and what
happens when the database goes away."""
import json
import os
import re
import socket
import ssl
import subprocess
import sys
import time
import unittest
import warnings
import urllib.error
import urllib.parse
import urllib.request

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import open_api  # noqa: E402
from servers import make_certificates, until  # noqa: E402
from synthetic_fleet import SyntheticFleet  # noqa: E402

COMMAND = os.path.abspath(sys.argv[1])
DOCS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "docs")
VALVES = int(sys.argv[2]) if len(sys.argv) > 2 else 2000


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.fleet = SyntheticFleet(COMMAND, VALVES)

    @classmethod
    def tearDownClass(cls):
        cls.fleet.stop()

    def ask(self, path, data=None, origin=None):
        request = urllib.request.Request(self.fleet.address + path, data=data)
        if origin:
            request.add_header("Origin", origin)
        try:
            with urllib.request.urlopen(request, timeout=30) as answer:
                return answer.status, answer.read().decode()
        except urllib.error.HTTPError as error:
            with error:
                return error.code, error.read().decode()

    def answer_of(self, path):
        status, body = self.ask(path)
        self.assertEqual(status, 200, body)
        return json.loads(body)

    def test_overview_and_search(self):
        begin = time.monotonic()
        valves = self.answer_of("/api/v1/valves")["valves"]
        print(f"{len(valves)} valves in {time.monotonic() - begin:.2f} s")
        self.assertEqual(len(valves), VALVES)
        sites = self.answer_of("/api/v1/sites")["sites"]
        self.assertEqual(sum(site["valves"] for site in sites), VALVES)
        self.assertEqual(sum(site["silent"] for site in sites), VALVES // 250)
        self.assertEqual(sum(site["alarms"] for site in sites), VALVES // 500)
        some = self.answer_of("/api/v1/valves?site=hall_03&search=VALVE_0000")["valves"]
        self.assertEqual([valve["id"] for valve in some], ["hall_03/valve_00003"])
        self.assertAlmostEqual(some[0]["flow_L_min"], 60000 * (2e-4 + 1e-4 * 0.1411200), places=3)
        self.assertEqual(self.answer_of("/api/v1/valves?search=%27%20OR%201=1")["valves"], [])
        self.fleet.postgres.ask("UPDATE partition SET set_aside = 7 WHERE number = 5")
        metrics = self.ask("/metrics")[1]
        self.assertIn(f'spoolflow_fleet_valves{{site="hall_00"}} {VALVES // 20}\n', metrics)
        self.assertIn('spoolflow_fleet_blocks_set_aside_total{partition="5"} 7\n', metrics)

    def test_names_the_valves_that_differ_from_their_sisters(self):
        series = self.answer_of("/api/v1/series")["series"]
        self.assertEqual([one["series"] for one in series], ["model aaaaaaaa", "model bbbbbbbb"])
        friction = {one["name"]: one for one in series[0]["indicators"]}["friction_ratio"]
        self.assertEqual(friction["valves"], VALVES // 2)
        self.assertAlmostEqual(friction["median"], 1, places=1)
        named = sorted(one["valve"] for one in friction["outliers"]["named"])
        self.assertEqual(named, [f"hall_00/valve_{k:05}" for k in range(1000, VALVES + 1, 1000)])
        self.assertTrue(all(one["outliers"]["count"] == 0 for one in series[1]["indicators"]))
        query = urllib.parse.urlencode({"series": "model aaaaaaaa", "indicator": "friction_ratio"},
                                       quote_via=urllib.parse.quote)
        self.assertEqual(sum(self.answer_of("/api/v1/distribution?" + query)["outlier"]), len(named))
        self.assertEqual(self.ask("/api/v1/distribution?series=none&indicator=none")[0], 404)

    def test_days_of_one_valve(self):
        flow = self.answer_of("/api/v1/valves/hall_01%2Fvalve_00001/history")
        self.assertEqual(flow["valve"], "hall_01/valve_00001")
        self.assertGreater(len(flow["time_ms"]), 20)
        indicators = self.answer_of("/api/v1/valves/hall_01/valve_00001/indicators")["indicators"]
        self.assertEqual(len(indicators), 10)
        self.assertEqual(indicators[0]["unit"], "1")
        self.assertEqual(self.ask("/api/v1/valves/hall_01%2Fnone/history")[0], 404)
        self.assertEqual(self.ask("/api/v1/valves/hall_01%2Fvalve_00001/history?from=2&to=1")[0], 400)
        self.assertEqual(len(self.answer_of("/api/v1/events?valve=hall_01/valve_00001")["events"]), 1)

    def test_acknowledges_in_the_database(self):
        alarms = self.answer_of("/api/v1/alarms")["alarms"]
        self.assertEqual(len(alarms), VALVES // 500)
        path = f"/api/v1/alarms/{alarms[0]['key']}/acknowledge"
        self.assertEqual(self.ask(path, b"{}", "http://evil.example")[0], 403)
        status, body = self.ask(path, b"{}", self.fleet.address)
        self.assertEqual((status, json.loads(body)["acknowledged_by"], json.loads(body)["state"]),
                         (200, "local", "raised_acknowledged"))
        again = json.loads(self.ask(path, b"{}")[1])
        self.assertEqual(again["acknowledged"], json.loads(body)["acknowledged"])
        self.assertEqual(self.fleet.postgres.ask("SELECT valve, alarm, name, taken_block FROM acknowledgement"),
                         [f"{alarms[0]['valve']}|1|local|"])
        for none, status in (("hall_00/none/1", 404), ("hall_00/1", 405), ("1", 405), ("a/b/c", 405), ("a/b/1%27", 405)):
            self.assertEqual(self.ask(f"/api/v1/alarms/{none}/acknowledge", b"{}")[0], status, none)

    def test_shelves_and_comments_in_the_database(self):
        before = self.answer_of("/api/v1/sites")["sites"]
        alarm = self.answer_of("/api/v1/alarms")["alarms"][-1]
        description = self.answer_of("/api/v1/openapi.json")

        def order(what, body):
            status, text = self.ask(f"/api/v1/alarms/{alarm['key']}/{what}", json.dumps(body).encode())
            if status != 200:
                return status
            found = json.loads(text)
            path = "/api/v1/alarms/{site}/{id}/{number}/" + what
            schema = description["paths"][path]["post"]["responses"]["200"]["content"]["application/json"]["schema"]
            self.assertEqual(open_api.violations(description, schema, found), [], what)
            return found

        for what, body in (("shelve", {}), ("shelve", {"hours": 1000}), ("comment", {"text": " "}), ("comment", {"text": "x" * 501})):
            self.assertEqual(order(what, body), 400, (what, body))
        shelved = order("shelve", {"hours": 8})
        self.assertEqual((shelved["state"], shelved["shelved_by"]), ("shelved", "local"))
        after = self.answer_of("/api/v1/sites")["sites"]
        self.assertEqual(sum(site["alarms"] for site in after), sum(site["alarms"] for site in before) - 1)
        self.assertEqual(order("comment", {"text": "a valve is on its way"})["comments"][-1]["text"], "a valve is on its way")
        listed, = (one for one in self.answer_of(f"/api/v1/alarms?valve={alarm['valve']}")["alarms"] if one["id"] == alarm["id"])
        self.assertEqual((listed["state"], [(one["by"], one["text"]) for one in listed["comments"]]),
                         ("shelved", [("local", "a valve is on its way")]))
        self.assertEqual(order("shelve", {"hours": 1 / 3600})["state"], "shelved")
        time.sleep(1.2)
        self.assertEqual(order("comment", {"text": "its time is over"})["state"], alarm["state"])
        order("shelve", {"hours": 8})
        self.assertEqual(order("unshelve", {})["state"], alarm["state"])
        self.assertEqual(self.answer_of("/api/v1/sites")["sites"], before)
        for k in range(101):
            order("comment", {"text": str(k)})
        self.assertEqual([one["text"] for one in order("comment", {"text": "last"})["comments"]], [*map(str, range(2, 101)), "last"])
        self.assertEqual(self.ask("/api/v1/alarms/hall_00/none/1/shelve", b'{"hours": 1}')[0], 404)
        self.assertEqual(self.ask(f"/api/v1/alarms/{alarm['key']}/shelve", b'{"hours": 1}', "http://evil.example")[0], 403)

    def test_every_path_answers_as_it_is_described(self):
        """And what is described is all that there is: docs/fleet.md lists no other, and unknown members are refused."""
        description = self.answer_of("/api/v1/openapi.json")
        with open(os.path.join(DOCS, "fleet_openapi.json"), encoding="utf-8") as file:
            self.assertEqual(description, json.load(file))
        asked = set()
        for path, methods in description["paths"].items():
            for parameter in methods.get("get", {}).get("parameters", []):
                parameter = open_api.resolved(description, parameter)
                if "example" not in parameter:
                    self.assertFalse(parameter.get("required"), (path, parameter))
                elif parameter["in"] == "path":
                    path = path.replace("{" + parameter["name"] + "}", parameter["example"])
                else:
                    path += ("&" if "?" in path else "?") + parameter["name"] + "=" + urllib.parse.quote(parameter["example"])
            if "get" not in methods:
                continue
            status, body = self.ask(path)
            self.assertEqual(status, 200, path)
            asked.add(path.split("?")[0])
            for media, content in methods["get"]["responses"]["200"]["content"].items():
                value = json.loads(body) if media == "application/json" else body
                self.assertEqual(open_api.violations(description, content["schema"], value), [], path)
                if isinstance(value, dict):  # what is looked at is there
                    self.assertTrue(all(value[name] for name in value if isinstance(value[name], list)), path)
        self.assertGreater(len(asked), 10)
        alarm = self.answer_of("/api/v1/alarms")["alarms"][-1]
        acknowledged = json.loads(self.ask(f"/api/v1/alarms/{alarm['key']}/acknowledge", b"{}")[1])
        schema = description["paths"]["/api/v1/alarms/{site}/{id}/{number}/acknowledge"]["post"]["responses"]["200"]
        self.assertEqual(open_api.violations(description, schema["content"]["application/json"]["schema"], acknowledged), [])
        self.assertNotEqual(open_api.violations(description, schema["content"]["application/json"]["schema"], {"id": "7"}), [])
        self.fleet.postgres.ask(f"DELETE FROM acknowledgement WHERE valve = '{alarm['valve']}'")

    def test_speaks_tls_to_those_with_an_account(self):
        make_certificates(self.fleet.folder)
        token = subprocess.run([COMMAND, "account", "dashboard", "--token"], text=True, capture_output=True, check=True)
        with open(os.path.join(self.fleet.folder, "page.toml"), encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(self.fleet.folder, "tls.toml"), "w", encoding="utf-8") as file:
            file.write(text + 'certificate = "server.pem"\nkey = "server.key"\n' + token.stdout)
        page = subprocess.Popen([COMMAND, "fleet", "tls.toml", "--listen", "0.0.0.0:0"], cwd=self.fleet.folder, text=True,
                                stderr=subprocess.PIPE)
        try:
            port = int(page.stderr.readline().split("page at https://")[1].split(":")[1].split("/")[0])
            address = f"https://127.0.0.1:{port}/api/v1/valves"
            known, stranger = (ssl.create_default_context(cafile=os.path.join(self.fleet.folder, f"{name}.pem"))
                               for name in ("authority", "stranger"))
            bearer = {"Authorization": "Bearer " + re.search(r"dashboard\.\S+", token.stderr).group(0)}

            def status(context, headers):
                try:
                    with urllib.request.urlopen(urllib.request.Request(address, headers=headers), context=context,
                                                timeout=30) as answer:
                        self.assertEqual(len(json.loads(answer.read())["valves"]), VALVES)
                        return answer.status
                except urllib.error.HTTPError as error:
                    with error:
                        return error.code
            self.assertEqual(status(known, bearer), 200)
            self.assertEqual(status(known, {}), 401)
            self.assertEqual(status(known, {"Authorization": "Bearer dashboard.wrong"}), 401)
            with self.assertRaisesRegex(urllib.error.URLError, "CERTIFICATE_VERIFY_FAILED"):
                status(stranger, bearer)
            old = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
            old.load_verify_locations(os.path.join(self.fleet.folder, "authority.pem"))
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                old.maximum_version = ssl.TLSVersion.TLSv1_1
            with self.assertRaises(urllib.error.URLError):
                status(old, bearer)
            with socket.create_connection(("127.0.0.1", port), 10) as plain:  # no answer without TLS
                plain.sendall(b"GET /api/v1/valves HTTP/1.1\r\nHost: localhost\r\n\r\n")
                plain.settimeout(30)
                try:
                    self.assertNotIn(b"hall_", plain.recv(65536))
                except OSError:
                    pass
            # Another account instead: read while it runs.
            other = subprocess.run([COMMAND, "account", "auditor", "--token"], text=True, capture_output=True, check=True)
            with open(os.path.join(self.fleet.folder, "tls.toml"), "w", encoding="utf-8") as file:
                file.write(text + 'certificate = "server.pem"\nkey = "server.key"\n' + other.stdout)
            while "were read again" not in (line := page.stderr.readline()):
                self.assertNotEqual(line, "", "the page has ended")
            self.assertEqual(status(known, bearer), 401)
            bearer = {"Authorization": "Bearer " + re.search(r"auditor\.\S+", other.stderr).group(0)}
            self.assertEqual(status(known, bearer), 200)
        finally:
            page.terminate()
            self.assertEqual(page.wait(30), 0)
            page.stderr.close()

    def test_z_says_that_the_database_is_away_and_comes_back(self):
        self.fleet.postgres.kill()
        until(lambda: self.ask("/api/v1/alarms")[0] == 503, 20, "a page that reports it")
        self.assertIn("PostgreSQL", self.ask("/api/v1/alarms")[1])
        self.fleet.postgres.restart()
        until(lambda: self.ask("/api/v1/alarms")[0] == 200, 20, "a page that is back")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
