#!/usr/bin/python3
"""interface_test.py COMMAND EXAMPLES ADDON: docs/openapi.json, as the program serves it, beside what the program answers: each
path that it describes is there, each that the sources know is described, and valves, indicators and alarms have the fields
that it names and no other."""
import json
import os
import re
import shutil
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from served import Live  # noqa: E402

command, examples, addon = map(os.path.abspath, sys.argv[1:4])
folder = tempfile.mkdtemp(prefix="spoolflow-interface-")


def known_to_sources():
    """The paths of the interface that the sources compare with, as OpenAPI writes them."""
    text = ""
    for name in ("page/answer.cpp", "http/http_access.cpp"):
        with open(os.path.join(addon, name), encoding="utf-8") as file:
            text += file.read()
    whole = set(re.findall(r'"(/api/v1/[a-z]+|/metrics)"', text))
    below = {f"/api/v1/valves/{{id}}/{what}" for what in re.findall(r'valve_asked\(path, "([a-z]+)"\)', text)}
    assert all(part in text for part in ('"/api/v1/recordings/"', '".csv"', '"/api/v1/alarms/"', '"/api/v1/valves/"'))
    orders = re.search(r'behind : \{([^}]+)\}', text)[1]
    acts = {f"/api/v1/alarms/{{number}}{what}" for what in re.findall(r'"(/[a-z]+)"', orders)}
    assert len(acts) == 4
    return whole | below | acts | {"/api/v1/valves/{id}", "/api/v1/recordings/{number}.csv"}


try:
    shutil.copy(os.path.join(examples, "live", "size_6.json"), os.path.join(folder, "model.json"))
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write('[page]\nlisten = "127.0.0.1:0"\n[store]\nfile = "site.sqlite"\n[alarms]\nraised_after_s = 0.5\n[sources]\n'
                   'udp = "127.0.0.1:0"\n'
                   '[[valve]]\nid = "a"\nmodel = "model.json"\nsource = { kind = "rig", seed = 1 }\n'
                   '[[valve]]\nid = "b"\nmodel = "model.json"\nsource = { kind = "udp" }\n')
    with Live(command, folder, "site.toml") as live:
        def asked(path, method="GET", body=None):
            own = {"Origin": f"http://127.0.0.1:{live.port}", "Content-Type": "application/json"}
            status, _, text = live.ask(path, method, body=(body or {}) if method == "POST" else None, headers=own)
            return status, text

        described = json.loads(asked("/api/v1/openapi.json")[1])
        schemas = described["components"]["schemas"]
        alarms = []
        while not alarms:  # of b, which gets no samples
            time.sleep(0.3)
            alarms = json.loads(asked("/api/v1/alarms")[1])["alarms"]

        assert set(described["paths"]) == known_to_sources(), set(described["paths"]) ^ known_to_sources()
        for path, methods in described["paths"].items():
            target = path.replace("{id}", "a").replace("{number}", str(alarms[0]["id"]))
            method, = (each.upper() for each in methods)
            if path.endswith(("/stream", "/login", "/logout")):
                continue  # a WebSocket, and what a page without accounts does not serve
            body = {"shelve": {"hours": 1}, "comment": {"text": "seen"}}.get(path.rsplit("/", 1)[1], {})
            status, text = asked(target, method, body)
            assert "there is nothing here" not in text and status != 405, (target, status, text)
            if "recordings/" in path:
                continue  # there is no recording: refused by what is there
            assert status == 200, (target, status, text)
        assert asked("/api/v1/valves/c")[0] == 404
        assert asked("/api/v1/nothing")[0] == 404

        valve = json.loads(asked("/api/v1/valves/a")[1])
        assert valve["id"] == "a"
        assert set(valve) == set(schemas["Valve"]["properties"]), set(valve) ^ set(schemas["Valve"]["properties"])
        silent = json.loads(asked("/api/v1/valves/b")[1])  # nothing is known of it
        assert silent["flow_L_min"] is None and silent["pressure_difference_bar"] is None, silent
        for one in valve["indicators"]:
            assert set(one) == set(schemas["Indicator"]["properties"]), one
        limits = {one["name"]: (one["alarm_below"], one["alarm_above"], one["baseline"]) for one in valve["indicators"]}
        below, above, usual = limits["friction_ratio"]
        assert below is None and above > usual, limits["friction_ratio"]
        below, above, usual = limits["spring_preload_ratio"]
        assert above is None and below < usual, limits["spring_preload_ratio"]
        assert limits["strokes"][:2] == (None, None)
        assert set(alarms[0]) == set(schemas["Alarm"]["properties"]), set(alarms[0]) ^ set(schemas["Alarm"]["properties"])
        assert alarms[0]["meaning"].startswith("No samples arrive") and alarms[0]["remedy"].startswith("Check ")

        recent = {each["id"]: each for each in json.loads(asked("/api/v1/recent")[1])["valves"]}
        while sum(flow is not None for flow in recent["a"]["flow_L_min"]) < 3:
            time.sleep(0.5)
            recent = {each["id"]: each for each in json.loads(asked("/api/v1/recent")[1])["valves"]}
        assert len(recent["a"]["flow_L_min"]) == 120
        newest = [k for k, flow in enumerate(recent["a"]["flow_L_min"]) if flow is not None][-1]
        assert newest >= 115, newest
        for flow, lower, upper in zip(*(recent["a"][name] for name in ("flow_L_min", "flow_lower_L_min", "flow_upper_L_min"))):
            assert flow is None or lower <= flow <= upper
        assert set(recent["b"]["flow_L_min"]) == {None}
        bits = json.loads(asked("/api/v1/site")[1])["status_bits"]
        assert bits["closed"] > 0 and len(set(bits.values())) == len(bits)
    causes = set(schemas["Alarm"]["properties"]["cause"]["enum"])
    with open(os.path.join(addon, "page", "alarm_words.hpp"), encoding="utf-8") as file:
        worded = set(re.findall(r'^    \{"([a-z_]+)",', file.read(), re.MULTILINE))
    assert worded == causes, worded ^ causes
    print(f"{len(described['paths'])} paths")
finally:
    shutil.rmtree(folder)
