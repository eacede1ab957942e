// The address space: each valve is a machine with process values and the health of NE 107.
import { AccessLevelFlag, DataType, StatusCodes, VariantArrayType, coerceLocalizedText, standardUnits } from "node-opcua";

const NAMESPACE = "urn:spoolflow:valves";
const PROCESS_VALUES = "http://opcfoundation.org/UA/Machinery/ProcessValues/";
const DI = "http://opcfoundation.org/UA/DI/";

// DeviceHealthEnumeration of OPC UA for Devices, which has NE 107's signs in an order of its own.
const HEALTH = { good: 0, F: 1, C: 2, S: 3, M: 4 };

// UNECE codes as OPC UA wants them: "L2" is litre per minute, "BAR" is bar.
const unit = (id, name, description) => ({
  namespaceUri: "http://www.opcfoundation.org/UA/units/un/cefact",
  unitId: [...id].reduce((sum, letter) => sum * 256 + letter.charCodeAt(0), 0),
  displayName: coerceLocalizedText(name),
  description: coerceLocalizedText(description),
});
const LITRE_PER_MINUTE = unit("L2", "L/min", "litre per minute");
const BAR = standardUnits.bar ?? unit("BAR", "bar", "bar");

function readOnly(variable) {
  variable.accessLevel = AccessLevelFlag.CurrentRead;
  variable.userAccessLevel = AccessLevelFlag.CurrentRead;
}

export class Valves {
  constructor(addressSpace) {
    this.space = addressSpace;
    this.own = addressSpace.registerNamespace(NAMESPACE);
    this.machines = addressSpace.rootFolder.objects.machines;
    const index = addressSpace.getNamespaceIndex(PROCESS_VALUES);
    this.processValue = addressSpace.findObjectType("ProcessValueType", index);
    this.health = addressSpace.findDataType("DeviceHealthEnumeration", addressSpace.getNamespaceIndex(DI));
    this.valves = new Map();
  }

  // What /api/v1/valves answered; null: it did not.
  update(answer, now = new Date()) {
    if (answer === null) {
      for (const valve of this.valves.values()) this.#tellLost(valve, now);
      return;
    }
    const named = new Set(answer.valves.map((one) => one.id));
    for (const one of answer.valves) {
      if (!this.valves.has(one.id)) this.valves.set(one.id, this.#add(one));
      this.#write(this.valves.get(one.id), one, now);
    }
    for (const [id, valve] of this.valves) if (!named.has(id)) this.#tellLost(valve, now);
  }

  #analog(parent, name, description, units, range) {
    const value = this.processValue.instantiate({
      browseName: { name, namespaceIndex: this.own.index },
      namespace: this.own,
      nodeId: `s=${parent.browseName.name}/${name}`,
      componentOf: parent,
      description,
      optionals: ["AnalogSignal.EngineeringUnits", "AnalogSignal.EURange"],
    });
    const signal = value.getComponentByName("AnalogSignal") ?? value.getChildByName("AnalogSignal");
    signal.dataType = this.space.findDataType("Double").nodeId;
    signal.valueRank = -1;
    readOnly(signal);
    signal.getPropertyByName("EngineeringUnits")?.setValueFromSource({
      dataType: DataType.ExtensionObject,
      value: this.space.constructExtensionObject(this.space.findDataType("EUInformation"), units),
    });
    signal.getPropertyByName("EURange")?.setValueFromSource({
      dataType: DataType.ExtensionObject,
      value: this.space.constructExtensionObject(this.space.findDataType("Range"), range),
    });
    value.getPropertyByName("SignalTag")?.setValueFromSource({
      dataType: DataType.String, value: `${parent.browseName.name}.${name}` });
    return signal;
  }

  #variable(parent, name, description, dataType) {
    const variable = this.own.addVariable({
      browseName: name, nodeId: `s=${parent.browseName.name}/${name}`, componentOf: parent, description, dataType,
      minimumSamplingInterval: 100,
    });
    readOnly(variable);
    return variable;
  }

  #add(one) {
    const machine = this.own.addObject({ browseName: one.id, nodeId: `s=${one.id}`, organizedBy: this.machines });
    const most = one.rated_flow_L_min ?? 100;
    const flow = (name, text) => this.#analog(machine, name, text, LITRE_PER_MINUTE, { low: -most, high: most });
    return {
      flow: flow("Flow", "Estimated flow rate, > 0 from P to B"),
      lower: flow("FlowLower", "Lower end of the 95 % band of the flow rate"),
      upper: flow("FlowUpper", "Upper end of the 95 % band of the flow rate"),
      pressure: this.#analog(machine, "PressureDifference", "Pressure difference over the open edge, estimated", BAR,
        { low: 0, high: 400 }),
      health: this.#variable(machine, "DeviceHealth", "NAMUR NE 107", this.health.nodeId),
      status: this.#variable(machine, "Status", "Status bits that are set, by name", "String"),
      causes: this.#variable(machine, "Causes", "What explains a health that is not normal, most likely first", "String"),
      samples: this.#variable(machine, "Samples", "Samples worked on since the store began", "UInt64"),
      energy: this.#variable(machine, "Energy", "Hydraulic energy through the edge in J", "Double"),
    };
  }

  #write(valve, one, now) {
    const stalled = one.status.includes("stalled");
    const put = (variable, dataType, value, status = StatusCodes.Good) =>
      variable.setValueFromSource({ dataType, value }, status, now);
    const number = (variable, value) => {
      if (value === null || value === undefined) put(variable, DataType.Double, NaN, StatusCodes.BadNoData);
      else if (stalled) put(variable, DataType.Double, value, StatusCodes.UncertainLastUsableValue);
      else put(variable, DataType.Double, value, one.ne107 === "F" ? StatusCodes.BadDeviceFailure
        : one.ne107 === "good" || one.ne107 === "M" ? StatusCodes.Good : StatusCodes.UncertainSensorNotAccurate);
    };
    number(valve.flow, one.flow_L_min);
    number(valve.lower, one.flow_lower_L_min);
    number(valve.upper, one.flow_upper_L_min);
    number(valve.pressure, one.pressure_difference_bar);
    put(valve.health, DataType.Int32, HEALTH[one.ne107] ?? HEALTH.C);
    put(valve.status, DataType.String, one.status.join("|"));
    put(valve.causes, DataType.String, one.causes.map((cause) => cause.cause).join("|"));
    valve.samples.setValueFromSource({ dataType: DataType.UInt64, arrayType: VariantArrayType.Scalar,
      value: [Math.floor(one.samples / 2 ** 32), one.samples % 2 ** 32] }, StatusCodes.Good, now);
    put(valve.energy, DataType.Double, one.energy_J ?? NaN);
  }

  // `live` is gone, or has this valve no more: the last values stay, as bad ones.
  #tellLost(valve, now) {
    for (const variable of Object.values(valve)) {
      const last = variable.readValue().value;
      variable.setValueFromSource(last, StatusCodes.BadNoCommunication, now);
    }
    valve.health.setValueFromSource({ dataType: DataType.Int32, value: HEALTH.C }, StatusCodes.Good, now);
  }
}
