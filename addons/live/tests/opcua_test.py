#!/usr/bin/python3
"""opcua_test.py COMMAND EXAMPLES BRIDGE CLIENT: bridges/opcua beside `spoolflow live`, browsed by a client of node-opcua;
who may not come in, and that nothing can be written. BRIDGE is a copy of the folder with its packages."""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from ports import free_ports  # noqa: E402
from served import Live  # noqa: E402

command, examples, bridge, client = (os.path.abspath(one) for one in sys.argv[1:5])
SECRET = "a secret of some length"


class Bridge:
    def __init__(self, folder, live_port):
        self.port, = free_ports(1)
        self.process = subprocess.Popen(
            ["node", os.path.join(bridge, "server.js"), "--live", f"http://127.0.0.1:{live_port}", "--users", "users",
             "--port", str(self.port)], cwd=folder, stdout=subprocess.PIPE, text=True)
        for line in self.process.stdout:
            if "OPC UA at" in line:
                return
        raise AssertionError(f"the bridge ended with {self.process.wait()}")

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.process.send_signal(signal.SIGTERM)
        assert self.process.wait(timeout=60) == 0

    def browse(self, folder):
        done = subprocess.run(["node", os.path.join(bridge, "client.mjs"), f"opc.tcp://127.0.0.1:{self.port}",
                               os.path.join(folder, "client_pki"), "reader", SECRET], capture_output=True, text=True,
                              timeout=300)
        assert done.returncode == 0, done.stderr[-3000:]
        return json.loads(done.stdout.strip().splitlines()[-1])


folder = tempfile.mkdtemp(prefix="spoolflow-opcua-")
try:
    shutil.copy(client, os.path.join(bridge, "client.mjs"))
    shutil.copy(os.path.join(examples, "live", "size_6.json"), os.path.join(folder, "model.json"))
    with open(os.path.join(folder, "users"), "w", encoding="utf-8") as file:
        file.write(f"reader:{SECRET}\n")
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write('[page]\nlisten = "127.0.0.1:0"\n[sources]\nudp = "127.0.0.1:0"\n'
                   '[[valve]]\nid = "a"\nmodel = "model.json"\nsource = { kind = "rig", seed = 1 }\n'
                   '[[valve]]\nid = "silent"\nmodel = "model.json"\nsource = { kind = "udp" }\n')
    with Live(command, folder, "site.toml") as live:
        with Bridge(folder, live.port) as server:
            stranger = server.browse(folder)
            assert "valves" in stranger and not stranger["valves"] and "rejected" in stranger["failed"], stranger
        rejected = os.path.join(folder, "pki", "rejected")
        names = os.listdir(rejected)
        assert len(names) == 1, names
        shutil.move(os.path.join(rejected, names[0]), os.path.join(folder, "pki", "trusted", "certs", names[0]))
        with Bridge(folder, live.port) as server:
            found = server.browse(folder)
    for refused in ("withoutEncryption", "anonymous", "wrongPassword"):
        assert isinstance(found[refused], str) and found[refused], (refused, found)
    assert "failed" not in found and set(found["valves"]) == {"a", "silent"}, found
    a, silent = found["valves"]["a"], found["valves"]["silent"]
    for name, unit in (("Flow", "L/min"), ("FlowLower", "L/min"), ("FlowUpper", "L/min"), ("PressureDifference", "bar")):
        assert a[name]["type"] == "ProcessValueType" and a[name]["unit"] == unit, a
        assert a[name]["write"] == "BadNotWritable", a
    assert a["Flow"]["status"] == "Good" and a["DeviceHealth"]["value"] == 0, a
    assert a["Samples"]["value"][1] > 0, a
    assert silent["DeviceHealth"]["value"] == 2 and silent["Flow"]["status"] != "Good", silent  # check function
    assert "stalled" in silent["Status"]["value"], silent
    print(a)
finally:
    shutil.rmtree(folder)
