#!/usr/bin/python3
"""canopen_test.py COMMAND EXAMPLES EDS NODE_MODULES: the CiA 408 device as the npm library `canopen` sees it: its EDS is
read, its objects are read by that library's SDO client, its process data are decoded by the EDS. Frames go between the
two by python-can."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading

import can

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from served import Live  # noqa: E402

command, examples, eds, modules = (os.path.abspath(one) for one in sys.argv[1:5])
PORT = 40000 + os.getpid() % 20000
MASTER = """
// node-crc is compiled, and wanted for block transfers alone, which nobody here makes.
const Module = require("module"), load = Module._load;
Module._load = (name, ...rest) => name === "node-crc" ? {crc: () => { throw new Error("no block transfers"); }}
                                                      : load(name, ...rest);
const {Device, Eds, DataType} = require("canopen");
const sheet = Eds.fromFile(process.argv[1]);
const master = new Device({id: 1});
master.eds.addSdoClientParameter(17, 0x611, 0x591);
master.addListener("message", (m) => console.log(JSON.stringify({id: m.id, data: m.data.toString("hex")})));
require("readline").createInterface({input: process.stdin}).on("line", (line) => {
  const m = JSON.parse(line);
  if (process_data === undefined && m.id === 0x191) process_data = m.data;
  master.receive({id: m.id, data: Buffer.from(m.data, "hex"), len: m.data.length / 2});
});
let process_data;
const read = (index, subIndex, dataType) => master.sdo.upload({serverId: 17, index, subIndex, dataType, timeout: 20000});
(async () => {
  master.start();
  const values = {};
  for (const [index, entry] of sheet.entries()) {
    for (let sub = 0; sub < (entry.subNumber ? 16 : 1); ++sub) {
      const one = entry.subNumber ? entry[sub] : entry;
      if (one) values[index + "." + sub] = Number(await read(parseInt(index, 16), sub, one.dataType));
    }
  }
  const mapped = sheet.getTransmitPdos().map((pdo) => pdo.dataObjects.map((one) => one.parameterName));
  while (process_data === undefined) await new Promise((done) => setTimeout(done, 10));
  console.log(JSON.stringify({values, mapped, process_data}));
  process.exit(0);
})().catch((error) => { console.error(error); process.exit(1); });
"""

folder = tempfile.mkdtemp(prefix="spoolflow-canopen-")
try:
    shutil.copy(os.path.join(examples, "live", "size_6.json"), os.path.join(folder, "model.json"))
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write(f'[page]\nlisten = "127.0.0.1:0"\n[can]\nudp = "239.74.163.2:{PORT}"\nnode = {{ a = 17 }}\n'
                   '[[valve]]\nid = "a"\nmodel = "model.json"\nsource = { kind = "rig", seed = 1 }\n')
    with open(eds, encoding="utf-8") as file:  # the library wants the number of the node in it, as in a DCF
        sheet = file.read().replace("$NODEID+0x40000180", "0x40000191")
    with open(os.path.join(folder, "node_17.eds"), "w", encoding="utf-8") as file:
        file.write(sheet)
    with Live(command, folder, "site.toml"), can.Bus("239.74.163.2", interface="udp_multicast", port=PORT) as bus:
        master = subprocess.Popen(["node", "-e", MASTER, os.path.join(folder, "node_17.eds")], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                  env={**os.environ, "NODE_PATH": modules})

        def pump():
            while master.poll() is None:
                message = bus.recv(1)
                if message is None or message.is_extended_id:
                    continue
                try:
                    master.stdin.write(json.dumps({"id": message.arbitration_id, "data": message.data.hex()}) + "\n")
                    master.stdin.flush()
                except BrokenPipeError:
                    return

        threading.Thread(target=pump, daemon=True).start()
        result = None
        for line in master.stdout:
            message = json.loads(line)
            if "values" in message:
                result = message
                break
            bus.send(can.Message(arbitration_id=message["id"], is_extended_id=False, data=bytes.fromhex(message["data"])))
        assert master.wait(timeout=60) == 0 and result, "the master gave up"
    values = result["values"]
    assert values["1000.0"] == 408 and values["1800.1"] == 0x40000191, values
    assert values["1017.0"] == 1000 and values["1018.4"] == 0, values
    assert 10_000 < values["2000.7"] < 200_000, values
    assert result["mapped"] == [["Device status word", "Flow", "Flow lower", "Flow upper"]], result["mapped"]
    print(len(values), "objects read,", values)
finally:
    shutil.rmtree(folder)
