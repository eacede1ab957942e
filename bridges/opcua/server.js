#!/usr/bin/env node
// spoolflow-opcua: an OPC UA server beside `spoolflow live`. Options: --help. Nothing in it can be written.
import { readFileSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { parseArgs } from "node:util";
import {
  MessageSecurityMode, OPCUACertificateManager, OPCUAServer, SecurityPolicy, nodesets,
} from "node-opcua";
import { LogLevel, setLogLevel } from "node-opcua-debug";
import { Valves } from "./valves.js";

const HELP = `spoolflow-opcua --users FILE [--live http://127.0.0.1:8080] [--token-file FILE] [--port 4840]
                [--host 127.0.0.1] [--pki FOLDER] [--period-ms 500]
  --users       lines NAME:PASSWORD of who may read; there are no anonymous sessions
  --live        page of \`spoolflow live\`
  --token-file  first line: NAME.TOKEN of an account of that page (spoolflow account NAME --token)
  --host        address at which it listens
  --pki         certificates: own/, trusted/, rejected/; a client's is rejected until it lies in trusted/certs
  --period-ms   how often the page is asked`;

function fail(text) {
  console.error(`spoolflow-opcua: ${text}`);
  process.exit(2);
}

function options() {
  const text = (otherwise) => ({ type: "string", default: otherwise });
  try {
    return parseArgs({
      options: {
        live: text("http://127.0.0.1:8080"), "token-file": text(""), users: text(""), port: text("4840"),
        host: text("127.0.0.1"), pki: text("pki"), "period-ms": text("500"), help: { type: "boolean", default: false },
      },
    }).values;
  } catch (error) {
    return fail(`${error.message}; --help lists what there is`);
  }
}

function whole(values, name, least, most) {
  const value = Number(values[name]);
  if (!Number.isInteger(value) || value < least || value > most) {
    fail(`--${name} is '${values[name]}'; allowed: ${least} to ${most}`);
  }
  return value;
}

function readLines(file, what) {
  try {
    return readFileSync(file, "utf8").split("\n").map((line) => line.trim()).filter((line) => line !== "");
  } catch (error) {
    return fail(`${what} cannot be read: ${error.message}`);
  }
}

function accounts(file) {
  if (file === "") fail("--users is missing: name a file with lines NAME:PASSWORD of who may read");
  const out = new Map();
  for (const line of readLines(file, "--users")) {
    const colon = line.indexOf(":");
    if (colon < 1 || line.length - colon - 1 < 10) fail(`${file}: a line must be NAME:PASSWORD, the password of 10 letters at least`);
    out.set(line.slice(0, colon), line.slice(colon + 1));
  }
  if (out.size === 0) fail(`${file} names nobody; write lines NAME:PASSWORD`);
  return out;
}

setLogLevel(LogLevel.Emergency);  // the nodesets of others make it talkative
const values = options();
if (values.help) {
  console.log(HELP);
  process.exit(0);
}
const users = accounts(values.users);
const token = values["token-file"] === "" ? "" : readLines(values["token-file"], "--token-file")[0];
const port = whole(values, "port", 0, 65535);
const period_ms = whole(values, "period-ms", 100, 60000);
mkdirSync(values.pki, { recursive: true });

const certificates = new OPCUACertificateManager({ rootFolder: values.pki, automaticallyAcceptUnknownCertificate: false });
const userCertificates = new OPCUACertificateManager({ rootFolder: join(values.pki, "users") });
await certificates.initialize();
await userCertificates.initialize();
const server = new OPCUAServer({
  port,
  host: values.host,
  hostname: values.host,
  alternateHostname: [values.host],
  serverInfo: { applicationUri: "urn:spoolflow:opcua", productUri: "spoolflow-opcua" },
  buildInfo: { productName: "spoolflow-opcua", softwareVersion: "1.0.0", manufacturerName: "spoolflow" },
  serverCertificateManager: certificates,
  userCertificateManager: userCertificates,
  allowAnonymous: false,
  securityPolicies: [SecurityPolicy.Basic256Sha256],
  securityModes: [MessageSecurityMode.SignAndEncrypt],
  disableDiscovery: false,
  userManager: { isValidUser: (name, password) => users.has(name) && users.get(name) === password },
  nodeset_filename: [nodesets.standard, nodesets.di, nodesets.irdi, nodesets.padim, nodesets.ia, nodesets.machinery,
    nodesets.machineryProcessValues],
});
await server.initialize();
const valves = new Valves(server.engine.addressSpace);

async function ask() {
  const headers = token === "" ? {} : { Authorization: `Bearer ${token}` };
  const answer = await fetch(new URL("/api/v1/valves", values.live), { headers, signal: AbortSignal.timeout(5000) });
  if (!answer.ok) throw new Error(`HTTP ${answer.status}`);
  return answer.json();
}

let trouble = "";
let timer;
async function follow() {
  try {
    valves.update(await ask());
    if (trouble !== "") console.error(`${values.live} answers again`);
    trouble = "";
  } catch (error) {
    valves.update(null);
    const now = error.cause?.message ?? error.message;
    if (now !== trouble) console.error(`${values.live} does not answer: ${now}`);
    trouble = now;
  }
  timer = setTimeout(follow, period_ms);
}
await follow();
try {
  await server.start();
} catch (error) {
  fail(`cannot listen at ${values.host}:${port}: ${error.message}`);
}
console.log(`OPC UA at ${server.getEndpointUrl()}; ${valves.valves.size} valves of ${values.live}; end with Ctrl-C`);

for (const signal of ["SIGINT", "SIGTERM"]) {
  process.once(signal, async () => {
    clearTimeout(timer);
    await server.shutdown(100);
    process.exit(0);
  });
}
