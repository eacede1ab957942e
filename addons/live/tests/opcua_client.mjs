// opcua_client.mjs ENDPOINT PKI NAME PASSWORD: browses a spoolflow-opcua server and prints what it finds as JSON.
// Writes and anonymous sessions are tried, too, and must be refused.
import {
  AttributeIds, BrowseDirection, DataType, MessageSecurityMode, OPCUACertificateManager, OPCUAClient, SecurityPolicy,
  UserTokenType,
} from "node-opcua";

const [endpoint, pki, userName, password] = process.argv.slice(2);
const clientCertificateManager = new OPCUACertificateManager({
  rootFolder: pki, automaticallyAcceptUnknownCertificate: true });
await clientCertificateManager.initialize();
const strategy = { maxRetry: 1, initialDelay: 100, maxDelay: 200 };
const base = { endpointMustExist: false, connectionStrategy: strategy, clientCertificateManager };
const secure = { ...base, securityMode: MessageSecurityMode.SignAndEncrypt, securityPolicy: SecurityPolicy.Basic256Sha256 };

async function attempt(options, user, work) {
  const client = OPCUAClient.create(options);
  client.on("backoff", () => {});
  try {
    await client.connect(endpoint);
    const session = await client.createSession(user);
    try {
      return await work(session);
    } finally {
      await session.close();
    }
  } finally {
    await client.disconnect();
  }
}
const refused = (options, user) => attempt(options, user, () => false).catch((error) => error.message.slice(0, 200));
const known = { type: UserTokenType.UserName, userName, password };

const out = {
  withoutEncryption: await refused({ ...base, securityMode: MessageSecurityMode.None, securityPolicy: SecurityPolicy.None },
    known),
  anonymous: await refused(secure, { type: UserTokenType.Anonymous }),
  wrongPassword: await refused(secure, { ...known, password: "another secret" }),
  valves: {},
};
const children = async (session, nodeId) => (await session.browse({
  nodeId, browseDirection: BrowseDirection.Forward, referenceTypeId: "HierarchicalReferences", includeSubtypes: true,
  nodeClassMask: 0, resultMask: 63 })).references;
try {
  await attempt(secure, known, async (session) => {
    const objects = await children(session, "ObjectsFolder");
    const machines = objects.find((one) => one.browseName.name === "Machines");
    for (const valve of await children(session, machines.nodeId)) {
      const nodes = {};
      for (const one of await children(session, valve.nodeId)) {
        const under = await children(session, one.nodeId);
        const signal = under.find((x) => x.browseName.name === "AnalogSignal");
        const value = await session.read({ nodeId: signal?.nodeId ?? one.nodeId, attributeId: AttributeIds.Value });
        if (value.value.dataType === DataType.Null && !signal) continue;
        const entry = { value: value.value.value, status: value.statusCode.name };
        if (signal) {
          entry.type = (await session.read({ nodeId: one.typeDefinition, attributeId: AttributeIds.BrowseName })).value.value.name;
          const units = (await children(session, signal.nodeId)).find((x) => x.browseName.name === "EngineeringUnits");
          entry.unit = (await session.read({ nodeId: units.nodeId, attributeId: AttributeIds.Value })).value.value.displayName.text;
          entry.write = (await session.write({ nodeId: signal.nodeId, attributeId: AttributeIds.Value,
            value: { value: { dataType: DataType.Double, value: 1 } } })).name;
        }
        nodes[one.browseName.name] = entry;
      }
      if (nodes.Flow) out.valves[valve.browseName.name] = nodes;
    }
  });
} catch (error) {
  out.failed = error.message;
}
console.log(JSON.stringify(out, (key, value) => typeof value === "bigint" ? Number(value) : value));
process.exit(0);
