#!/usr/bin/python3
"""mqtt_source_test.py COMMAND EXAMPLES: valves whose samples come through mosquitto, sent by Paho for Python: the answer is that of
`estimate`; millimetres for metres, unknown valves and unreadable text are reported; the broker goes away and comes back."""
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

import paho.mqtt.client as mqtt

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from broker import Broker  # noqa: E402
from ports import free_ports  # noqa: E402
from served import Live  # noqa: E402

command, examples = (os.path.abspath(one) for one in sys.argv[1:3])
RUN = 'protocol = "ramps"\nvalve = "size_6"\nseed = 5\n[run]\npressure_differences_bar = [50]\nrate_percent_per_s = 40\n'


def sender(port):
    out = mqtt.Client()
    out.connect("127.0.0.1", port, 5)
    out.loop_start()
    return out


def until(what, judge):
    for _ in range(600):
        found = judge()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError(f"{what} never came")


folder = tempfile.mkdtemp(prefix="spoolflow-mqtt-source-")
broker = None
try:
    shutil.copy(os.path.join(examples, "live", "size_6.json"), os.path.join(folder, "model.json"))
    with open(os.path.join(folder, "run.toml"), "w", encoding="utf-8") as file:
        file.write(RUN)
    run = os.path.join(folder, "run.csv")
    subprocess.run([command, "simulate", "-q", os.path.join(folder, "run.toml"), "-o", run], check=True)
    said = subprocess.run([command, "estimate", "-q", os.path.join(folder, "model.json"), run, "-o", "-"], check=True,
                          stdout=subprocess.PIPE, text=True).stdout
    wanted = float(list(csv.DictReader(said.splitlines()))[-1]["flow_L_min"])
    with open(run, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    names = ["time_s", "position_mm", "current_A", "voltage_V", "oil_temperature_C"]
    columns = {name: [float(row[name]) for row in rows] for name in names}
    count = len(rows)
    port = free_ports(1)[0]
    with open(os.path.join(folder, "broker.conf"), "w", encoding="utf-8") as file:
        file.write(f"listener {port} 127.0.0.1\nallow_anonymous true\n")
    broker = Broker(folder, port)
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write('[page]\nlisten = "127.0.0.1:0"\n[sources]\nstalled_after_s = 600\n'
                   f'[sources.mqtt]\nbroker = "tcp://127.0.0.1:{broker.port}"\ntopic = "hall/+/samples"\n'
                   + "".join(f'[[valve]]\nid = "{valve}"\nmodel = "model.json"\nsource = {{ kind = "mqtt" }}\n' for valve in ("columns", "wrong"))
                   + '[[valve]]\nid = "lines"\nmodel = "model.json"\nsource = { kind = "mqtt", topic = "plc/7" }\n')
    with Live(command, folder, "site.toml") as live:
        def site():
            return json.loads(live.ask("/api/v1/site")[2])["mqtt_source"]

        def valve(name):
            return json.loads(live.ask(f"/api/v1/valves/{name}")[2])

        until("the connection", lambda: site()["connected"])
        post = sender(broker.port)

        def send(topic, payload):
            post.publish(topic, payload, 1).wait_for_publish(30)

        # Columns of JSON, lines of CSV with their header in each message, and a sample a message: one answer, that of the command.
        part = 500
        post.publish("plc/7", "time_s,current_A\nrubbish,of before\n", 1, retain=True).wait_for_publish(30)
        for begin in range(0, count, part):
            piece = {name: values[begin:begin + part] for name, values in columns.items()}
            send("hall/columns/samples", json.dumps(piece))
            lines = [",".join(names)] + [",".join(row[name] for name in names) for row in rows[begin:begin + part]]
            send("plc/7", "\n".join(lines))
            send("hall/wrong/samples", json.dumps({**{name: piece[name] for name in names if name != "position_mm"},
                                                   "position_m": piece["position_mm"]}))
        for name in ("columns", "lines"):
            until(f"all of {name}", lambda: valve(name)["samples"] >= count)
            assert abs(valve(name)["flow_L_min"] - wanted) < 2e-3, (name, valve(name)["flow_L_min"], wanted)
            assert valve(name)["source"]["kind"] == "mqtt" and not valve(name)["findings"], valve(name)["source"]

        # Millimetres where metres are stated.
        findings = until("a finding", lambda: valve("wrong")["findings"])
        assert "position" in findings[0] and "unit" in findings[0], findings

        # Unknown ids with their topics, and rubbish.
        for _ in range(3):
            send("hall/nobody/samples", "{}")
        send("hall/columns/samples", '{"time_s": ')
        unknown = until("the unknown one", lambda: [one for one in site()["unknown"] if one["messages"] == 3])
        assert unknown[0]["valve"] == "nobody" and unknown[0]["sender"] == "hall/nobody/samples", unknown
        assert site()["unknown_valve"] == 3
        source = until("what is unreadable", lambda: valve("columns")["source"]["unreadable"] and valve("columns")["source"])
        assert "no JSON" in source["trouble"], source
        metrics = live.ask("/metrics")[2]
        assert "spoolflow_mqtt_messages_total" in metrics and "spoolflow_mqtt_unknown_valve_total 3" in metrics

        # The broker dies; without a word of anybody the samples go on when it is back.
        broker.kill()
        until("the trouble", lambda: "no connection to tcp://" in valve("columns")["source"]["trouble"])
        assert not site()["connected"]
        broker.start()
        until("the connection again", lambda: site()["connected"])
        post.loop_stop()
        post = sender(broker.port)
        one = {name: values[-1] for name, values in columns.items()}
        send("hall/columns/samples", json.dumps({**one, "time_s": one["time_s"] + 0.001}))
        until("the next sample", lambda: valve("columns")["samples"] == count + 1)
        assert valve("columns")["source"]["trouble"] == "", valve("columns")["source"]
        post.loop_stop()
finally:
    if broker is not None:
        broker.kill()
    shutil.rmtree(folder)
