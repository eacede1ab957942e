#!/usr/bin/python3
"""mqtt_test.py COMMAND EXAMPLES NODE_MODULES: what [mqtt] sends to mosquitto, decoded by Eclipse Tahu's sparkplug-payload:
birth, data, rebirth by command, data kept while the broker is away, death."""
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time

import paho.mqtt.client as mqtt

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from broker import Broker  # noqa: E402
from ports import free_ports  # noqa: E402
from served import Live, certificate  # noqa: E402

command, examples, modules = (os.path.abspath(one) for one in sys.argv[1:4])
DECODER = """
const sparkplug = require("sparkplug-payload").get("spBv1.0");
const plain = (key, value) => typeof value === "bigint" ? Number(value)
  : value !== null && value !== undefined && typeof value.toNumber === "function" ? value.toNumber() : value;
require("readline").createInterface({input: process.stdin}).on("line", (line) => {
  const order = JSON.parse(line);
  if (order.encode) {
    console.log(Buffer.from(sparkplug.encodePayload(order.encode)).toString("hex"));
  } else {
    console.log(JSON.stringify(sparkplug.decodePayload(Buffer.from(order.decode, "hex")), plain));
  }
});
"""


class Decoder:
    def __init__(self):
        self.process = subprocess.Popen(["node", "-e", DECODER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                        env={**os.environ, "NODE_PATH": modules})

    def ask(self, order):
        self.process.stdin.write(json.dumps(order) + "\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().strip()

    def decode(self, payload):
        return json.loads(self.ask({"decode": payload.hex()}))


class Line:
    """Between the site and the broker, so that the host hears the broker again before the site does."""

    def __init__(self, to):
        self.to, self.is_open, self.listener = to, True, socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            near = self.listener.accept()[0]
            try:
                far = socket.create_connection(("127.0.0.1", self.to), 1) if self.is_open else None
            except OSError:
                far = None
            if far is None:
                near.close()
                continue
            far.settimeout(None)
            for one, other in ((near, far), (far, near)):
                threading.Thread(target=self.pass_on, args=(one, other), daemon=True).start()

    @staticmethod
    def pass_on(one, other):
        try:
            while data := one.recv(65536):
                other.sendall(data)
        except OSError:
            pass
        for end in (one, other):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass


class Host:
    """A host application that hears all of the group."""

    def __init__(self, port, trust):
        self.heard, self.client = [], mqtt.Client()
        self.client.tls_set(trust)
        self.client.username_pw_set("hall", "a secret of some length")
        self.client.reconnect_delay_set(1, 1)
        self.subscribed = threading.Event()
        self.client.on_connect = lambda client, *_: client.subscribe("spBv1.0/plant/#", 1)
        self.client.on_subscribe = lambda *_: self.subscribed.set()
        self.client.on_message = lambda _, __, message: self.heard.append((message.topic, message.payload))
        self.client.connect("127.0.0.1", port, 5)
        threading.Thread(target=lambda: self.client.loop_forever(retry_first_connection=True), daemon=True).start()

    def until(self, what, judge):
        for _ in range(1200):
            found = [one for one in list(self.heard) if judge(*one)]
            if found:
                return found
            time.sleep(0.05)
        raise AssertionError(f"{what} never came; heard {[topic for topic, _ in self.heard][-20:]}")


def values(payload):
    return {metric["name"]: metric.get("value") for metric in payload["metrics"]}


folder = tempfile.mkdtemp(prefix="spoolflow-mqtt-")
os.chmod(folder, 0o755)  # the broker gives up its rights
broker = None
try:
    shutil.copy(os.path.join(examples, "live", "size_6.json"), os.path.join(folder, "model.json"))
    certificate(folder)
    os.chmod(os.path.join(folder, "key.pem"), 0o644)
    port = free_ports(1)[0]
    line = Line(port)
    with open(os.path.join(folder, "password"), "w", encoding="utf-8") as file:
        file.write("a secret of some length\n")
    subprocess.run(["mosquitto_passwd", "-b", "-c", os.path.join(folder, "accounts"), "hall", "a secret of some length"],
                   check=True)
    os.chmod(os.path.join(folder, "accounts"), 0o644)
    with open(os.path.join(folder, "broker.conf"), "w", encoding="utf-8") as file:
        file.write(f"listener {port} 127.0.0.1\ncertfile {folder}/certificate.pem\nkeyfile {folder}/key.pem\n"
                   f"allow_anonymous false\npassword_file {folder}/accounts\n")
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write(f'[page]\nlisten = "127.0.0.1:0"\n[mqtt]\nbroker = "ssl://127.0.0.1:{line.port}"\ngroup = "plant"\n'
                   'edge_node = "hall_3"\nuser = "hall"\npassword_file = "password"\nauthority = "certificate.pem"\n'
                   'period_s = 0.2\n[[valve]]\nid = "press_1"\nmodel = "model.json"\n'
                   'source = { kind = "rig", seed = 1 }\n')
    decoder, broker = Decoder(), Broker(folder, port)
    host = Host(port, os.path.join(folder, "certificate.pem"))
    assert host.subscribed.wait(60)
    with Live(command, folder, "site.toml") as live:
        birth = decoder.decode(host.until("NBIRTH", lambda topic, _: topic == "spBv1.0/plant/NBIRTH/hall_3")[0][1])
        assert birth["seq"] == 0 and values(birth) == {"bdSeq": 0, "Node Control/Rebirth": False}, birth
        device = decoder.decode(host.until("DBIRTH", lambda topic, _: "/DBIRTH/hall_3/press_1" in topic)[0][1])
        assert device["seq"] == 1, device
        assert {"Flow/L_min", "Flow/lower_L_min", "Flow/upper_L_min", "NE 107", "Samples"} <= set(values(device)), device
        host.until("DDATA", lambda topic, _: "/DDATA/" in topic)

        # the sequence has no gap, past 255
        while len(host.heard) < 300:
            time.sleep(0.1)
        payloads = [decoder.decode(payload) for topic, payload in host.heard if "/N" not in topic or "NBIRTH" in topic]
        last = None
        for one in payloads:
            assert last is None or one["seq"] in ((last + 1) % 256, 0), (last, one)
            last = one["seq"]
        flows = [one for one in payloads if "Flow/L_min" in values(one)]
        assert len({values(one)["Flow/L_min"] for one in flows}) > 10

        # a new birth by command, written by the foreign encoder
        host.heard.clear()
        order = decoder.ask({"encode": {"timestamp": 1, "metrics": [
            {"name": "Node Control/Rebirth", "type": "Boolean", "value": True}]}})
        host.client.publish("spBv1.0/plant/NCMD/hall_3", bytes.fromhex(order), 0)
        again = decoder.decode(host.until("rebirth", lambda topic, _: "/NBIRTH/" in topic)[0][1])
        assert again["seq"] == 0 and values(again)["bdSeq"] == 0, again

        # the broker dies, and comes back seconds later: a new birth, and what was kept, in order
        host.heard.clear()
        host.subscribed.clear()
        line.is_open = False
        broker.kill()
        away_ms = 1000 * time.time()
        for _ in range(200):
            outputs = json.loads(live.ask("/api/v1/site")[2])["outputs"]["mqtt"]
            if outputs["waiting"] >= 15:
                break
            time.sleep(0.1)
        assert outputs["waiting"] >= 15 and outputs["trouble"], outputs
        samples = json.loads(live.ask("/api/v1/valves")[2])["valves"][0]["samples"]
        back_ms = 1000 * time.time()
        broker.start()
        assert host.subscribed.wait(60)
        line.is_open = True
        third = decoder.decode(host.until("birth after the broker's return", lambda topic, _: "/NBIRTH/" in topic)[0][1])
        assert values(third)["bdSeq"] >= 1, third
        host.until("data of now", lambda topic, payload: "/DDATA/" in topic and not any(
            metric.get("isHistorical") for metric in decoder.decode(payload)["metrics"]))
        data = [decoder.decode(payload) for topic, payload in host.heard if "/DDATA/" in topic]
        kept = [one for one in data if all(metric.get("isHistorical") for metric in one["metrics"])]
        times = [one["timestamp"] for one in kept]
        assert times == sorted(times) and len(kept) >= 10, times
        assert sum(away_ms <= time_ms <= back_ms for time_ms in times) >= 10, (away_ms, back_ms, times)
        assert json.loads(live.ask("/api/v1/valves")[2])["valves"][0]["samples"] > samples
        outputs = json.loads(live.ask("/api/v1/site")[2])["outputs"]["mqtt"]
        assert outputs["trouble"] == "" and outputs["dropped"] == 0, outputs
    death = decoder.decode(host.until("NDEATH", lambda topic, _: "/NDEATH/" in topic)[-1][1])
    assert values(death)["bdSeq"] == values(third)["bdSeq"] and "seq" not in death, death
    print(f"{len(flows)} messages with a flow, {len(kept)} kept while the broker was away")
finally:
    if broker is not None:
        broker.kill()
    shutil.rmtree(folder)
