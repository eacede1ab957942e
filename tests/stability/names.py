#!/usr/bin/env python3
"""names.py SPOOLFLOW SOURCE MODELS: prints, sorted, a name a line, what users of spoolflow call by its name: options of the command,
columns, keys of JSON, declarations of spoolflow.h, members of the Python package, variables of FMUs, paths and fields of
the pages' interfaces, metrics, channels and units. MODELS: folder of models (NAME.json) with run.csv; SPOOLFLOW has its
add-ons beside it."""
import ast
import io
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
import zipfile


def output_of(*command, **more):
    return subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True, **more).stdout


def of_command(spoolflow):
    """Commands with their options, and the values that an option lists."""
    waiting = [[]]
    while waiting:
        words = waiting.pop()
        text = output_of(spoolflow, *words, "--help")
        yield "command " + " ".join(words)
        for line in text.splitlines():
            option = re.match(r"  (-.*?)(?:  |$)", line)
            if option:
                for name in re.findall(r"(?<![\w-])-{1,2}[a-z][\w-]*", option[1]):
                    yield f"command {' '.join(words)} {name}"
                values = re.search(r"\{([^}]*)\}", option[1])
                for value in values[1].split(",") if values else ():
                    yield f"command {' '.join(words)} {name}={value}"
        sections = re.findall(r"^Commands[^\n]*:\n((?:  .*\n?)+)", text, re.M)
        for name in re.findall(r"^  ([a-z][\w-]*)(?:  |$)", "".join(sections), re.M):
            waiting.append([*words, name])


def of_c_header(source):
    text = (source / "spoolflow/export/c_interface/spoolflow.h").read_text(encoding="utf-8")
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S).replace("\\\n", " ")
    for name, value in re.findall(r"^#define (SPOOLFLOW_\w+) (.+)$", text, re.M):
        if not name.startswith(("SPOOLFLOW_VERSION", "SPOOLFLOW_API")):
            yield f"c {name} = {' '.join(value.split())}"
    text = re.sub(r"^#.*$", "", text, flags=re.M)
    for body, name in re.findall(r"typedef enum \w+ \{(.*?)\} (\w+);", text, re.S):
        yield from (f"c {name} {' '.join(each.split())}" for each in body.split(",") if each.strip())
    for body, name in re.findall(r"typedef struct \w+ \{(.*?)\} (\w+);", text, re.S):
        yield f"c {name} {{{' '.join(body.split())}}}"  # whole: its size and order are binary interface
    for declared in re.findall(r"SPOOLFLOW_API ([^;{]+\));", text):
        yield "c " + " ".join(declared.split())


def of_python(source):
    """Functions with their arguments, classes with their members, as far as `spoolflow` exports them."""
    package = source / "addons/python/package/spoolflow"
    trees = {path.name: ast.parse(path.read_text(encoding="utf-8")) for path in sorted(package.iterdir()) if path.suffix in (".py", ".pyi")}
    exported = next(ast.literal_eval(node.value) for node in trees["__init__.py"].body
                    if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
    found = {node.name: node for name in sorted(trees, reverse=True) for node in trees[name].body
             if isinstance(node, (ast.ClassDef, ast.FunctionDef))}

    def arguments(of, node):
        every = node.args.posonlyargs + node.args.args + node.args.kwonlyargs
        yield from (f"{of}({each.arg})" for each in every if each.arg not in ("self", "cls"))

    for name in exported:
        yield f"python {name}"
        node = found.get(name)
        if isinstance(node, ast.FunctionDef):
            yield from arguments(f"python {name}", node)
        for member in node.body if isinstance(node, ast.ClassDef) else ():
            if isinstance(member, ast.FunctionDef) and (member.name == "__init__" or not member.name.startswith("_")):
                own = f"python {name}.{member.name}"
                yield own
                if not name.endswith("Error") and member.name != "__init__":
                    yield from arguments(own, member)
            targets = member.targets if isinstance(member, ast.Assign) else [member.target] if isinstance(member, ast.AnnAssign) else []
            yield from (f"python {name}.{each.id}" for each in targets if isinstance(each, ast.Name) and not each.id.startswith("_"))


def of_fmu(spoolflow, what, model):
    """Variables by name, causality, variability, type and unit."""
    with tempfile.TemporaryDirectory() as folder:
        fmu = pathlib.Path(folder) / "one.fmu"
        output_of(spoolflow, "export", "fmu", model, "-o", fmu, "--fmi", "2")
        description = xml.parse(io.BytesIO(zipfile.ZipFile(fmu).read("modelDescription.xml"))).getroot()
    for variable in description.iter("ScalarVariable"):
        kind = variable[0]
        yield " ".join(filter(None, (f"fmu {what}", variable.get("name"), variable.get("causality"), variable.get("variability"),
                                     kind.tag, kind.get("unit"))))


def fields_of(schema, at):
    yield at
    for name, each in schema.get("properties", {}).items():
        yield from fields_of(each, f"{at}.{name}")
    if "items" in schema:
        yield from fields_of(schema["items"], at + "[]")
    for each in schema.get("allOf", []) + schema.get("oneOf", []) + schema.get("anyOf", []):
        yield from fields_of(each, at)


def of_interface(source, page, file):
    described = json.loads((source / "docs" / file).read_text(encoding="utf-8"))
    for path, methods in described["paths"].items():
        for method, about in methods.items():
            own = f"{page} {method.upper()} {path}"
            yield own
            yield from (f"{own} ?{each['name']}" for each in about.get("parameters", []) if "name" in each)
            for status, answer in about.get("responses", {}).items():
                for content in answer.get("content", {}).values():
                    yield from (f"{own} {status} {field}" for field in fields_of(content.get("schema", {}), "answer"))
    for name, schema in described.get("components", {}).get("schemas", {}).items():
        yield from (f"{page} field {field}" for field in fields_of(schema, name))


def keys_of(value, at):
    if isinstance(value, dict):
        for key, each in value.items():
            yield f"{at}.{key}"
            yield from keys_of(each, f"{at}.{key}")
    elif isinstance(value, list):
        for each in value:
            yield from keys_of(each, at + "[]")


def of_outputs(spoolflow, models):
    with tempfile.TemporaryDirectory() as folder:
        made = pathlib.Path(folder) / "made.json"
        run, full = models / "run.csv", models / "full.json"
        header = output_of(spoolflow, "estimate", "-q", full, run, "-o", "-").splitlines()[0]
        yield from (f"estimate column {name}" for name in header.split(","))
        output_of(spoolflow, "validate", "-q", full, run, "--json", made)
        yield from (f"validate {key}" for key in keys_of(json.loads(made.read_text()), "json") if ".status_share." not in key)
        output_of(spoolflow, "monitor", "-q", full, run, "--json", made)
        yield from (f"monitor {key}" for key in keys_of(json.loads(made.read_text()), "json"))


def of_texts(source):
    """Metrics of Prometheus in the sources; channels and units of the page that a test holds against the sources."""
    for path in sorted((source / "addons").glob("*/page/*.cpp")):
        yield from (f"metric {name}" for name in re.findall(r"\b(spoolflow_[a-z_]+)[ {\"]", path.read_text(encoding="utf-8")))
    page = (source / "docs/formats/channels.md").read_text(encoding="utf-8")
    channels = re.search(r"\n\| channel \| quantity.*?\n\n", page, re.S)[0]
    for line in channels.splitlines()[2:]:
        yield from (f"channel {name}" for name in re.findall(r"`(\w+)`", line.split("|")[1] if "|" in line else ""))
    units = re.search(r"\n\| unit of \| names.*?\n\n", page, re.S)[0]
    yield from (f"unit {name}" for name in re.findall(r"`([^`]+)`", units))


def all_names(spoolflow, source, models):
    source, models = pathlib.Path(source), pathlib.Path(models)
    yield from of_command(spoolflow)
    yield from of_c_header(source)
    yield from of_python(source)
    yield from of_interface(source, "live", "openapi.json")
    yield from of_interface(source, "fleet", "fleet_openapi.json")
    yield from of_outputs(spoolflow, models)
    yield from of_texts(source)
    yield from of_fmu(spoolflow, "sensor", models / "full.json")
    yield from of_fmu(spoolflow, "whole_sensor", models / "whole.json")
    yield from of_fmu(spoolflow, "valve", "size_6")
    yield from of_fmu(spoolflow, "whole_valve", "whole_size_6")


if __name__ == "__main__":
    print("\n".join(sorted(set(all_names(*sys.argv[1:4])))))
