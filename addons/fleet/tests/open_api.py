"""What an OpenAPI 3.1 description of this project promises of an answer: as much of JSON Schema as it uses."""
import datetime

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}
USED = {"type", "enum", "required", "properties", "additionalProperties", "items", "format", "description", "$ref"}


def resolved(description, schema):
    while "$ref" in schema:
        at = description
        for name in schema["$ref"].removeprefix("#/").split("/"):
            at = at[name]
        schema = at
    return schema


def is_of(kind, value):
    if kind in ("number", "integer"):
        number = isinstance(value, int if kind == "integer" else (int, float))
        return number and not isinstance(value, bool)
    return isinstance(value, TYPES[kind])


def violations(description, schema, value, place="the answer"):
    """Sentences; none where the value is as described."""
    schema = resolved(description, schema)
    if set(schema) - USED:
        return [f"{place}: the description uses {sorted(set(schema) - USED)}, which this test does not know"]
    if "enum" in schema:
        return [] if value in schema["enum"] else [f"{place}: {value!r} is none of {schema['enum']}"]
    kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    if not any(is_of(kind, value) for kind in kinds):
        return [f"{place}: {value!r} is no {' or '.join(kinds)}"]
    out = []
    if schema.get("format") == "date-time" and value is not None:
        try:
            datetime.datetime.fromisoformat(value.replace("Z", "+00:00"))
        except ValueError:
            out.append(f"{place}: {value!r} is no time")
    if isinstance(value, dict):
        known = schema.get("properties", {})
        out += [f"{place}: lacks {name}" for name in schema.get("required", []) if name not in value]
        for name, member in value.items():
            if name in known:
                out += violations(description, known[name], member, f"{place}.{name}")
            elif schema.get("additionalProperties", True) is False:
                out.append(f"{place}: {name} is not described")
    if isinstance(value, list) and "items" in schema:
        for k, item in enumerate(value[:50]):
            out += violations(description, schema["items"], item, f"{place}[{k}]")
    return out
