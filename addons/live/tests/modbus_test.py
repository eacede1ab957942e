#!/usr/bin/python3
"""modbus_test.py COMMAND EXAMPLES: the registers of [modbus], read by pymodbus; what must be refused."""
import json
import math
import os
import re
import shutil
import socket
import struct
import sys
import tempfile

from pymodbus.client import ModbusTcpClient

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from served import Live  # noqa: E402

command, examples = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
HEAD, PER_VALVE = 16, 32


def valve(client, k):
    answer = client.read_input_registers(HEAD + PER_VALVE * k, count=PER_VALVE, slave=1)
    assert not answer.isError(), answer
    names = ("flow", "lower", "upper", "pressure_difference", "rated", "status", "ne107", "stalled", "samples", "energy", "id")
    out = dict(zip(names, struct.unpack(">5f I 2H Q f 24s", struct.pack(f">{PER_VALVE}H", *answer.registers))))
    out["id"] = out["id"].rstrip(b"\0").decode()
    return out


folder = tempfile.mkdtemp(prefix="spoolflow-modbus-")
try:
    shutil.copy(os.path.join(examples, "live", "size_6.json"), os.path.join(folder, "model.json"))
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write('[page]\nlisten = "127.0.0.1:0"\n[modbus]\nlisten = "127.0.0.1:0"\n[sources]\nudp = "127.0.0.1:0"\n'
                   '[[valve]]\nid = "a"\nmodel = "model.json"\nsource = { kind = "rig", seed = 1 }\n'
                   '[[valve]]\nid = "silent"\nmodel = "model.json"\nsource = { kind = "udp" }\n')
    with Live(command, folder, "site.toml") as live:
        port = int(re.search(r"Modbus TCP at 127\.0\.0\.1:(\d+)", live.heard())[1])
        slow = socket.create_connection(("127.0.0.1", port))
        slow.send(b"\0\1\0\0\0\6")  # a request that never ends must hold nobody up
        client = ModbusTcpClient("127.0.0.1", port=port)
        assert client.connect()
        head = client.read_holding_registers(0, count=HEAD, slave=1).registers
        assert head[:4] == [0x5346, 1, 2, PER_VALVE], head
        while (registers := valve(client, 0))["samples"] < 100 or math.isnan(registers["flow"]):
            pass
        assert registers["id"] == "a" and registers["stalled"] == 0, registers
        assert registers["lower"] <= registers["flow"] <= registers["upper"], registers
        page = json.loads(live.ask("/api/v1/valves")[2])["valves"][0]
        assert math.isclose(registers["rated"], page["rated_flow_L_min"], rel_tol=1e-5), (registers, page)
        assert page["samples"] >= registers["samples"]
        silent = valve(client, 1)
        assert silent["id"] == "silent" and silent["stalled"] == 1 and silent["ne107"] == 3, silent
        assert math.isnan(silent["flow"]), silent
        for refused in (client.write_register(0, 1, slave=1), client.write_registers(16, [1, 2], slave=1),
                        client.write_coil(0, True, slave=1), client.read_coils(0, count=1, slave=1)):
            assert refused.isError() and refused.exception_code == 1, refused
        assert client.read_input_registers(HEAD + 2 * PER_VALVE, count=1, slave=1).exception_code == 2
        assert client.read_input_registers(0, count=1, slave=9).exception_code == 11
        outputs = json.loads(live.ask("/api/v1/site")[2])["outputs"]["modbus"]
        assert outputs["sent"] > 5 and outputs["connected"] >= 1 and outputs["trouble"] == "", outputs
        assert 'spoolflow_output_sent_total{output="modbus"}' in live.ask("/metrics")[2]
        client.close()
        slow.close()
    print(registers)
finally:
    shutil.rmtree(folder)
