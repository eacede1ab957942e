#!/usr/bin/python3
"""plotjuggler_test.py COMMAND EXAMPLES: what [plotjuggler] sends, received as PlotJuggler's "UDP Server" does."""
import json
import os
import shutil
import socket
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from served import Live  # noqa: E402

command, examples = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
folder = tempfile.mkdtemp(prefix="spoolflow-plotjuggler-")
try:
    shutil.copy(os.path.join(examples, "live", "size_6.json"), os.path.join(folder, "model.json"))
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.bind(("127.0.0.1", 0))
    receiver.settimeout(60)
    site = (f'[page]\nlisten = "127.0.0.1:0"\n[plotjuggler]\nsend_to = "127.0.0.1:{receiver.getsockname()[1]}"\n' +
            "".join(f'[[valve]]\nid = "{name}"\nmodel = "model.json"\nsource = {{ kind = "rig", seed = {seed} }}\n'
                    for seed, name in enumerate(("a", "b"))))
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write(site)
    points = {"a": [], "b": []}
    with Live(command, folder, "site.toml"):
        while min(map(len, points.values())) < 100:
            message = json.loads(receiver.recv(65536))
            name, = set(message) - {"timestamp"}
            points[name].append((message["timestamp"], message[name]))
    for name, series in points.items():
        times = [time_s for time_s, _ in series]
        assert times == sorted(times), name
        assert abs(times[-1] - time.time()) < 60, (times[-1], time.time())
        steps = [after - before for before, after in zip(times, times[1:])]
        assert abs(sorted(steps)[len(steps) // 2] - 0.02) < 0.002, steps
        for _, values in series:
            assert values["flow_lower_L_min"] <= values["flow_min_L_min"] <= values["flow_max_L_min"], values
            assert values["flow_max_L_min"] <= values["flow_upper_L_min"], values
            assert {"time_s", "position_mm", "current_A", "status", "ne107"} <= set(values), values
    print({name: len(series) for name, series in points.items()}, "points")
finally:
    shutil.rmtree(folder)
