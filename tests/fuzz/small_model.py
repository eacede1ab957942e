#!/usr/bin/env python3
"""small_model.py MODEL.json SMALL.json: a model with as little evidence as a reader takes and short numbers, for the fuzz
targets (tests/fuzz/observer_model.json). spoolflow must still take the result: `spoolflow export cpp SMALL.json -o DIR`."""
import json
import sys


def shortened(loop):
    return {key: value[:2] if isinstance(value, list) else value for key, value in loop.items()}


def rounded(value):
    if isinstance(value, list):
        return [rounded(each) for each in value]
    return float(f"{value:.4g}") if isinstance(value, float) else value


def rises_evenly(values):
    if any(isinstance(each, list) for each in values):
        return False
    if not all(isinstance(each, (int, float)) for each in values) or len(values) < 3:
        return True
    steps = [after - before for before, after in zip(values, values[1:])]
    return max(steps) - min(steps) < 1e-6 * max(abs(step) for step in steps)


def round_tables(node):
    """Tables alone: axes rise in equal steps only with all their digits."""
    for key, value in node.items():
        if isinstance(value, dict):
            round_tables(value)
        elif isinstance(value, list) and not rises_evenly(value):
            node[key] = rounded(value)


def small(model):
    for direction in (model, model.get("p_to_a", {})):
        evidence = direction.get("evidence", {})
        for key, value in evidence.items():
            if isinstance(value, list):
                evidence[key] = [shortened(each) for each in value[:1]]
        sensitivity = evidence.get("sensitivity", {})
        for key, value in sensitivity.items():
            sensitivity[key] = value[:4] if key.startswith("flow") else value[:2]
        for part in ("condensed", "observer"):
            round_tables(direction.get(part, {}))
    model["provenance"]["inputs"] = model["provenance"]["inputs"][:1]
    return model


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as source, open(sys.argv[2], "w", encoding="utf-8") as out:
        json.dump(small(json.load(source)), out, separators=(",", ":"))
