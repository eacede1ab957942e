#!/usr/bin/python3
"""can_test.py COMMAND EXAMPLES: what [can] sends, decoded by python-can: candump's log, Vector's ASC, UDP multicast."""
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time

import can

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from can_frames import agreeing_flows, grouped, median_step, sdo_read, sdo_value  # noqa: E402
from served import Live  # noqa: E402

command, examples = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
PORT = 40000 + os.getpid() % 20000
SITE = """[page]
listen = "127.0.0.1:0"
[can]
log = "{log}"
udp = "239.74.163.2:{port}"
auxiliary_valve = {{ a = 3 }}
node = {{ a = 17, b = 18 }}
"""
VALVES = "".join(f'[[valve]]\nid = "{name}"\nmodel = "model.json"\nsource = {{ kind = "rig", seed = {seed} }}\n'
                 for seed, name in enumerate(("a", "b"), start=1))


def read(bus, index, sub):
    """An expedited SDO upload from node 17."""
    bus.send(can.Message(arbitration_id=0x611, is_extended_id=False, data=sdo_read(index, sub)))
    while True:
        answer = bus.recv(30)
        assert answer is not None, "no answer of the SDO server"
        if answer.arbitration_id == 0x591 and sdo_value(answer)[:2] == (index, sub):
            return answer.data


def judge(messages, name):
    """Estimated flow every 100 ms and process data of two nodes, all of them equal."""
    groups = grouped(messages)
    assert set(groups) == {(True, 0x18EEFF80), (True, 0x0CFE1380), (False, 0x191), (False, 0x192), (False, 0x711),
                           (False, 0x712)} | ({(False, 0x591)} & set(groups)), (name, groups.keys())
    flows = groups[(True, 0x0CFE1380)]
    assert abs(median_step(flows) - 0.1) < 0.02, (name, median_step(flows))
    claimed = groups[(True, 0x18EEFF80)][0].timestamp  # 0.25 s for others to object
    assert flows[0].timestamp - claimed > 0.24, (name, flows[0].timestamp - claimed)
    agreeing = agreeing_flows(flows, groups[(False, 0x191)])
    assert agreeing > 0.5 * len(flows), (name, agreeing, len(flows))
    return len(messages)


folder = tempfile.mkdtemp(prefix="spoolflow-can-")
try:
    shutil.copy(os.path.join(examples, "live", "size_6.json"), os.path.join(folder, "model.json"))
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write('[page]\nlisten = "127.0.0.1:0"\n[can]\ninterface = "nocan9"\nnode = { a = 17 }\n' + VALVES)
    refused = subprocess.run([command, "live", "site.toml"], cwd=folder, capture_output=True, text=True, timeout=60)
    assert refused.returncode == 2 and "nocan9" in refused.stderr and "log = " in refused.stderr, refused
    for log in ("bus.log", "bus.asc"):
        with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
            file.write(SITE.format(log=log, port=PORT) + VALVES)
        heard = []
        with Live(command, folder, "site.toml"), can.Bus("239.74.163.2", interface="udp_multicast", port=PORT) as bus:
            if log == "bus.log":
                assert struct.unpack("<I", read(bus, 0x1000, 0)[4:])[0] & 0xFFFF == 408
                full = struct.unpack("<i", read(bus, 0x2000, 7)[4:])[0]
                assert 10_000 < full < 200_000, full  # mL/min
                assert struct.unpack("<I", read(bus, 0x3000, 0)[4:])[0] == 0x06020000
                bus.send(can.Message(arbitration_id=0, is_extended_id=False, data=[128, 18]))  # pre-operational
                while not (message := bus.recv(30)).arbitration_id == 0x712 or message.data[0] != 127:
                    pass
                bus.send(can.Message(arbitration_id=0, is_extended_id=False, data=[1, 18]))
            while len(heard) < 120:
                heard.append(bus.recv(30))
        messages = list(can.LogReader(os.path.join(folder, log)))
        print(log, judge(messages, log), "frames,", len(heard), "by UDP")
        ids = {message.arbitration_id for message in heard}
        assert {0x0CFE1380, 0x191, 0x192} <= ids, ids
        assert abs(messages[-1].timestamp - time.time()) < 60 or log == "bus.asc"
finally:
    shutil.rmtree(folder)
