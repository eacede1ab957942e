#!/usr/bin/env python3
"""system_structure.py SPOOLFLOW MODEL.json: `export ssp`, read as a simulation tool reads it, for FMI 2.0 and 3.0.

Facts of SSP 1.0's schema (elements, their order, required attributes, kinds and types) hold; each connector is a variable of its
FMU with the same causality, type and unit; each connection joins an output to one input with the same unit; every input that
is listed is driven, and the sensor's are all. Then both FMUs run as connected, and the sensor answers as much as the valve lets through.
Standard library only.
"""
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "ci"))
import fmu_answers  # noqa: E402

SSC, SSD = "{http://ssp-standard.org/SSP1/SystemStructureCommon}", "{http://ssp-standard.org/SSP1/SystemStructureDescription}"
CHILDREN = {  # in the schema's order
    "SystemStructureDescription": ["System", "Enumerations", "Units", "DefaultExperiment", "Annotations"],
    "System": ["Connectors", "ElementGeometry", "ParameterBindings", "Elements", "Connections", "SignalDictionaries",
               "SystemGeometry", "GraphicalElements", "Annotations"],
    "Component": ["Connectors", "ElementGeometry", "ParameterBindings", "Annotations"],
    "Connectors": ["Connector"], "Elements": ["Component"], "Connections": ["Connection"], "Units": ["Unit"], "Unit": ["BaseUnit"],
    "Connector": ["Real", "Integer", "Boolean", "String", "Enumeration", "Binary", "ConnectorGeometry", "Annotations"]}
REQUIRED = {"SystemStructureDescription": ["version", "name"], "System": ["name"], "Component": ["name", "source"],
            "Connector": ["name", "kind"], "Connection": ["startConnector", "endConnector"], "Unit": ["name"]}
TYPES = {"Real": "Real", "Integer": "Integer", "Boolean": "Boolean", "Float64": "Real", "Int32": "Integer"}
EXPONENTS = {"kg", "m", "s", "A", "K", "mol", "cd", "rad"}


def local(element):
    return element.tag.split("}")[1]


def check_schema(element):
    name = local(element)
    assert element.tag.startswith(SSC if name in ("Unit", "BaseUnit", *TYPES) else SSD), element.tag
    for attribute in REQUIRED.get(name, []):
        assert element.get(attribute), f"{name} without {attribute}"
    places = [CHILDREN.get(name, []).index(local(child)) for child in element]  # raises where there is none
    assert places == sorted(places), f"the parts of {name} are not in the schema's order"
    if name == "BaseUnit":
        assert set(element.attrib) <= EXPONENTS and all(int(power) for power in element.attrib.values()), element.attrib
    for child in element:
        check_schema(child)


def connectors(element):
    """By name: kind, type and unit."""
    out = {}
    for each in element.find(SSD + "Connectors"):
        assert each.get("name") not in out and each.get("kind") in ("input", "output"), each.get("name")
        out[each.get("name")] = (each.get("kind"), local(each[0]), each[0].get("unit"))
    return out


def variables(folder):
    root = xml.parse(folder / "modelDescription.xml").getroot()
    out = {}
    for each in root.find("ModelVariables"):
        typed = each[0] if each.tag == "ScalarVariable" else each
        if each.get("causality") in ("input", "output"):
            out[each.get("name")] = (each.get("causality"), TYPES[typed.tag], typed.get("unit"))
    return out


def connected(system, inside):
    """The connections as pairs of (element, connector); checks both ends of each."""
    own, pairs = connectors(system), []
    for each in system.find(SSD + "Connections"):
        start, end = ((each.get(which + "Element"), each.get(which + "Connector")) for which in ("start", "end"))
        sides = [(own if element is None else inside[element])[name] for element, name in (start, end)]
        assert sides[0][0] == ("input" if start[0] is None else "output"), f"{start} is no source"
        assert sides[1][0] == ("output" if end[0] is None else "input"), f"{end} is no sink"
        assert sides[0][1:] == sides[1][1:], f"{start} and {end} differ in type or unit: {sides}"
        pairs.append((start, end))
    ends = [end for _, end in pairs]
    assert len(ends) == len(set(ends)), "something is driven twice"
    assert {name for element, name in ends if element is None} == {name for name, (kind, *_) in own.items() if kind == "output"}
    assert {name for element, name in (start for start, _ in pairs) if element is None} == {name for name, (kind, *_) in own.items() if kind == "input"}
    return pairs


def run(folders, pairs):
    """As an importer couples: values are carried over between steps of a millisecond."""
    fmus = {name: fmu_answers.Fmu(folder) for name, folder in folders.items()}
    for fmu in fmus.values():
        fmu.start([])
        fmu.call("ExitInitializationMode")
    system = {"position_set": 0.0, "pressure_difference_set": 50e5}
    for k in range(1500):
        system["position_set"] = min(1.2e-6 * k, 1.2e-3)
        for (start, source), (end, sink) in pairs:
            if end is not None:
                value = system[source] if start is None else fmus[start].get("Real", [source])[0]
                fmus[end].set({sink: value})
        for fmu in fmus.values():
            fmu.step(k * 1e-3, 1e-3)
    for (start, source), (end, sink) in pairs:
        if end is None and sink in ("flow", "true_flow"):
            system[sink] = fmus[start].get("Real", [source])[0]
    return system


def check(package, folder):
    with zipfile.ZipFile(package) as archive:
        assert sorted(archive.namelist()) == ["SystemStructure.ssd", "resources/sensor.fmu", "resources/valve.fmu"]
        archive.extractall(folder)
    root = xml.parse(folder / "SystemStructure.ssd").getroot()
    assert root.get("version") == "1.0"
    check_schema(root)
    system = root.find(SSD + "System")
    inside, folders = {}, {}
    for component in system.find(SSD + "Elements"):
        name = component.get("name")
        folders[name] = folder / name
        with zipfile.ZipFile(folder / component.get("source")) as archive:
            archive.extractall(folders[name])
        inside[name] = connectors(component)
        own = variables(folders[name])
        assert inside[name].items() <= own.items(), f"connectors of {name} are not its FMU's"
        left_out = {each: own[each][0] for each in own.keys() - inside[name].keys()}
        assert set(left_out.values()) <= {"input"}, f"{name} lacks outputs: {left_out}"
    units = [unit.get("name") for unit in root.find(SSD + "Units")]
    used = {unit for each in (connectors(system), *inside.values()) for _, _, unit in each.values() if unit}
    assert sorted(units) == sorted(used), (units, used)
    pairs = connected(system, inside)
    for name in inside:  # a tool may set an input that nothing drives to zero
        driven = {sink for _, (element, sink) in pairs if element == name}
        assert driven == {each for each, (kind, *_) in inside[name].items() if kind == "input"}, (name, driven)
    whole = {name for name, (kind, *_) in variables(folders["sensor"]).items() if kind == "input"}
    assert whole == {each for each, (kind, *_) in inside["sensor"].items() if kind == "input"}, whole
    return pairs, run(folders, pairs)


def main():
    spoolflow, model = sys.argv[1:]
    for version in "23":
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            subprocess.run([spoolflow, "export", "ssp", model, "--valve", "size_6", "--fmi", version, "-o", folder / "x.ssp"], check=True)
            pairs, said = check(folder / "x.ssp", folder)
        # The model is another valve's of this size: the coupling is under test, not the accuracy.
        assert said["true_flow"] > 5 / 60000 and 0.3 < said["flow"] / said["true_flow"] < 3, said
        print(f"FMI {version}: {len(pairs)} connections; sensor {said['flow'] * 60000:.1f} L/min, truth {said['true_flow'] * 60000:.1f} L/min")
    refused = subprocess.run([spoolflow, "export", "ssp", model, "-o", "none.ssp"], stderr=subprocess.PIPE, text=True)
    assert refused.returncode == 2 and "--valve" in refused.stderr, refused.stderr


if __name__ == "__main__":
    main()
