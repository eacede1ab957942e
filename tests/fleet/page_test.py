#!/usr/bin/python3
"""page_test.py COMMAND: what the interface of `spoolflow fleet` tells of a thousand valves, who may acknowledge, and what
happens when the database goes away."""
import json
import os
import sys
import time
import unittest
import urllib.error
import urllib.parse
import urllib.request

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from servers import until  # noqa: E402
from synthetic_fleet import SyntheticFleet  # noqa: E402

COMMAND = os.path.abspath(sys.argv[1])
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

    def told(self, path):
        status, body = self.ask(path)
        self.assertEqual(status, 200, body)
        return json.loads(body)

    def test_overview_and_search(self):
        begin = time.monotonic()
        valves = self.told("/api/v1/valves")["valves"]
        print(f"{len(valves)} valves in {time.monotonic() - begin:.2f} s")
        self.assertEqual(len(valves), VALVES)
        sites = self.told("/api/v1/sites")["sites"]
        self.assertEqual(sum(site["valves"] for site in sites), VALVES)
        self.assertEqual(sum(site["silent"] for site in sites), VALVES // 250)
        self.assertEqual(sum(site["alarms"] for site in sites), VALVES // 500)
        some = self.told("/api/v1/valves?site=hall_03&search=VALVE_0000")["valves"]
        self.assertEqual([valve["id"] for valve in some], ["hall_03/valve_00003"])
        self.assertAlmostEqual(some[0]["flow_L_min"], 60000 * (2e-4 + 1e-4 * 0.1411200), places=3)
        self.assertEqual(self.told("/api/v1/valves?search=%27%20OR%201=1")["valves"], [])
        self.assertIn(f'spoolflow_fleet_valves{{site="hall_00"}} {VALVES // 20}\n', self.ask("/metrics")[1])

    def test_names_the_valves_that_differ_from_their_sisters(self):
        series = self.told("/api/v1/series")["series"]
        self.assertEqual([one["series"] for one in series], ["model aaaaaaaa", "model bbbbbbbb"])
        friction = {one["name"]: one for one in series[0]["indicators"]}["friction_ratio"]
        self.assertEqual(friction["valves"], VALVES // 2)
        self.assertAlmostEqual(friction["median"], 1, places=1)
        named = sorted(one["valve"] for one in friction["outliers"]["named"])
        self.assertEqual(named, [f"hall_00/valve_{k:05}" for k in range(1000, VALVES + 1, 1000)])
        self.assertTrue(all(one["outliers"]["count"] == 0 for one in series[1]["indicators"]))
        query = urllib.parse.urlencode({"series": "model aaaaaaaa", "indicator": "friction_ratio"},
                                       quote_via=urllib.parse.quote)
        self.assertEqual(sum(self.told("/api/v1/distribution?" + query)["outlier"]), len(named))
        self.assertEqual(self.ask("/api/v1/distribution?series=none&indicator=none")[0], 404)

    def test_days_of_one_valve(self):
        flow = self.told("/api/v1/valves/hall_01%2Fvalve_00001/history")
        self.assertEqual(flow["valve"], "hall_01/valve_00001")
        self.assertGreater(len(flow["time_ms"]), 20)
        indicators = self.told("/api/v1/valves/hall_01/valve_00001/indicators")["indicators"]
        self.assertEqual(len(indicators), 10)
        self.assertEqual(indicators[0]["unit"], "1")
        self.assertEqual(self.ask("/api/v1/valves/hall_01%2Fnone/history")[0], 404)
        self.assertEqual(self.ask("/api/v1/valves/hall_01%2Fvalve_00001/history?from=2&to=1")[0], 400)
        self.assertEqual(len(self.told("/api/v1/events?valve=hall_01/valve_00001")["events"]), 1)

    def test_acknowledges_in_the_database(self):
        alarms = self.told("/api/v1/alarms")["alarms"]
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

    def test_z_says_that_the_database_is_away_and_comes_back(self):
        self.fleet.postgres.kill()
        until(lambda: self.ask("/api/v1/alarms")[0] == 503, 20, "a page that says so")
        self.assertIn("PostgreSQL", self.ask("/api/v1/alarms")[1])
        self.fleet.postgres.restart()
        until(lambda: self.ask("/api/v1/alarms")[0] == 200, 20, "a page that is back")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
