"""Settings files (TOML) from dictionaries that say the same."""
from __future__ import annotations

import json
from typing import Any, List, Mapping


def _value(name: str, value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(key)} = {_value(key, each)}" for key, each in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(name, each) for each in value) + "]"
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: text, a number, a list or a dict is needed, not {type(value).__name__}") from None
    if isinstance(value, int):
        return str(value)
    return repr(number) if number == number else "nan"


def text_of(settings: Mapping[str, Any]) -> str:
    """As TOML: plain keys first, then tables, then lists of tables."""
    plain: List[str] = []
    tables: List[str] = []
    for key, value in settings.items():
        if isinstance(value, Mapping):
            tables.append(f"[{json.dumps(key)}]\n" + text_of_keys(value))
        elif isinstance(value, (list, tuple)) and value and all(isinstance(each, Mapping) for each in value):
            tables += [f"[[{json.dumps(key)}]]\n" + text_of_keys(each) for each in value]
        else:
            plain.append(f"{json.dumps(key)} = {_value(key, value)}\n")
    return "".join(plain) + "".join(tables)


def text_of_keys(table: Mapping[str, Any]) -> str:
    return "".join(f"{json.dumps(key)} = {_value(key, value)}\n" for key, value in table.items())
